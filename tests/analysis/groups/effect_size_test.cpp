#include "analysis/groups/effect_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace jnd::analysis {
namespace {

TEST(EffectSize, HedgesFactorIsTheExactOneAndTendsToOne) {
  // gamma(1) / (sqrt(1) gamma(1/2)) at two degrees of freedom.
  EXPECT_NEAR(hedges_factor(2.0), 1.0 / std::sqrt(std::numbers::pi), 1e-14);
  // Close to 1 - 3 / (4 m - 1).
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
  // T is 0 exactly where the numerator is, whatever the degrees of freedom.
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

TEST(EffectSize, FishersIntervalIsOpenWhereTheRanksAgreeWholly) {
  EXPECT_FALSE(fisher_interval(1.0, 0.3).low.has_value());
  EXPECT_FALSE(fisher_interval(-1.0, 0.3).high.has_value());
  EXPECT_NEAR(*fisher_interval(0.0, 0.5).high, std::tanh(0.979981992270027), 1e-12);
}

}  // namespace
}  // namespace jnd::analysis
