#include "analysis/groups/signed_rank.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jnd::analysis {
namespace {

TEST(SignedRank, DistributionOfThreeIsCountedByHand) {
  // Sums of subsets of {1, 2, 3}: 0, 1, 2, 3, 3, 4, 5, 6.
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
  EXPECT_DOUBLE_EQ(ranks.positive_sum, 1.0 + 2.5 + 4.0);
  EXPECT_DOUBLE_EQ(ranks.negative_sum, 2.5);
  EXPECT_FALSE(ranks.exact);
  // Mean 5, variance 7.5 - (2^3 - 2) / 48 = 7.375, no continuity correction.
  EXPECT_NEAR(ranks.p_value, std::erfc(2.5 / std::sqrt(7.375) / std::sqrt(2.0)), 1e-14);
}

TEST(SignedRank, ExactAndNormalComeTogetherAtFifty) {
  std::vector<double> differences;
  for (int rank = 1; rank <= 50; ++rank) differences.push_back(rank % 3 == 0 ? -rank : rank);
  const SignedRanks exact = signed_ranks(differences);
  differences.push_back(0.0);  // A zero asks for the approximation.
  const SignedRanks normal = signed_ranks(differences);
  EXPECT_TRUE(exact.exact);
  EXPECT_FALSE(normal.exact);
  EXPECT_NEAR(normal.p_value / exact.p_value, 1.0, 0.05);
}

TEST(SignedRank, WithoutADifferenceThereIsNoMedian) {
  const SignedRanks ranks = signed_ranks({0, 0});
  EXPECT_EQ(ranks.num_nonzero, 0);
  EXPECT_FALSE(ranks.median.has_value());
}

}  // namespace
}  // namespace jnd::analysis
