#include "analysis/fits/psychometric_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace jnd::analysis {
namespace {

TEST(PsychometricEffects, WithoutColumnsOnlyTheResponseBiasIsLeft) {
  const std::vector<PsychometricEffect> found =
      psychometric_effects({{0.5, 2, 10}, {0.8, 4, 10}, {1.3, 8, 10}, {2.0, 9, 10}}, 1.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "response_bias");
  EXPECT_EQ(found[0].status, FitStatus::kOk);
}

TEST(PsychometricEffects, AnswersSymmetricAboutTheReferenceHaveNoBias) {
  const std::vector<PsychometricEffect> found =
      psychometric_effects({{0.5, 2, 10}, {0.8, 4, 10}, {1.25, 6, 10}, {2.0, 8, 10}}, 1.0);
  EXPECT_NEAR(*found[0].estimate, 0.0, 1e-12);
  EXPECT_NEAR(*found[0].p_value, 1.0, 1e-6);
}

TEST(PsychometricEffects, SeparatedAnswersHaveNoneAndSayWhy) {
  const std::vector<PsychometricEffect> found =
      psychometric_effects({{0.5, 0, 10}, {0.8, 0, 10}, {1.25, 10, 10}, {2.0, 10, 10}}, 1.0);
  EXPECT_EQ(found[0].status, FitStatus::kDegenerate);
  EXPECT_NE(found[0].reason.find("separated"), std::string::npos);
  EXPECT_FALSE(found[0].estimate);
}

TEST(PsychometricEffects, AnIntensityOfZeroIsRefused) {
  EXPECT_THROW((void)psychometric_effects({{0.0, 0, 1}}, 1.0), core::Error);
  EXPECT_THROW((void)psychometric_effects({{1.0, 0, 1}}, 0.0), core::Error);
}

/// One answer at one level, at a running number.
OrderedAnswers answer(double intensity, bool yes, double trial) {
  return {.intensity = intensity, .num_yes = yes ? 1.0 : 0.0, .trial = trial};
}

TEST(TrialTrend, IsTheCovarianceOverItsPermutationsByHand) {
  // Two answers above the reference, no then yes, at times -0.5 and 0.5: covariance 0.5; in
  // either order it is +-0.5, so its sd is 0.5 and z is 1.
  const TrialTrend up = trial_trend({answer(2.0, false, 1), answer(2.0, true, 2)}, 1.0);
  EXPECT_NEAR(*up.drift, 1.0, 1e-12);
  EXPECT_NEAR(*up.learning, 1.0, 1e-12);
  // Below the reference a late yes is a late error.
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

}  // namespace
}  // namespace jnd::analysis
