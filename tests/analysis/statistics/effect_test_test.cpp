#include "analysis/statistics/effect_test.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statistics/comparison.h"
#include "core/error.h"

namespace jnd::analysis {
namespace effect_test_test {

// The differences of ten pairs (Student 1908, extra hours of sleep), as in R's `sleep`:
// t.test(extra ~ group, paired = TRUE) has t = -4.0621, df = 9, p = 0.002833, mean -1.58,
// interval -2.4598858 to -0.7001142.
const std::vector<double> kSleep = {-1.2, -2.4, -1.3, -1.3, 0.0, -1.0, -1.8, -0.8, -4.6, -1.4};

TEST(EffectTest, OfOneGroupIsStudentsT) {
  const auto estimate = contrast_estimate({kSleep});
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->effect, -1.58, 1e-12);
  EXPECT_NEAR(estimate->statistic(), -4.0621277, 1e-6);
  EXPECT_NEAR(estimate->degrees_of_freedom, 9.0, 1e-12);
  EXPECT_NEAR(p_value_of(*estimate, Tail::kTwoSided), 0.00283289, 1e-8);
  EXPECT_NEAR(p_value_of(*estimate, Tail::kLess), 0.5 * 0.00283289, 1e-8);
  EXPECT_NEAR(p_value_of(*estimate, Tail::kGreater), 1.0 - 0.5 * 0.00283289, 1e-8);
  const Interval interval = interval_of(*estimate, 0.95);
  EXPECT_NEAR(*interval.low, -2.4598858, 1e-6);
  EXPECT_NEAR(*interval.high, -0.7001142, 1e-6);
}

TEST(EffectTest, OfTwoGroupsIsWelchsT) {
  const std::vector<double> a = {3.1, 4.7, 2.2, 6.0, 5.5}, b = {1.0, 1.4, 0.7, 1.1};
  std::vector<double> minus_b = b;
  for (double& value : minus_b) value = -value;
  const auto estimate = contrast_estimate({a, minus_b});
  const Comparison welch = welch_t_test(a, b);
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->effect, *welch.estimate, 1e-12);
  EXPECT_NEAR(estimate->statistic(), *welch.statistic, 1e-10);
  EXPECT_NEAR(estimate->degrees_of_freedom, *welch.degrees_of_freedom, 1e-10);
  EXPECT_NEAR(p_value_of(*estimate, Tail::kTwoSided), *welch.p_value, 1e-10);
}

TEST(EffectTest, WithoutSpreadOrPeopleThereIsNone) {
  EXPECT_FALSE(contrast_estimate({{1.0}}));
  EXPECT_FALSE(contrast_estimate({{1.0, 1.0, 1.0}}));
  EXPECT_FALSE(contrast_estimate({{1.0, 2.0}, {3.0}}));
  EXPECT_FALSE(contrast_estimate({}));
}

// By hand: t = 0.3 / 0.1 and 0.1 / 0.1 with 12 degrees of freedom. The larger p is 1 - F(1).
TEST(EffectTest, EquivalenceIsTheLargerOfBothOneSidedTests) {
  const EffectEstimate estimate{0.1, 0.1, 12.0};
  EXPECT_NEAR(equivalence_p_value(estimate, 0.2), 0.1685, 1e-3);
  EXPECT_NEAR(equivalence_p_value({-0.1, 0.1, 12.0}, 0.2), 0.1685, 1e-3) << "either side";
  // An effect at the margin itself is equally likely on either side of it.
  EXPECT_NEAR(equivalence_p_value(estimate, 0.1), 0.5, 1e-12);
  EXPECT_THROW((void)equivalence_p_value(estimate, 0.0), core::Error);
}

TEST(EffectTest, EquivalenceGoesWithTheIntervalOfTwiceAlpha) {
  for (const double margin : {0.1, 0.25, 0.27, 0.28, 0.29, 0.3, 0.5}) {
    const EffectEstimate estimate{0.1, 0.1, 12.0};
    const Interval interval = interval_of(estimate, 0.9);
    const bool lies_within = *interval.low > -margin && *interval.high < margin;
    EXPECT_EQ(equivalence_p_value(estimate, margin) < 0.05, lies_within) << margin;
  }
}

TEST(EffectTest, BonferroniCountsWhatWasTested) {
  const auto adjusted = bonferroni_adjusted({0.01, std::nullopt, 0.4, 0.02});
  EXPECT_DOUBLE_EQ(*adjusted[0], 0.03);
  EXPECT_FALSE(adjusted[1]);
  EXPECT_DOUBLE_EQ(*adjusted[2], 1.0);
  EXPECT_DOUBLE_EQ(*adjusted[3], 0.06);
}

}  // namespace effect_test_test
}  // namespace jnd::analysis
