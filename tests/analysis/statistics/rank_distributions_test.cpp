#include "analysis/statistics/rank_distributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/statistics/ranks.h"
#include "core/error.h"

namespace jnd::analysis {
namespace rank_distributions_test {

using Numbers = std::vector<std::int64_t>;

TEST(Ranks, TiesShareTheMeanOfTheirsDoubled) {
  const Ranks ranks = ranks_of({3.0, 1.0, 3.0, 9.0});
  EXPECT_EQ(ranks.doubled, (Numbers{5, 2, 5, 8}));
  EXPECT_EQ(ranks.tie_correction, 6.0);
  EXPECT_FALSE(ranks_of({1.0, 1.0 + 1e-9}).has_ties());
  EXPECT_TRUE(ranks_of({1.0, 1.0 + 1e-9}, {0.0, 1e-8}).has_ties());
  EXPECT_TRUE(ranks_of({}).doubled.empty());
}

TEST(RankDistributions, SignsOfTiedRanksAreCountedByHand) {
  // The doubled ranks of |1|, |1|, |2| are 3, 3, 6, with the sums 0, 3, 3, 6, 6, 9, 9, 12.
  const RankDistribution signs = signed_rank_distribution({3, 3, 6});
  EXPECT_DOUBLE_EQ(signs.up_to(0.0), 1.0 / 8.0);
  EXPECT_DOUBLE_EQ(signs.up_to(3.0), 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(signs.from(9.0), 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(signs.two_sided(12.0), 2.0 / 8.0);
  EXPECT_DOUBLE_EQ(signs.two_sided(6.0), 1.0);
}

TEST(RankDistributions, SharesOfTiedRanksAreCountedByHandAndHaveUnlikeTails) {
  // Two of the doubled ranks 2, 5, 5, 8 have the sums 7, 7, 10, 10, 13, 13. One of 2, 6, 6, 6
  // is 2 or 6.
  const RankDistribution two = rank_sum_distribution({2, 5, 5, 8}, 2);
  EXPECT_NEAR(two.up_to(7.0), 2.0 / 6.0, 1e-15);
  EXPECT_NEAR(two.from(10.0), 4.0 / 6.0, 1e-15);
  const RankDistribution one = rank_sum_distribution({2, 6, 6, 6}, 1);
  EXPECT_DOUBLE_EQ(one.two_sided(2.0), 0.5);
  EXPECT_DOUBLE_EQ(one.two_sided(6.0), 1.0) << "the smaller tail, 3 of 4, counts twice";
}

TEST(RankDistributions, PairingsOfThreeAreCountedByHand) {
  // The sums of products of 1, 2, 3 with their six orders are 14, 13, 13, 11, 11, 10.
  const RankDistribution pairs = rank_product_distribution({1, 2, 3}, {1, 2, 3});
  EXPECT_NEAR(pairs.from(14.0), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(pairs.from(13.0), 3.0 / 6.0, 1e-15);
  EXPECT_NEAR(pairs.up_to(11.0), 3.0 / 6.0, 1e-15);
  EXPECT_NEAR(pairs.up_to(10.0), 1.0 / 6.0, 1e-15);
}

TEST(RankDistributions, EveryPairingIsCountedWhateverTheTies) {
  const Numbers a = {3, 3, 6, 9, 9, 12, 14}, b = {2, 5, 5, 9, 9, 9, 14};
  Numbers order(a.size());
  std::iota(order.begin(), order.end(), 0);
  const std::int64_t found = std::inner_product(a.begin(), a.end(), b.begin(), 0LL);
  double at_least = 0.0, all = 0.0;
  do {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += a[i] * b[static_cast<std::size_t>(order[i])];
    }
    at_least += sum >= found - 30 ? 1.0 : 0.0;
    ++all;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_NEAR(rank_product_distribution(a, b).from(static_cast<double>(found - 30)),
              at_least / all, 1e-14);
}

TEST(RankDistributions, CriticalValuesOfSpearmanAreThePublishedOnes) {
  // Zar (1972), JASA 67, table 1, gives the smallest r with p <= 5 and 1 %, two-sided.
  const struct {
    std::size_t n;
    double at_5, at_1;
  } kTable[] = {{6, 0.886, 1.000},  {8, 0.738, 0.881},  {10, 0.648, 0.794},
                {12, 0.587, 0.727}, {13, 0.560, 0.703}, {14, 0.538, 0.679}};
  for (const auto& [n, at_5, at_1] : kTable) {
    const Numbers ranks = untied_ranks(n);
    const RankDistribution pairs = rank_product_distribution(ranks, ranks);
    const std::int64_t most = pairs.lowest + std::ssize(pairs.probabilities) - 1;
    const double cubes = static_cast<double>(n * n * n - n);
    for (const auto& [level, expected] : {std::pair{0.05, at_5}, {0.01, at_1}}) {
      std::int64_t sum = most;
      while (pairs.two_sided(static_cast<double>(sum - 1)) <= level) --sum;
      // The sums of squares differ by twice the sum of products.
      const double r = 1.0 - 12.0 * static_cast<double>(most - sum) / cubes;
      EXPECT_NEAR(r, expected, 6e-4) << n << ' ' << level;
    }
  }
}

TEST(RankDistributions, AllProbabilitiesAreOne) {
  for (const RankDistribution& one :
       {signed_rank_distribution(untied_ranks(50)), rank_sum_distribution(untied_ranks(50), 25),
        rank_product_distribution(untied_ranks(14), untied_ranks(14)),
        rank_sum_distribution({2, 4}, 0)}) {
    EXPECT_NEAR(one.up_to(1e9), 1.0, 1e-12);
    EXPECT_NEAR(one.from(-1e9), 1.0, 1e-12);
  }
}

TEST(RankDistributions, RefuseMoreThanTheyCanCount) {
  EXPECT_THROW((void)signed_rank_distribution(untied_ranks(51)), core::Error);
  EXPECT_THROW((void)rank_sum_distribution(untied_ranks(51), 3), core::Error);
  EXPECT_THROW((void)rank_sum_distribution(untied_ranks(3), 4), core::Error);
  EXPECT_THROW((void)rank_product_distribution(untied_ranks(15), untied_ranks(15)),
               core::Error);
  EXPECT_THROW((void)rank_product_distribution(untied_ranks(3), untied_ranks(4)), core::Error);
}

}  // namespace rank_distributions_test
}  // namespace jnd::analysis
