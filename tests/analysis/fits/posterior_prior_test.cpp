#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/fits/psychometric_fit.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace posterior_prior_test {

/// The answers have about w = 0.3, with a lapse or two at either end.
const std::vector<AnswerCount> kAnswers = {{0.5, 1, 30},  {0.7, 3, 30},  {0.9, 12, 30},
                                           {1.1, 19, 30}, {1.4, 27, 30}, {2.0, 28, 30}};

PsychometricPosterior posterior_with(const BetaPrior& prior, bool has_effects = false) {
  return fit_psychometric(kAnswers, {.reference = 1.0,
                                     .free_lapse = true,
                                     .posterior = true,
                                     .rate_prior = prior,
                                     .prior_sensitivity = has_effects})
      .posterior;
}

/// Returns the median of the lapse rate by sums over a far finer grid than that of the fit.
double lapse_median_by_hand(const BetaPrior& prior) {
  std::vector<double> mass;
  constexpr int kNumRates = 2000;
  for (int i = 0; i < kNumRates; ++i) {
    const double lapse = 0.5 * (i + 0.5) / kNumRates;
    double sum = 0.0;
    for (int j = 0; j < 800; ++j) {
      const double log_spread = -4.0 + 0.0075 * j;
      double log_density =
          (prior.a - 1.0) * std::log(lapse) + (prior.b - 1.0) * std::log1p(-lapse);
      for (const AnswerCount& row : kAnswers) {
        const double felt =
            core::standard_normal_cdf(std::log(row.intensity) / std::exp(log_spread));
        const double yes = lapse + (1.0 - 2.0 * lapse) * felt;
        log_density += static_cast<double>(row.num_yes) * std::log(yes) +
                       static_cast<double>(row.num_trials - row.num_yes) * std::log1p(-yes);
      }
      sum += std::exp(log_density + 80.0);
    }
    mass.push_back(sum + (mass.empty() ? 0.0 : mass.back()));
  }
  const auto half = std::ranges::lower_bound(mass, 0.5 * mass.back());
  return 0.5 * static_cast<double>(half - mass.begin()) / kNumRates;
}

TEST(PosteriorPrior, TheLapseRatesMedianIsThatOfTheDensityThatIsTold) {
  for (const BetaPrior& prior : {BetaPrior{1.0, 10.0}, {1.0, 1.0}, {4.0, 30.0}}) {
    const PsychometricPosterior posterior = posterior_with(prior);
    ASSERT_EQ(posterior.status, FitStatus::kOk) << posterior.reason;
    EXPECT_NEAR(*posterior.lapse_rate, lapse_median_by_hand(prior), 1e-3) << prior.a;
  }
  EXPECT_NE(posterior_with({4.0, 30.0}).priors.find("lapse rate Beta(4, 30) below 0.5"),
            std::string::npos);
}

TEST(PosteriorPrior, TheUsualPriorGivenIsTheUsualOneToTheBit) {
  const PsychometricPosterior told = posterior_with({1.0, 10.0});
  const PsychometricPosterior usual =
      fit_psychometric(kAnswers, {.reference = 1.0, .free_lapse = true, .posterior = true})
          .posterior;
  EXPECT_EQ(*told.weber_fraction, *usual.weber_fraction);
  EXPECT_EQ(*told.lapse_rate, *usual.lapse_rate);
  EXPECT_EQ(told.priors, usual.priors);
  EXPECT_TRUE(usual.prior_effects.empty());
}

TEST(PosteriorPrior, OtherWeightsHaveTheMediansOfThosePriors) {
  const PsychometricPosterior told = posterior_with({3.0, 21.0}, true);
  ASSERT_EQ(told.prior_effects.size(), 3U);
  EXPECT_EQ(*told.prior_effects[0].lapse_rate, *posterior_with({1.0, 1.0}).lapse_rate);
  EXPECT_EQ(*told.prior_effects[1].weber_fraction, *posterior_with({2.0, 11.0}).weber_fraction);
  EXPECT_EQ(*told.prior_effects[2].lapse_rate, *posterior_with({5.0, 41.0}).lapse_rate);
}

TEST(PosteriorPrior, OfAnybodysCurvesEachNumberHasItsMedians) {
  CurveOptions options{.model = {.free_lapse = true},
                       .posterior = true,
                       .rate_prior = {2.0, 40.0},
                       .prior_sensitivity = true};
  const CurveFit fit = fit_curve(kAnswers, options);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  ASSERT_EQ(fit.lapse_rate.posterior_medians_by_weight.size(), 3U);
  options.prior_sensitivity = false;
  options.rate_prior = options.rate_prior.weighed(0.5);
  const CurveFit half = fit_curve(kAnswers, options);
  EXPECT_EQ(*fit.lapse_rate.posterior_medians_by_weight[1], *half.lapse_rate.posterior_median);
  EXPECT_EQ(*fit.scale.posterior_medians_by_weight[1], *half.scale.posterior_median);
  EXPECT_TRUE(half.scale.posterior_medians_by_weight.empty());
}

}  // namespace posterior_prior_test
}  // namespace jnd::analysis
