#include "analysis/statistics/signed_rank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace signed_rank_test {

TEST(SignedRank, DistributionOfThreeIsCountedByHand) {
  // The sums of subsets of {1, 2, 3} are 0, 1, 2, 3, 3, 4, 5, 6.
  EXPECT_DOUBLE_EQ(signed_rank_cdf(3, 0.0), 1.0 / 8.0);
  EXPECT_DOUBLE_EQ(signed_rank_cdf(3, 2.9), 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(signed_rank_cdf(3, 3.0), 5.0 / 8.0);
  EXPECT_DOUBLE_EQ(signed_rank_cdf(3, 6.0), 1.0);
}

TEST(SignedRank, SixOfOneSignAreTheFewestThatRejectAtFivePercent) {
  const SignedRanks five = signed_ranks({1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(five.p_value, 2.0 / 32.0);
  EXPECT_FALSE(five.median_ci95.low.has_value());
  const SignedRanks six = signed_ranks({1, 2, 3, 4, 5, 6});
  EXPECT_TRUE(six.exact);
  EXPECT_DOUBLE_EQ(six.p_value, 2.0 / 64.0);
  EXPECT_DOUBLE_EQ(*six.median, 3.5);
  EXPECT_DOUBLE_EQ(*six.median_ci95.low, 1.0);
  EXPECT_DOUBLE_EQ(*six.median_ci95.high, 6.0);
}

TEST(SignedRank, TiesShareTheirRankAndZerosAreDropped) {
  const SignedRanks ranks = signed_ranks({0, 2, -2, 5, 1});
  EXPECT_EQ(ranks.num_nonzero, 4);
  EXPECT_EQ(ranks.num_zeros, 1);
  EXPECT_DOUBLE_EQ(ranks.positive_sum, 1.0 + 2.5 + 4.0);
  EXPECT_DOUBLE_EQ(ranks.negative_sum, 2.5);
  EXPECT_TRUE(ranks.exact);
  EXPECT_TRUE(ranks.has_ties);
  // The ranks are 1, 2.5, 2.5, 4. Of 16 sums of the negative ranks, 0, 1, 2.5, 2.5 are 2.5 or
  // less.
  EXPECT_DOUBLE_EQ(ranks.p_value, 2.0 * 4.0 / 16.0);
}

TEST(SignedRank, EqualDifferencesHaveTheSmallestPValueThereIs) {
  EXPECT_DOUBLE_EQ(signed_ranks({1, 1, 1, 1, 1}).p_value, 0.0625);
  EXPECT_DOUBLE_EQ(signed_ranks({-1, -1, -1, -1, -1, -1}).p_value, 2.0 / 64.0);
  // Values that differ only by rounding are ties.
  const double tenth = 1.3 - 1.2, other = 0.4 - 0.3;
  ASSERT_NE(tenth, other);
  const SignedRanks ranks =
      signed_ranks({tenth, other, -tenth, 1e-17}, {1e-15, 1e-15, 1e-15, 1e-15});
  EXPECT_DOUBLE_EQ(ranks.positive_sum, 4.0);
  EXPECT_EQ(ranks.num_zeros, 1);
}

TEST(SignedRank, BeyondFiftyTheNormalOneIsCorrectedForTiesAndContinuity) {
  std::vector<double> differences(51, 1.0);
  std::fill(differences.begin(), differences.begin() + 20, -1.0);
  const SignedRanks ranks = signed_ranks(differences);
  EXPECT_FALSE(ranks.exact);
  // All ranks are 26: V = 31 * 26, mean 51 * 26 / 2, variance 51 * 26^2 / 4.
  const double z = (31.0 * 26.0 - 51.0 * 13.0 - 0.5) / std::sqrt(51.0 * 676.0 / 4.0);
  EXPECT_NEAR(ranks.p_value, std::erfc(z / std::sqrt(2.0)), 1e-13);
}

TEST(SignedRank, ExactAndNormalComeTogetherAtFifty) {
  std::vector<double> differences;
  for (int rank = 1; rank <= 50; ++rank) differences.push_back(rank % 3 == 0 ? -rank : rank);
  const SignedRanks exact = signed_ranks(differences);
  ASSERT_TRUE(exact.exact);
  const double deviation = std::sqrt(50.0 * 51.0 * 101.0 / 24.0);
  EXPECT_NEAR(two_sided_normal(exact.positive_sum, 637.5, deviation) / exact.p_value, 1.0,
              0.05);
  std::vector<double> probabilities;
  for (int sum = 0; sum < 1276; ++sum) {
    probabilities.push_back(signed_rank_cdf(50, sum) - signed_rank_cdf(50, sum - 1));
  }
  EXPECT_NEAR(static_cast<double>(num_pairs_outside(probabilities, 637.5, deviation)),
              static_cast<double>(num_pairs_outside({}, 637.5, deviation)), 1.0);
}

TEST(SignedRank, AMillionDifferencesNeedNoMillionSquared) {
  std::vector<double> differences;
  for (int i = 0; i < 1'000'000; ++i) differences.push_back(i % 1000 - 400.0);
  const SignedRanks ranks = signed_ranks(differences);
  EXPECT_EQ(ranks.num_zeros, 1000);
  EXPECT_LT(ranks.p_value, 1e-100);
  EXPECT_NEAR(*ranks.median, 99.5, 1.0);
  EXPECT_LT(*ranks.median_ci95.low, *ranks.median);
}

TEST(SignedRank, WithoutADifferenceThereIsNoMedian) {
  const SignedRanks ranks = signed_ranks({0, 0});
  EXPECT_EQ(ranks.num_nonzero, 0);
  EXPECT_FALSE(ranks.median.has_value());
}

}  // namespace signed_rank_test
}  // namespace jnd::analysis
