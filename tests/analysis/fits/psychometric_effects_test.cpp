#include "analysis/fits/psychometric_effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.h"

namespace jnd::analysis {
namespace psychometric_effects_test {

std::vector<PsychometricEffect> effects_of(const std::vector<OrderedAnswers>& answers,
                                           double reference) {
  return psychometric_effects(answers, reference).effects;
}

TEST(PsychometricEffects, WithoutColumnsOnlyTheResponseBiasIsLeft) {
  const auto found = effects_of({{0.5, 2, 10}, {0.8, 4, 10}, {1.3, 8, 10}, {2.0, 9, 10}}, 1.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "response_bias");
  EXPECT_EQ(found[0].status, FitStatus::kOk);
}

TEST(PsychometricEffects, AnswersSymmetricAboutTheReferenceHaveNoBias) {
  const auto found = effects_of({{0.5, 2, 10}, {0.8, 4, 10}, {1.25, 6, 10}, {2.0, 8, 10}}, 1.0);
  EXPECT_NEAR(*found[0].estimate, 0.0, 1e-12);
  EXPECT_NEAR(*found[0].p_value, 1.0, 1e-6);
}

TEST(PsychometricEffects, SeparatedAnswersHaveNoneAndSayWhy) {
  const auto found =
      effects_of({{0.5, 0, 10}, {0.8, 0, 10}, {1.25, 10, 10}, {2.0, 10, 10}}, 1.0);
  EXPECT_EQ(found[0].status, FitStatus::kDegenerate);
  EXPECT_NE(found[0].reason.find("separated"), std::string::npos);
  EXPECT_FALSE(found[0].estimate);
}

TEST(PsychometricEffects, AnIntensityOfZeroIsRefused) {
  EXPECT_THROW((void)psychometric_effects({{0.0, 0, 1}}, 1.0), core::Error);
  EXPECT_THROW((void)psychometric_effects({{1.0, 0, 1}}, 0.0), core::Error);
}

TEST(PsychometricEffects, TheSlopeIsToldWithItsInterval) {
  // With z = 2 ln x at two levels, the answers lie on the line.
  const double below = 0.5 * std::erfc(2.0 * std::log(2.0) / std::sqrt(2.0));
  const PsychometricEffects found =
      psychometric_effects({{0.5, 100.0 * below, 100}, {2.0, 100.0 * (1.0 - below), 100}}, 1.0);
  EXPECT_NEAR(*found.slope, 2.0, 1e-9);
  EXPECT_LT(*found.slope_ci95.low, 2.0);
  EXPECT_NEAR(*found.slope_ci95.low + *found.slope_ci95.high, 4.0, 1e-9);
  EXPECT_TRUE(found.warnings.empty());
  EXPECT_FALSE(psychometric_effects({{0.5, 0, 10}, {2.0, 10, 10}}, 1.0).slope);
}

/// Returns early and late answers at two levels, with these numbers of "yes" of 20 each.
std::vector<OrderedAnswers> early_and_late(double early_low, double early_high, double late_low,
                                           double late_high) {
  return {{0.5, early_low, 20, 1.0},
          {2.0, early_high, 20, 2.0},
          {0.5, late_low, 20, 3.0},
          {2.0, late_high, 20, 4.0}};
}

TEST(PsychometricEffects, LearningIsNoShareOfASlopeThatMayBeNone) {
  const PsychometricEffects none = psychometric_effects(early_and_late(12, 8, 8, 13), 1.0);
  ASSERT_LE(*none.slope_ci95.low, 0.0);
  ASSERT_GE(*none.slope_ci95.high, 0.0);
  const PsychometricEffect& learning = none.effects.back();
  ASSERT_EQ(learning.name, "learning");
  EXPECT_EQ(learning.status, FitStatus::kOk);
  EXPECT_FALSE(learning.estimate);
  EXPECT_FALSE(learning.ci95.low);
  EXPECT_FALSE(learning.ci95.high);
  EXPECT_NE(learning.reason.find("not told from 0"), std::string::npos) << learning.reason;
  EXPECT_TRUE(learning.p_value) << "whether the slope changes is still tested";
  EXPECT_TRUE(none.effects.front().estimate);
  const PsychometricEffects some = psychometric_effects(early_and_late(6, 14, 3, 17), 1.0);
  ASSERT_GT(*some.slope_ci95.low, 0.0);
  EXPECT_GT(*some.effects.back().estimate, 0.0);
  EXPECT_EQ(some.effects.back().reason, "");
}

TEST(PsychometricEffects, AnswersThatFallAreAWarning) {
  const PsychometricEffects found = psychometric_effects(early_and_late(14, 6, 17, 3), 1.0);
  ASSERT_LT(*found.slope_ci95.high, 0.0);
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_NE(found.warnings[0].find("wrong way round"), std::string::npos) << found.warnings[0];
  EXPECT_TRUE(found.effects.back().estimate) << "a share of a slope that is told";
}

TEST(PsychometricEffects, AReferenceOutsideTheLevelsIsAWarning) {
  const std::vector<OrderedAnswers> answers = early_and_late(6, 14, 3, 17);
  for (const double outside : {0.4, 2.1}) {
    const PsychometricEffects found = psychometric_effects(answers, outside);
    ASSERT_EQ(found.warnings.size(), 1U) << outside;
    EXPECT_NE(found.warnings[0].find("response_bias and drift are extrapolated"),
              std::string::npos)
        << found.warnings[0];
  }
  for (const double inside : {0.5, 1.0, 2.0}) {
    EXPECT_TRUE(psychometric_effects(answers, inside).warnings.empty()) << inside;
  }
}

/// One set of answers has z = ln x plus the criterion of each session, the other has z = ln x
/// alone.
TEST(PsychometricEffects, SessionsThatScatterAreWarnedOf) {
  std::vector<OrderedAnswers> moved, steady;
  for (const double criterion : {-2.0, 2.0, 1.8, 1.2, -0.5}) {
    for (const double intensity : {0.5, 0.8, 1.25, 2.0}) {
      const auto yes = [&](double shift) {
        const double z = std::log(intensity) + shift;
        return std::round(40.0 * 0.5 * std::erfc(-z / std::sqrt(2.0)));
      };
      moved.push_back({.intensity = intensity, .num_yes = yes(criterion), .num_trials = 40.0});
      steady.push_back({.intensity = intensity, .num_yes = yes(0.0), .num_trials = 40.0});
    }
  }
  const std::vector<std::string> warnings = psychometric_effects(moved, 1.0).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("every p too small"), std::string::npos) << warnings[0];
  EXPECT_TRUE(psychometric_effects(steady, 1.0).warnings.empty());
}

/// Rows of one answer each show the form of the curve only together.
TEST(PsychometricEffects, RowsOfOneAnswerCountTogether) {
  std::vector<OrderedAnswers> answers;
  const double levels[] = {0.5, 0.8, 1.25, 2.0};
  const int yes_of_40[] = {20, 2, 38, 20};
  for (int level = 0; level < 4; ++level) {
    for (int row = 0; row < 40; ++row) {
      answers.push_back(
          {.intensity = levels[level], .num_yes = row < yes_of_40[level] ? 1.0 : 0.0});
    }
  }
  const std::vector<std::string> warnings = psychometric_effects(answers, 1.0).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("scatter more"), std::string::npos) << warnings[0];
}

/// Returns one answer at one level, with the number of its trial.
OrderedAnswers answer(double intensity, bool yes, double trial) {
  return {.intensity = intensity, .num_yes = yes ? 1.0 : 0.0, .trial = trial};
}

TEST(TrialTrend, IsTheCovarianceOverItsPermutationsByHand) {
  // Two answers above the reference are no and then yes, at times -0.5 and 0.5, so the
  // covariance is 0.5. The two possible orders give +-0.5, so the sd is 0.5 and z is 1.
  const TrialTrend up = trial_trend({answer(2.0, false, 1), answer(2.0, true, 2)}, 1.0);
  EXPECT_NEAR(*up.drift, 1.0, 1e-12);
  EXPECT_NEAR(*up.learning, 1.0, 1e-12);
  // Below the reference, a late yes is a late error.
  const TrialTrend down = trial_trend({answer(0.5, false, 1), answer(0.5, true, 2)}, 1.0);
  EXPECT_NEAR(*down.drift, 1.0, 1e-12);
  EXPECT_NEAR(*down.learning, -1.0, 1e-12);
}

TEST(TrialTrend, APerfectOrSilentObserverHasNone) {
  const TrialTrend perfect = trial_trend({answer(2.0, true, 1), answer(2.0, true, 2)}, 1.0);
  EXPECT_FALSE(perfect.drift);
  EXPECT_FALSE(perfect.learning);
  EXPECT_FALSE(trial_trend({}, 1.0).drift);
}

/// The sum of so many terms is rounded. The search must not take the rounding for a step that
/// makes the fit worse.
TEST(PsychometricEffects, HalfAMillionSingleAnswersAreFittedAsTheirSums) {
  const std::vector<OrderedAnswers> sums = {{1.0, 17000.0, 100000.0},
                                            {1.5, 33000.0, 100000.0},
                                            {2.0, 51000.0, 100000.0},
                                            {2.5, 66000.0, 100000.0},
                                            {3.0, 83000.0, 100000.0}};
  std::vector<OrderedAnswers> singles;
  for (const OrderedAnswers& row : sums) {
    for (double answer = 0.0; answer < row.num_trials; answer += 1.0) {
      singles.push_back({row.intensity, answer < row.num_yes ? 1.0 : 0.0, 1.0});
    }
  }
  const auto pooled = effects_of(sums, 2.0), single = effects_of(singles, 2.0);
  ASSERT_EQ(single[0].status, FitStatus::kOk) << single[0].reason;
  EXPECT_NEAR(*single[0].estimate, *pooled[0].estimate, 1e-8);
}

}  // namespace psychometric_effects_test
}  // namespace jnd::analysis
