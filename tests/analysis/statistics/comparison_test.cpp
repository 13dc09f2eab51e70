#include "analysis/statistics/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace jnd::analysis {
namespace comparison_test {

using testing::HasSubstr;

/// Expects a degenerate comparison for this reason, without any number.
void expect_degenerate(const Comparison& result, const char* why) {
  EXPECT_EQ(result.status, FitStatus::kDegenerate);
  EXPECT_THAT(result.reason, HasSubstr(why));
  EXPECT_FALSE(result.statistic.has_value());
  EXPECT_FALSE(result.p_value.has_value());
  EXPECT_FALSE(result.ci95.low.has_value());
}

Comparison paired(const std::vector<double>& a, const std::vector<double>& b) {
  return paired_t_test(a, b);
}
Comparison welch(const std::vector<double>& a, const std::vector<double>& b) {
  return welch_t_test(a, b);
}

TEST(Comparison, PairedTIsWorkedByHand) {
  // The differences are 1, 2, 3: mean 2, sd 1, t = 2 sqrt 3, and with two degrees of freedom p
  // = 1 - t / sqrt(t^2 + 2) = 1 - sqrt(12/14).
  const Comparison result = paired_t_test({2, 4, 6}, {1, 2, 3});
  EXPECT_EQ(result.status, FitStatus::kOk);
  EXPECT_DOUBLE_EQ(*result.estimate, 2.0);
  EXPECT_DOUBLE_EQ(*result.statistic, 2.0 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(*result.degrees_of_freedom, 2.0);
  EXPECT_NEAR(*result.p_value, 1.0 - std::sqrt(12.0 / 14.0), 1e-14);
  EXPECT_DOUBLE_EQ(*result.cohen_dz, 2.0);
  EXPECT_NEAR(*result.ci95.low, 2.0 - 4.302652729749464 / std::sqrt(3.0), 1e-12);
}

TEST(Comparison, PublishedTestsOfTheThesisComeOutAsPrinted) {
  // Schmidt (2018), sec. 5: maximum velocity in D and E, t(20) = 2.83, p = 0.010.
  const Comparison speed = pooled_t_test({0.4513, 0.0625, 11}, {0.3748, 0.0644, 11});
  EXPECT_NEAR(*speed.statistic, 2.83, 0.005);
  EXPECT_EQ(*speed.degrees_of_freedom, 20.0);
  EXPECT_NEAR(*speed.p_value, 0.010, 0.0005);
  // The Weber fractions are thresholds over references: t(24) = 3.81, p = 0.0008.
  const Comparison weber =
      pooled_t_test({1.33 / 1.853, 0.37 / 1.853, 13}, {5.53 / 16.06, 4.68 / 16.06, 13});
  EXPECT_NEAR(*weber.statistic, 3.81, 0.005);
  EXPECT_EQ(*weber.degrees_of_freedom, 24.0);
  EXPECT_NEAR(*weber.p_value, 0.0008, 0.00005);
}

TEST(Comparison, SwappingTheColumnsOnlyTurnsTheSign) {
  const std::vector<double> a = {0.7, 0.9, 0.4, 1.3, 0.8}, b = {0.2, 0.5, 0.6, 0.3, 0.1};
  for (const auto test : {paired, welch}) {
    const Comparison one = test(a, b), other = test(b, a);
    EXPECT_DOUBLE_EQ(*one.estimate, -*other.estimate);
    EXPECT_DOUBLE_EQ(*one.statistic, -*other.statistic);
    EXPECT_DOUBLE_EQ(*one.p_value, *other.p_value);
    EXPECT_DOUBLE_EQ(*one.ci95.low, -*other.ci95.high);
  }
  EXPECT_DOUBLE_EQ(*wilcoxon_test(a, b).p_value, *wilcoxon_test(b, a).p_value);
  EXPECT_DOUBLE_EQ(*pearson_correlation(a, b).estimate, *pearson_correlation(b, a).estimate);
}

TEST(Comparison, TheUnitOfTheValuesOnlyScalesTheEstimate) {
  const std::vector<double> a = {0.7, 0.9, 0.4, 1.3, 0.8}, b = {0.2, 0.5, 0.6, 0.3, 0.1};
  for (const auto test : {paired, welch, wilcoxon_test, pearson_correlation}) {
    const Comparison plain = test(a, b);
    for (const double factor : {1e-300, 1e-160, 1e160, 1e300}) {
      std::vector<double> scaled_a = a, scaled_b = b;
      for (double& value : scaled_a) value *= factor;
      for (double& value : scaled_b) value *= factor;
      const Comparison found = test(scaled_a, scaled_b);
      ASSERT_EQ(found.status, FitStatus::kOk) << plain.method << factor << found.reason;
      EXPECT_NEAR(*found.statistic, *plain.statistic, 1e-9) << plain.method << factor;
      EXPECT_NEAR(*found.p_value, *plain.p_value, 1e-9) << plain.method << factor;
      if (plain.kind == Comparison::Kind::kPearson) continue;
      EXPECT_NEAR(*found.estimate / factor, *plain.estimate, 1e-9) << plain.method << factor;
    }
  }
}

TEST(Comparison, WelchAndPooledAgreeForGroupsOfOneSizeAndSpread) {
  const std::vector<double> a = {1, 2, 3, 4}, b = {5, 6, 7, 8};
  const Comparison welch = welch_t_test(a, b);
  const double sd = std::sqrt(5.0 / 3.0);
  const Comparison pooled = pooled_t_test({2.5, sd, 4}, {6.5, sd, 4});
  EXPECT_NEAR(*welch.statistic, *pooled.statistic, 1e-12);
  EXPECT_NEAR(*welch.degrees_of_freedom, 6.0, 1e-12);
}

TEST(Comparison, CorrelationIsWorkedByHand) {
  // r of (1,2,3,4) with (1,3,2,4) is 4/5, so t = 0.8 sqrt(2) / 0.6.
  const Comparison result = pearson_correlation({1, 2, 3, 4}, {1, 3, 2, 4});
  EXPECT_NEAR(*result.estimate, 0.8, 1e-14);
  EXPECT_NEAR(*result.statistic, 0.8 * std::sqrt(2.0) / 0.6, 1e-13);
  EXPECT_NEAR(*result.p_value, 0.2, 1e-13);  // With two degrees of freedom, p = 1 - |r|.
  EXPECT_NEAR(*result.ci95.high, std::tanh(std::atanh(0.8) + 1.959963984540054), 1e-13);
}

TEST(Comparison, ThreePairsHaveACorrelationButNoInterval) {
  const Comparison result = pearson_correlation({1, 2, 3}, {1, 3, 2});
  EXPECT_EQ(result.status, FitStatus::kOk);
  EXPECT_NEAR(*result.estimate, 0.5, 1e-14);
  EXPECT_FALSE(result.ci95.low.has_value());
}

TEST(Comparison, WhatIsUndefinedIsNeverANumber) {
  expect_degenerate(paired_t_test({}, {}), "too few");
  expect_degenerate(paired_t_test({1}, {2}), "too few");
  expect_degenerate(paired_t_test({1.1, 2.1, 3.1}, {1, 2, 3}), "alike");
  expect_degenerate(welch_t_test({1}, {2, 3}), "too few");
  expect_degenerate(welch_t_test({1, 1}, {2, 2}), "alike");
  expect_degenerate(pearson_correlation({1, 2}, {2, 1}), "too few");
  expect_degenerate(pearson_correlation({0.1, 0.1, 0.1}, {2, 1, 3}), "constant");
  expect_degenerate(pearson_correlation({1, 2, 3}, {0.3, 0.2, 0.1}), "line");
  expect_degenerate(wilcoxon_test({}, {}), "no pairs");
  expect_degenerate(wilcoxon_test({1, 2}, {1, 2}), "nothing to rank");
  expect_degenerate(pooled_t_test({1, 0, 2}, {2, 0, 2}), "deviations are 0");
  EXPECT_EQ(*pearson_correlation({1, 2, 3}, {0.3, 0.2, 0.1}).estimate, -1.0);
  EXPECT_NEAR(*paired_t_test({1.1, 2.1}, {1, 2}).estimate, 0.1, 1e-12);
}

TEST(Comparison, OneGroupWithoutSpreadIsStillATest) {
  const Comparison result = welch_t_test({1, 1, 1}, {2, 3, 4});
  EXPECT_EQ(result.status, FitStatus::kOk);
  EXPECT_NEAR(*result.degrees_of_freedom, 2.0, 1e-12);
}

TEST(Comparison, RefusesColumnsThatDoNotPair) {
  EXPECT_THROW((void)paired_t_test({1, 2}, {1}), core::Error);
  EXPECT_THROW((void)welch_t_test({1, std::nan("")}, {1, 2}), core::Error);
  EXPECT_THROW((void)pooled_t_test({1, -1, 3}, {1, 1, 3}), core::Error);
}

}  // namespace comparison_test
}  // namespace jnd::analysis
