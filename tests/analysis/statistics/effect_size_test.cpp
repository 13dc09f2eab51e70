#include "analysis/statistics/effect_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace jnd::analysis {
namespace effect_size_test {

TEST(EffectSize, HedgesFactorIsTheExactOneAndTendsToOne) {
  // At two degrees of freedom the factor is gamma(1) / (sqrt(1) gamma(1/2)).
  EXPECT_NEAR(hedges_factor(2.0), 1.0 / std::sqrt(std::numbers::pi), 1e-14);
  // The factor is close to 1 - 3 / (4 m - 1).
  EXPECT_NEAR(hedges_factor(24.0), 1.0 - 3.0 / 95.0, 1e-4);
  EXPECT_NEAR(hedges_factor(1e6), 1.0, 1e-6);
}

TEST(EffectSize, TheIntervalOfTheNoncentralityHoldsTAndTurnsWithItsSign) {
  for (const double t : {-30.0, -2.5, 0.0, 0.3, 8.0, 200.0}) {
    for (const double degrees_of_freedom : {1.0, 4.0, 12.0, 60.0}) {
      const Interval interval = noncentrality_ci95(t, degrees_of_freedom);
      ASSERT_TRUE(interval.low && interval.high) << t << ' ' << degrees_of_freedom;
      EXPECT_LT(*interval.low, t);
      EXPECT_GT(*interval.high, t);
      const Interval turned = noncentrality_ci95(-t, degrees_of_freedom);
      EXPECT_NEAR(*turned.high, -*interval.low, 1e-6 * (1.0 + std::fabs(t)));
    }
  }
}

TEST(EffectSize, WithoutEffectTheIntervalIsTheNormalOne) {
  // T is 0 exactly where the numerator is 0, whatever the degrees of freedom.
  const Interval interval = noncentrality_ci95(0.0, 7.0);
  EXPECT_NEAR(*interval.low, -1.959963984540054, 1e-9);
  EXPECT_NEAR(*interval.high, 1.959963984540054, 1e-9);
}

TEST(EffectSize, WhatCannotBeComputedIsOpenNotWrong) {
  for (const double t : {1e4, -1e12, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const Interval interval = noncentrality_ci95(t, 5.0);
    EXPECT_FALSE(interval.low.has_value());
    EXPECT_FALSE(interval.high.has_value());
  }
}

TEST(EffectSize, OfGroupsDoesNotChangeWithTheUnit) {
  const std::vector<double> a = {1.2, 2.3, 2.9, 4.4}, b = {0.4, 1.1, 0.8};
  std::vector<double> large_a, large_b;
  for (const double value : a) large_a.push_back(1e200 * value);
  for (const double value : b) large_b.push_back(1e200 * value);
  const Comparison small = welch_t_test(a, b), large = welch_t_test(large_a, large_b);
  EXPECT_NEAR(*small.hedges_g, *large.hedges_g, 1e-12);
  EXPECT_NEAR(*small.hedges_g_ci95.low, *large.hedges_g_ci95.low, 1e-9);
  EXPECT_LT(*small.hedges_g_ci95.low, *small.hedges_g);
  EXPECT_GT(*small.hedges_g_ci95.high, *small.hedges_g);
}

/// The variances are 9 and 1, with the errors 9 / 2 and 1 / 3. By hand, g is the difference
/// over the root of 5, with the degrees of freedom (1)(2) 10^2 / (2 9^2 + 1 1^2).
TEST(EffectSize, OfGroupsTakesTheirSpreadsAsTheyAre) {
  Comparison comparison;
  add_effect_of_groups(comparison, {.mean = 4.0, .standard_deviation = 3.0, .num_values = 2},
                       {.mean = 1.0, .standard_deviation = 1.0, .num_values = 3});
  const double factor = hedges_factor(200.0 / 163.0);
  EXPECT_NEAR(*comparison.hedges_g, factor * 3.0 / std::sqrt(5.0), 1e-12);
  const double error = 4.5 + 1.0 / 3.0;
  const Interval t = noncentrality_ci95(3.0 / std::sqrt(error),
                                        error * error / (4.5 * 4.5 / 1.0 + 1.0 / 9.0 / 2.0));
  EXPECT_NEAR(*comparison.hedges_g_ci95.high, factor * *t.high * std::sqrt(error / 5.0), 1e-9);
}

/// Eight values vary and 24 hardly do. With the pooled standard deviation, the interval was
/// 0.07 to 1.69 beside a p of .20.
TEST(EffectSize, OfGroupsAgreesWithWelchsTest) {
  const Comparison found =
      welch_t_test({3.55, 5.56, 5.23, -1.37, -.04, 1.84, -.25, -2.28},
                   {1.03, -1.45, -.02, -.52, 1.01, -1,   .24, -1.01, .06,   1.19, -1.26, -.22,
                    .17,  1,     .26,  1.35, .04,  -.99, .12, 1.78,  -1.05, -.69, .03,   .65});
  EXPECT_NEAR(*found.p_value, 0.2027, 5e-4);
  EXPECT_LT(*found.hedges_g_ci95.low, 0.0);
  EXPECT_GT(*found.hedges_g_ci95.high, *found.hedges_g);
}

TEST(EffectSize, FishersIntervalIsOpenWhereTheRanksAgreeWholly) {
  EXPECT_FALSE(fisher_interval(1.0, 0.3).low.has_value());
  EXPECT_FALSE(fisher_interval(-1.0, 0.3).high.has_value());
  EXPECT_NEAR(*fisher_interval(0.0, 0.5).high, std::tanh(0.979981992270027), 1e-12);
}

}  // namespace effect_size_test
}  // namespace jnd::analysis
