#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analysis/statistics/comparison.h"

namespace few_assumptions_test {

using namespace jnd::analysis;
using Values = std::vector<double>;

TEST(KendallCorrelation, WithoutTiesIsExact) {
  // Of 15 pairs 12 are concordant. R 4.2.2: cor.test(method = "kendall").
  const Comparison found = kendall_correlation({1, 2, 3, 4, 5, 6}, {2, 1, 4, 3, 6, 5});
  EXPECT_NEAR(*found.estimate, 0.6, 1e-12);
  EXPECT_EQ(found.statistic, 12.0);
  EXPECT_NEAR(*found.p_value, 0.1361111111111111, 1e-12) << "98 of 720 orders";
  const Comparison whole = kendall_correlation({1, 2, 3, 4}, {1, 2, 3, 4});
  EXPECT_NEAR(*whole.p_value, 2.0 / 24.0, 1e-12);
}

TEST(KendallCorrelation, WithTiesIsNormalWithTheirVariance) {
  // The values are from R 4.2.2: cor.test(method = "kendall", exact = FALSE).
  const Comparison found = kendall_correlation({1, 2, 2, 4, 5, 6}, {2, 1, 4, 4, 6, 5});
  EXPECT_NEAR(*found.estimate, 0.6428571429, 1e-9);
  EXPECT_NEAR(*found.statistic, 1.7516226, 1e-6);
  EXPECT_NEAR(*found.p_value, 0.07983872, 1e-7);
}

TEST(KendallCorrelation, AColumnOfOneValueHasNone) {
  EXPECT_EQ(kendall_correlation({1, 1, 1}, {1, 2, 3}).status, FitStatus::kDegenerate);
  EXPECT_EQ(kendall_correlation({1, 2}, {1, 2}).status, FitStatus::kDegenerate);
}

TEST(SignTest, CountsSignsAndLeavesEqualPairsOut) {
  // The differences are 1, 2, 1, 4, 0. Four of four are above 0, so p = 2 / 16.
  const Comparison found = sign_test({1, 3, 4, 8, 5}, {0, 1, 3, 4, 5});
  EXPECT_EQ(found.statistic, 4.0);
  EXPECT_EQ(found.num_zeros, 1);
  EXPECT_NEAR(*found.p_value, 0.125, 1e-15);
  EXPECT_EQ(found.estimate, 1.0);
  EXPECT_FALSE(found.ci95.low.has_value()) << "five differences are too few";
}

TEST(SignTest, TheIntervalOfTheMedianIsByOrder) {
  // These are the second and the ninth of ten: P(fewer than 2 of 10) = 11 / 1024 on either
  // side.
  Values a;
  for (int i = 1; i <= 10; ++i) a.push_back(i);
  const Comparison found = sign_test(a, Values(10, 0.0));
  EXPECT_EQ(found.ci95.low, 2.0);
  EXPECT_EQ(found.ci95.high, 9.0);
  EXPECT_EQ(found.estimate, 5.5);
}

TEST(SignTest, EqualPairsAloneHaveNoSign) {
  EXPECT_EQ(sign_test({1, 2}, {1, 2}).status, FitStatus::kDegenerate);
}

TEST(PermutationTest, OfFourDifferencesOfOneSignIsTwoOfSixteen) {
  const Comparison found = permutation_test({1, 3, 4, 8}, {0, 1, 3, 4});
  EXPECT_NEAR(*found.p_value, 0.125, 1e-15);
  EXPECT_EQ(found.estimate, 2.0);
}

TEST(PermutationTest, DifferencesThatAreAllAlikeAreTheClearestThereAre) {
  const Comparison found = permutation_test({2, 3, 4, 5}, {1, 2, 3, 4});
  EXPECT_EQ(found.status, FitStatus::kOk);
  EXPECT_NEAR(*found.p_value, 2.0 / 16.0, 1e-15);
  EXPECT_EQ(found.estimate, 1.0);
  EXPECT_EQ(found.reason, "");
  const Comparison rounded = permutation_test({1.1, 2.1, 3.1}, {1.0, 2.0, 3.0});
  EXPECT_NEAR(*rounded.p_value, 2.0 / 8.0, 1e-15) << "alike but for rounding";
  EXPECT_EQ(*permutation_test({1, 2}, {1, 2}).p_value, 1.0) << "no difference at all";
  EXPECT_EQ(permutation_test({2}, {1}).status, FitStatus::kDegenerate) << "one pair";
}

TEST(GroupPermutationTest, GroupsWhoseValuesAreAllAlikeAreTheClearestThereAre) {
  const Comparison found = group_permutation_test({5, 5, 5}, {1, 1, 1});
  EXPECT_EQ(found.status, FitStatus::kOk);
  EXPECT_NEAR(*found.p_value, 2.0 / 20.0, 1e-15);
  EXPECT_EQ(found.estimate, 4.0);
  EXPECT_EQ(group_permutation_test({5}, {1, 1}).status, FitStatus::kDegenerate);
}

TEST(PermutationTest, OfManyPairsIsDrawnAndNearTheTTest) {
  Values a, b(40, 0.0);
  for (int i = 0; i < 40; ++i) a.push_back(std::sin(i * 1.7) + 0.25);
  const Comparison drawn = permutation_test(a, b), t = paired_t_test(a, b);
  EXPECT_NEAR(*drawn.p_value, *t.p_value, 0.01);
  EXPECT_NE(drawn.method.find("99999 arrangements drawn"), std::string::npos);
  EXPECT_EQ(*permutation_test(a, b).p_value, *drawn.p_value) << "the same data, the same p";
}

TEST(GroupPermutationTest, OfTwoAndTwoIsTwoOfSixGroupings) {
  const Comparison found = group_permutation_test({1, 2}, {3, 4});
  EXPECT_NEAR(*found.p_value, 1.0 / 3.0, 1e-15);
  EXPECT_EQ(found.estimate, -2.0);
}

TEST(GroupPermutationTest, OfManyIsDrawnAndNearWelchsTest) {
  Values a, b;
  for (int i = 0; i < 30; ++i) {
    a.push_back(std::sin(i * 1.7) + 0.3);
    b.push_back(std::cos(i * 2.3));
  }
  EXPECT_NEAR(*group_permutation_test(a, b).p_value, *welch_t_test(a, b).p_value, 0.01);
}

}  // namespace few_assumptions_test
