#include "analysis/statistics/equivalence_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace jnd::analysis {
namespace equivalence_test_test {

using Scale = EquivalenceMargin::Scale;

// The differences are 1, 2, 3: mean 2, standard error 1 / sqrt(3), two degrees of freedom.
// Student's t with two degrees of freedom has the distribution function 1/2 + t / (2 sqrt(2 +
// t^2)) and the 95 % quantile 2.91999.
TEST(EquivalenceTest, OfPairsIsTheLargerOfTwoOneSidedTests) {
  const std::vector<double> a = {3.0, 5.0, 7.0}, b = {2.0, 3.0, 4.0};
  const EquivalenceTest test = equivalence_test(a, b, true, {Scale::kDifference, 5.0});
  EXPECT_EQ(test.status, FitStatus::kOk);
  EXPECT_NEAR(*test.estimate, 2.0, 1e-12);
  EXPECT_NEAR(*test.degrees_of_freedom, 2.0, 1e-12);
  const double t = (5.0 - 2.0) * std::sqrt(3.0);
  EXPECT_NEAR(*test.p_value, 0.5 - t / (2.0 * std::sqrt(2.0 + t * t)), 1e-12);
  EXPECT_NEAR(*test.ci90.low, 2.0 - 2.9199856 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(*test.ci90.high, 2.0 + 2.9199856 / std::sqrt(3.0), 1e-6);
  EXPECT_TRUE(test.is_equivalent());
  // The interval reaches to 3.69, so equivalence within 3.6 is not shown.
  EXPECT_FALSE(equivalence_test(a, b, true, {Scale::kDifference, 3.6}).is_equivalent());
  EXPECT_TRUE(equivalence_test(a, b, true, {Scale::kDifference, 3.7}).is_equivalent());
}

// Welch (1947) by hand: with variances 1 and 4 and three values each, the error is sqrt(5 / 3),
// and the degrees of freedom are (5 / 3)^2 / ((1 / 9 + 16 / 9) / 2) = 50 / 17.
TEST(EquivalenceTest, OfGroupsIsByWelch) {
  const EquivalenceTest test =
      equivalence_test({1.0, 2.0, 3.0}, {0.0, 2.0, 4.0}, false, {Scale::kDifference, 1.0});
  EXPECT_NEAR(*test.estimate, 0.0, 1e-12);
  EXPECT_NEAR(*test.degrees_of_freedom, 50.0 / 17.0, 1e-12);
  EXPECT_NEAR(*test.ci90.high, -*test.ci90.low, 1e-12);
  EXPECT_FALSE(test.is_equivalent());
}

TEST(EquivalenceTest, OfRatiosIsThatOfTheLogarithmsAndTellsARatio) {
  const std::vector<double> a = {2.0, 4.4, 8.2}, b = {1.0, 2.0, 4.0};
  const EquivalenceTest test = equivalence_test(a, b, true, {Scale::kRatio, 2.5});
  EXPECT_NEAR(*test.estimate, std::cbrt(2.0 * 2.2 * 2.05), 1e-12);
  std::vector<double> log_a, log_b;
  for (const double value : a) log_a.push_back(std::log(value));
  for (const double value : b) log_b.push_back(std::log(value));
  const EquivalenceTest of_logs =
      equivalence_test(log_a, log_b, true, {Scale::kDifference, std::log(2.5)});
  EXPECT_NEAR(*test.p_value, *of_logs.p_value, 1e-14);
  EXPECT_NEAR(*test.ci90.low, std::exp(*of_logs.ci90.low), 1e-12);
  EXPECT_EQ(equivalence_test({0.0, 1.0}, {1.0, 2.0}, true, {Scale::kRatio, 2.0}).status,
            FitStatus::kDegenerate);
}

TEST(EquivalenceTest, WhatIsNoTestIsRefusedOrSaysWhy) {
  const std::vector<double> a = {1.0, 2.0}, b = {0.0, 1.0};
  EXPECT_THROW((void)equivalence_test(a, b, true, {Scale::kDifference, 0.0}), core::Error);
  EXPECT_THROW((void)equivalence_test(a, b, true, {Scale::kRatio, 1.0}), core::Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)equivalence_test(a, b, true, {Scale::kRatio, nan}), core::Error);
  EXPECT_THROW((void)equivalence_test({nan}, {1.0}, true, {}), core::Error);
  EXPECT_THROW((void)equivalence_test({1.0}, {1.0, 2.0}, true, {Scale::kDifference, 1.0}),
               core::Error);
  const EquivalenceTest same = equivalence_test(a, b, true, {Scale::kDifference, 2.0});
  EXPECT_EQ(same.status, FitStatus::kDegenerate);
  EXPECT_FALSE(same.reason.empty());
  EXPECT_FALSE(same.p_value.has_value());
}

}  // namespace equivalence_test_test
}  // namespace jnd::analysis
