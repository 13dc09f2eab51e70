#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/hierarchical/hierarchical_json.h"
#include "analysis/hierarchical/hierarchical_nested.h"
#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "support/sanitizer.h"

namespace jnd::analysis {
namespace hierarchical_robust_test {

constexpr double kLevels[] = {0.5, 0.65, 0.8, 0.92, 1.1, 1.25, 1.5, 2.0};

/// Returns people with w = 0.3 on average, whose answers to one level correlate by rho. The
/// next answer is a yes with (p + phi times the yes so far) / (1 + phi times the answers so
/// far). This is Polya's urn, and the count is beta-binomial.
std::vector<ParticipantAnswers> scattered_people(double rho, int num_people, int num_trials,
                                                 std::uint64_t seed) {
  const double phi = rho / (1.0 - rho);
  std::vector<ParticipantAnswers> all;
  for (int person = 0; person < num_people; ++person) {
    core::RandomStream random(seed, "scattered people", {person});
    ParticipantAnswers one{"P" + std::to_string(person), "", 1.0, {}};
    const double slope = std::exp(0.2 * random.normal()) / std::log1p(0.3);
    for (const double x : kLevels) {
      AnswerCount row{.intensity = x, .num_trials = num_trials};
      const double p = core::standard_normal_cdf(slope * std::log(x));
      for (int trial = 0; trial < num_trials; ++trial) {
        const double next = (p + phi * static_cast<double>(row.num_yes)) / (1.0 + phi * trial);
        row.num_yes += random.with_probability(next) ? 1 : 0;
      }
      one.rows.push_back(row);
    }
    all.push_back(std::move(one));
  }
  return all;
}

constexpr HierarchicalOptions kScattered = {.pse = HierarchicalPse::kReference,
                                            .lapses = HierarchicalLapses::kNone,
                                            .beta_binomial = true};

TEST(HierarchicalRobust, ACorrelationThatWasPutInIsFound) {
  const auto answers = scattered_people(0.15, 12, 20, 4);
  const HierarchicalFit fit = fit_hierarchical(answers, kScattered);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const HierarchicalScatter& found = fit.scatter.value();
  EXPECT_NEAR(found.correlation, 0.15, 0.06);
  EXPECT_LT(*found.correlation_ci95.low, 0.15);
  EXPECT_GT(*found.correlation_ci95.high, 0.15);
  EXPECT_GT(*found.correlation_ci95.low, 0.05);
  EXPECT_LT(*found.p_value, 1e-6);
  EXPECT_NEAR(*found.statistic, 2.0 * (*fit.log_likelihood - *found.log_likelihood_without),
              1e-9)
      << "without a prior nothing else has a part in it";
  HierarchicalOptions independent = kScattered;
  independent.beta_binomial = false;
  const HierarchicalFit without = fit_hierarchical(answers, independent);
  EXPECT_NEAR(*found.log_likelihood_without, *without.log_likelihood, 1e-7);
  EXPECT_NEAR(*found.weber_fractions_without[0], *without.conditions[0].weber_fraction, 1e-6);
  const auto width = [](const HierarchicalFit& one) {
    const Interval& ends = one.conditions[0].weber_fraction_ci95;
    return *ends.high - *ends.low;
  };
  EXPECT_GT(fit.conditions[0].slope_standard_error, without.conditions[0].slope_standard_error)
      << "answers that go together say less";
  EXPECT_GT(width(fit), width(without));
  EXPECT_NE(fit.method.find("beta-binomial"), std::string::npos) << fit.method;
  // The model with scatter no longer calls the scatter a misfit.
  EXPECT_FALSE(without.conditions[0].cautions.empty());
  EXPECT_TRUE(fit.conditions[0].cautions.empty()) << fit.conditions[0].cautions[0];
}

TEST(HierarchicalRobust, TheIntervalOfACorrelationEndsWhereTheLikelihoodHasFallen) {
  const auto answers = scattered_people(0.1, 8, 12, 2);
  const HierarchicalFit fit = fit_hierarchical(answers, kScattered);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const Interval ends = fit.scatter->correlation_ci95;
  ASSERT_TRUE(ends.low && ends.high);
  EXPECT_LT(*ends.low, fit.scatter->correlation);
  EXPECT_GT(*ends.high, fit.scatter->correlation);
  // The test computes its own likelihood and maximises it over the other two parameters.
  std::vector<HierarchicalPerson> people;
  for (const ParticipantAnswers& one : answers) {
    HierarchicalCell cell;
    for (const AnswerCount& row : one.rows) {
      cell.log_ratio.push_back(std::log(row.intensity));
      cell.num_yes.push_back(static_cast<double>(row.num_yes));
      cell.num_no.push_back(static_cast<double>(row.num_trials - row.num_yes));
      cell.order.push_back(0.0);
    }
    people.push_back({cell});
  }
  const HierarchicalStructure structure{
      .loadings = {{0, 0, 1}}, .num_parameters = 3, .has_scatter = true};
  const HierarchicalLikelihood likelihood(structure, people, 15);
  const auto largest = [&](double rho) {
    double best = -1e300;
    const double a = fit.conditions[0].slope_number;
    for (int i = -15; i <= 15; ++i) {
      for (int j = 0; j <= 15; ++j) {
        const Eigen::Vector3d at(a + 0.01 * i, 0.03 * j, std::asin(std::sqrt(rho)));
        best = std::max(best, likelihood(at));
      }
    }
    return best;
  };
  for (const double end : {*ends.low, *ends.high}) {
    const double fall = *fit.log_likelihood - largest(end);
    if (end == 0.0) {
      EXPECT_LT(fall, 1.9208);
    } else {
      EXPECT_NEAR(fall, 1.9207, 0.03);
    }
  }
}

TEST(HierarchicalRobust, WhereAnswersAreIndependentNoCorrelationIsFound) {
  int num_found = 0, num_at_bound = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const HierarchicalFit fit =
        fit_hierarchical(scattered_people(0.0, 8, 12, seed), kScattered);
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    const HierarchicalScatter& found = fit.scatter.value();
    EXPECT_LT(found.correlation, 0.06);
    EXPECT_EQ(*found.correlation_ci95.low, 0.0) << seed;
    num_found += *found.p_value < 0.05 ? 1 : 0;
    if (found.correlation > 0.0) continue;
    ++num_at_bound;
    EXPECT_EQ(*found.statistic, 0.0);
    EXPECT_EQ(*found.p_value, 1.0);
    EXPECT_NEAR(*found.log_likelihood_without, *fit.log_likelihood, 1e-9);
    EXPECT_NEAR(*found.weber_fractions_without[0], *fit.conditions[0].weber_fraction, 1e-7);
  }
  EXPECT_EQ(num_found, 0);
  EXPECT_GE(num_at_bound, 1) << "about half of sets end at the bound";
}

TEST(HierarchicalRobust, SingleAnswersHaveNoCorrelation) {
  const HierarchicalFit fit = fit_hierarchical(scattered_people(0.0, 6, 1, 3), kScattered);
  EXPECT_EQ(fit.status, FitStatus::kDegenerate);
  EXPECT_NE(fit.reason.find("answered any level twice"), std::string::npos) << fit.reason;
}

/// Returns answers, as even as counts can be, of people with w = 0.3 who lapse at these rates.
/// The easiest comparisons are so easy that lapses differ from a flat curve.
std::vector<ParticipantAnswers> people_who_lapse(const std::vector<double>& lapse_rates,
                                                 std::int64_t num_trials) {
  std::vector<ParticipantAnswers> all;
  for (std::size_t person = 0; person < lapse_rates.size(); ++person) {
    ParticipantAnswers one{"P" + std::to_string(person), "", 1.0, {}};
    const double deviation = static_cast<double>(person % 5) - 2.0;
    const double slope = std::exp(0.12 * deviation) / std::log1p(0.3);
    const double lapse = lapse_rates[person];
    for (const double x : {0.25, 0.5, 0.7, 0.88, 1.13, 1.4, 2.0, 4.0}) {
      const double p =
          lapse + (1.0 - 2.0 * lapse) * core::standard_normal_cdf(slope * std::log(x));
      one.rows.push_back({x, std::llround(p * static_cast<double>(num_trials)), num_trials});
    }
    all.push_back(std::move(one));
  }
  return all;
}

TEST(HierarchicalRobust, APersonWhoLapsesIsFoundAndNotTakenForEverybody) {
  std::vector<double> rates(10, 0.01);
  rates[2] = 0.15;  // This person has the median slope.
  const auto answers = people_who_lapse(rates, 60);
  HierarchicalOptions options{.pse = HierarchicalPse::kReference};
  const HierarchicalFit common = fit_hierarchical(answers, options);
  options.lapses = HierarchicalLapses::kPersonal;
  const HierarchicalFit own = fit_hierarchical(answers, options);
  ASSERT_EQ(own.status, FitStatus::kOk) << own.reason;
  ASSERT_EQ(common.status, FitStatus::kOk) << common.reason;
  for (const HierarchicalPersonEstimate& one : own.participants) {
    ASSERT_TRUE(one.lapse_rate);
    if (one.participant == "P2") {
      EXPECT_NEAR(*one.lapse_rate, 0.15, 0.04);
    } else {
      EXPECT_LT(*one.lapse_rate, 0.03) << one.participant;
    }
  }
  const HierarchicalOwnLapses& found = own.own_lapses.value();
  EXPECT_GT(found.angle_sd, 0.05);
  EXPECT_LT(*found.p_value, 0.01);
  // The two fits use other numbers of nodes.
  EXPECT_NEAR(*found.log_likelihood_common, *common.log_likelihood, 1e-4);
  EXPECT_NEAR(*found.common_lapse_rate, *common.lapse_rate, 1e-5);
  EXPECT_NEAR(*found.weber_fractions_common[0], *common.conditions[0].weber_fraction, 1e-5);
  EXPECT_GT(found.mean_lapse_rate, *own.lapse_rate);
  const auto bias = [](const HierarchicalFit& fit) {
    return std::fabs(std::log(*fit.conditions[0].weber_fraction / 0.3));
  };
  EXPECT_LT(bias(own), 0.5 * bias(common));
  // With a common rate, the person who lapses seems to have a flat curve.
  EXPECT_LT(*own.participants[2].weber_fraction, *common.participants[2].weber_fraction);
  const Interval& rate = own.lapse_rate_with_prior_ci95;
  EXPECT_LE(*rate.low, *own.lapse_rate);
  EXPECT_GT(*rate.high, *own.lapse_rate);
  EXPECT_FALSE(own.lapse_rate_without_prior);
  EXPECT_FALSE(common.participants[2].lapse_rate);
  EXPECT_NE(own.method.find("each person's own"), std::string::npos) << own.method;
}

TEST(HierarchicalRobust, PeopleWhoLapseAlikeHaveNoSpreadOfLapses) {
  const auto answers = people_who_lapse(std::vector<double>(8, 0.03), 60);
  HierarchicalOptions options{.pse = HierarchicalPse::kReference, .lapse_profile = false};
  const HierarchicalFit common = fit_hierarchical(answers, options);
  options.lapses = HierarchicalLapses::kPersonal;
  const HierarchicalFit own = fit_hierarchical(answers, options);
  ASSERT_EQ(own.status, FitStatus::kOk) << own.reason;
  EXPECT_EQ(own.own_lapses->angle_sd, 0.0);
  EXPECT_EQ(*own.own_lapses->p_value, 1.0);
  EXPECT_NEAR(*own.lapse_rate, *common.lapse_rate, 1e-5);
  EXPECT_NEAR(*own.conditions[0].weber_fraction, *common.conditions[0].weber_fraction, 1e-5);
  for (const HierarchicalPersonEstimate& one : own.participants) {
    EXPECT_NEAR(*one.lapse_rate, *own.lapse_rate, 1e-6);
  }
}

TEST(HierarchicalRobust, BothTogetherAreFitted) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  std::vector<double> rates(6, 0.01);
  rates[1] = 0.15;
  const HierarchicalFit fit =
      fit_hierarchical(people_who_lapse(rates, 40), {.pse = HierarchicalPse::kReference,
                                                     .lapses = HierarchicalLapses::kPersonal,
                                                     .lapse_profile = false,
                                                     .beta_binomial = true,
                                                     .correlation_interval = false});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_EQ(fit.scatter->correlation, 0.0) << "counts that are as even as can be";
  EXPECT_GT(fit.own_lapses->angle_sd, 0.05);
  EXPECT_FALSE(fit.scatter->correlation_ci95.low);
}

/// Returns answers that are so hard that the prior matters, with a few random ones.
std::vector<ParticipantAnswers> people_for_priors() {
  std::vector<ParticipantAnswers> all = scattered_people(0.0, 6, 10, 11);
  all[0].rows[0].num_yes += 1;
  all[3].rows[7].num_yes -= 2;
  return all;
}

TEST(HierarchicalRobust, ThePriorThatIsTheDefaultIsTheDefaultToTheBit) {
  const HierarchicalFit plain = fit_hierarchical(people_for_priors(), {});
  const HierarchicalFit told =
      fit_hierarchical(people_for_priors(), {.lapse_prior = {1.0, 20.0}});
  EXPECT_EQ(to_json(plain), to_json(told));
  const HierarchicalFit other =
      fit_hierarchical(people_for_priors(), {.lapse_prior = {1.0, 40.0}});
  EXPECT_NE(to_json(plain), to_json(other));
}

TEST(HierarchicalRobust, ALighterPriorMovesTheFitTowardThatWithoutOne) {
  HierarchicalOptions options{.pse = HierarchicalPse::kReference, .prior_sensitivity = true};
  const HierarchicalFit fit = fit_hierarchical(people_for_priors(), options);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  ASSERT_EQ(fit.prior_effects.size(), 3U);
  const HierarchicalPriorEffect& none = fit.prior_effects[0];
  const HierarchicalPriorEffect& half = fit.prior_effects[1];
  const HierarchicalPriorEffect& twice = fit.prior_effects[2];
  EXPECT_NEAR(*none.lapse_rate, *fit.lapse_rate_without_prior, 1e-5);
  EXPECT_NEAR(*none.weber_fractions[0], *fit.conditions[0].weber_fraction_without_prior, 1e-5);
  EXPECT_GT(*none.lapse_rate, *half.lapse_rate);
  EXPECT_GT(*half.lapse_rate, *fit.lapse_rate);
  EXPECT_GT(*fit.lapse_rate, *twice.lapse_rate);
  EXPECT_LT(*half.weber_fractions[0], *fit.conditions[0].weber_fraction);
  EXPECT_GT(*twice.weber_fractions[0], *fit.conditions[0].weber_fraction);
  options.prior_sensitivity = false;
  options.lapse_prior = kUsualLapsePrior.weighed(2.0);
  EXPECT_NEAR(*fit_hierarchical(people_for_priors(), options).conditions[0].weber_fraction,
              *twice.weber_fractions[0], 1e-6);
}

TEST(HierarchicalRobust, APriorThatExpectsLapsesFindsSomeWhereThereAreNone) {
  const auto answers = people_who_lapse(std::vector<double>(6, 0.0), 40);
  HierarchicalOptions options{.pse = HierarchicalPse::kReference};
  EXPECT_EQ(*fit_hierarchical(answers, options).lapse_rate, 0.0);
  options.lapse_prior = {3.0, 40.0};
  const HierarchicalFit fit = fit_hierarchical(answers, options);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_GT(*fit.lapse_rate, 1e-4);
  EXPECT_EQ(*fit.lapse_rate_without_prior, 0.0);
  EXPECT_GT(*fit.lapse_rate_with_prior_ci95.low, 0.0) << "none is impossible";
  EXPECT_LT(*fit.lapse_rate_with_prior_ci95.low, *fit.lapse_rate);
  EXPECT_GT(*fit.lapse_rate_with_prior_ci95.high, *fit.lapse_rate);
  for (const BetaPrior& bad : {BetaPrior{0.5, 20.0}, {1.0, 0.9}, {1.0, 2e6}}) {
    options.lapse_prior = bad;
    EXPECT_THROW((void)fit_hierarchical(answers, options), core::Error);
  }
}

TEST(HierarchicalRobust, ATestAtTheBoundHasHalfOfChiSquared) {
  // 2.7055 is the 90 % quantile of chi-squared with one degree of freedom.
  EXPECT_NEAR(boundary_test(-10.0 + 0.5 * 2.705543454095404, -10.0).p_value, 0.05, 1e-12);
  EXPECT_EQ(boundary_test(-10.0, -10.0).p_value, 1.0);
  EXPECT_EQ(boundary_test(-10.1, -10.0).statistic, 0.0);
}

}  // namespace hierarchical_robust_test
}  // namespace jnd::analysis
