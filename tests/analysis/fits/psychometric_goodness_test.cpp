#include "analysis/fits/psychometric_goodness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/random_stream.h"

namespace jnd::analysis {
namespace psychometric_goodness_test {

const std::vector<AnswerCount> kGood = {{0.6, 1, 12}, {0.8, 3, 12}, {0.9, 5, 12},
                                        {1.1, 8, 12}, {1.3, 9, 12}, {1.6, 12, 12}};
/// The answers go up, down and up, so no rising curve is near them.
const std::vector<AnswerCount> kBad = {{0.6, 8, 12},  {0.8, 1, 12}, {0.9, 5, 12},
                                       {1.1, 12, 12}, {1.3, 4, 12}, {1.6, 12, 12}};

PsychometricFit fit(const std::vector<AnswerCount>& data, int num_goodness = 0,
                    std::uint64_t seed = 1) {
  return fit_psychometric(
      data,
      {.reference = 1.0, .diagnostics = true, .num_goodness = num_goodness, .seed = seed});
}

TEST(PsychometricGoodness, SquaredResidualsAddUpToTheDeviance) {
  for (const auto& data : {kGood, kBad}) {
    const PsychometricFit found = fit(data);
    double sum = 0.0;
    for (const PsychometricGoodness::Residual& one : found.goodness.residuals) {
      sum += one.deviance_residual * one.deviance_residual;
    }
    EXPECT_NEAR(sum, *found.deviance, 1e-10);
    EXPECT_EQ(found.goodness.degrees_of_freedom, 5);
  }
}

TEST(PsychometricGoodness, AnswersOfTheCurveAreNotRejectedAndOthersAre) {
  const PsychometricFit good = fit(kGood, 400), bad = fit(kBad, 400);
  EXPECT_GT(*good.goodness.p_value, 0.2);
  EXPECT_TRUE(good.warnings.empty());
  EXPECT_LT(*bad.goodness.p_value, 0.01);
  EXPECT_GT(*bad.goodness.overdispersion, 3.0);
  const auto far_off = [](const std::string& warning) {
    return warning.find("farther from the curve") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(bad.warnings, far_off), 1) << "by the simulation, once";
  const PsychometricFit unasked = fit(kBad);
  EXPECT_EQ(std::ranges::count_if(unasked.warnings, far_off), 1) << "by its moments";
}

TEST(PsychometricGoodness, IsTheSameWithoutTheCorrelationOfResiduals) {
  PsychometricOptions options{.reference = 1.0, .diagnostics = true, .num_goodness = 300};
  const PsychometricGoodness with = fit_psychometric(kGood, options).goodness;
  options.goodness_of_correlation = false;
  const PsychometricGoodness without = fit_psychometric(kGood, options).goodness;
  EXPECT_EQ(with.p_value, without.p_value);
  EXPECT_EQ(with.level_correlation, without.level_correlation);
  EXPECT_TRUE(with.level_correlation_p_value.has_value());
  EXPECT_FALSE(without.level_correlation_p_value.has_value());
}

/// Such a curve passes through every level, and p = 1 would look like a good result.
TEST(PsychometricGoodness, WithoutADegreeOfFreedomNothingIsTested) {
  const PsychometricFit fit = fit_psychometric(
      {{0.7, 4, 20}, {1.3, 15, 20}},
      {.reference = 1.0, .free_pse = true, .diagnostics = true, .num_goodness = 50});
  EXPECT_EQ(fit.goodness.degrees_of_freedom, 0);
  EXPECT_FALSE(fit.goodness.p_value);
  EXPECT_THAT(fit.goodness.reason, testing::HasSubstr("no degree of freedom"));
}

TEST(PsychometricGoodness, TheSameSeedGivesTheSamePValue) {
  EXPECT_EQ(*fit(kGood, 200, 3).goodness.p_value, *fit(kGood, 200, 3).goodness.p_value);
}

TEST(PsychometricGoodness, ItIsLeftOutUnlessAskedFor) {
  EXPECT_TRUE(fit_psychometric(kGood, {.reference = 1.0}).goodness.residuals.empty());
  EXPECT_FALSE(fit(kGood).goodness.p_value);
}

TEST(PsychometricGoodness, RedrawnDataWithoutAnOptimumCountWithTheirLimit) {
  // There are few answers on a steep curve, so many redrawn sets are separated.
  const PsychometricFit found =
      fit({{0.8, 0, 3}, {0.95, 1, 3}, {1.05, 2, 3}, {1.3, 3, 3}}, 300);
  ASSERT_EQ(found.status, FitStatus::kOk);
  EXPECT_EQ(found.goodness.n, 300);
  EXPECT_GT(*found.goodness.p_value, 0.3);
  EXPECT_LE(*found.goodness.p_value, 1.0);
}

TEST(PsychometricGoodness, ResidualsNameTheIntensitiesAsTheyWereGiven) {
  std::vector<AnswerCount> data;
  for (const double intensity : {0.7, 1.1, 3.5, 6.3}) data.push_back({intensity, 2, 5});
  data.back().num_yes = 5;
  const PsychometricFit found =
      fit_psychometric(data, {.reference = 1.7, .free_pse = true, .diagnostics = true});
  ASSERT_EQ(found.goodness.residuals.size(), data.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    EXPECT_EQ(found.goodness.residuals[i].intensity, data[i].intensity);
  }
}

/// For single answers at levels near the reference, the deviance is far from chi-squared. If it
/// were taken for chi-squared, more than half of such sets would be called far from their own
/// curve.
TEST(PsychometricGoodness, SingleAnswersOfTheCurveItselfAreRarelyCalledFarFromIt) {
  core::RandomStream random(1, "single answers");
  int num_warned = 0;
  constexpr int kNumSets = 100, kNumLevels = 200;
  for (int set = 0; set < kNumSets; ++set) {
    std::vector<AnswerCount> rows;
    for (int level = 0; level < kNumLevels; ++level) {
      const double z = 0.5 * random.normal();
      const double probability = 0.5 * std::erfc(-z / std::sqrt(2.0));
      rows.push_back(
          {2.0 * std::exp(z * std::log(1.3)), random.with_probability(probability) ? 1 : 0, 1});
    }
    const PsychometricFit found = fit_psychometric(rows, {.reference = 2.0});
    ASSERT_EQ(found.status, FitStatus::kOk);
    ASSERT_TRUE(found.misfit_p_value.has_value());
    num_warned += *found.misfit_p_value < 0.01 ? 1 : 0;
  }
  EXPECT_LE(num_warned, 5) << "of 100, where 1 is expected";
}

/// A search that looks at every level for each of its curves would take gigabytes at twenty
/// thousand levels.
TEST(PsychometricGoodness, ThousandsOfLevelsWithLapsesAreFittedAsFewAre) {
  core::RandomStream random(2, "many levels");
  std::vector<AnswerCount> rows;
  for (int level = 0; level < 3000; ++level) {
    const double z = random.uniform() * 4.0 - 2.0;
    const double probability = 0.04 + 0.92 * 0.5 * std::erfc(-z / std::sqrt(2.0));
    rows.push_back(
        {2.0 * std::exp(z * std::log(1.3)), random.with_probability(probability) ? 1 : 0, 1});
  }
  const PsychometricFit found = fit_psychometric(
      rows, {.reference = 2.0, .free_pse = true, .free_lapse = true, .intervals = false});
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  EXPECT_NEAR(*found.weber_fraction, 0.3, 0.05);
  EXPECT_NEAR(*found.lapse_rate, 0.04, 0.03);
  EXPECT_NEAR(*found.pse, 2.0, 0.05);
}

/// For single answers whose probability is about one half, the deviance is 2 ln 2 each,
/// whatever the answer.
TEST(PsychometricGoodness, SingleAnswersAboutAHalfAreNotFarFromAFlatCurve) {
  const std::string answers = "11100001000000101011";
  std::vector<AnswerCount> rows;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(answers.size() - 1);
    rows.push_back({std::exp(std::lerp(std::log(0.9), std::log(1.1), share)),
                    answers[i] == '1' ? 1 : 0, 1});
  }
  const PsychometricFit found = fit_psychometric(rows, {.reference = 1.0});
  ASSERT_EQ(found.status, FitStatus::kOk);
  ASSERT_TRUE(found.misfit_p_value.has_value());
  EXPECT_GT(*found.misfit_p_value, 0.05);
}

/// Grouped into tens, single answers nevertheless reveal a wrong curve.
TEST(PsychometricGoodness, SingleAnswersThatRiseAndFallAreFarFromEveryCurve) {
  std::vector<AnswerCount> rows;
  for (int level = 0; level < 80; ++level) {
    const bool is_in_the_middle = level >= 20 && level < 60;
    rows.push_back({1.0 + 0.01 * level, is_in_the_middle ? 1 : 0, 1});
  }
  const PsychometricFit found = fit_psychometric(rows, {.reference = 1.4, .free_pse = true});
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  EXPECT_LT(*found.misfit_p_value, 0.01);
}

}  // namespace psychometric_goodness_test
}  // namespace jnd::analysis
