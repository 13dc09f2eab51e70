#include "analysis/statistics/falling_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random_stream.h"

namespace jnd::analysis {
namespace falling_ranks_test {

TEST(FallingRanks, ThePValueIsTheShareOfPairingsThatFallAsMuch) {
  // Of the 24 orders of four values, one falls throughout, and three more exchange two
  // neighbours.
  EXPECT_NEAR(falling_ranks_p_value({1, 2, 3, 4}, {9, 7, 5, 2}).value(), 1.0 / 24.0, 1e-12);
  EXPECT_NEAR(falling_ranks_p_value({1, 2, 3, 4}, {7, 9, 5, 2}).value(), 4.0 / 24.0, 1e-12);
  EXPECT_NEAR(falling_ranks_p_value({1, 2, 3, 4}, {2, 5, 7, 9}).value(), 1.0, 1e-12);
}

TEST(FallingRanks, TiesAreCounted) {
  // There are two values at each end, and 1 of the 6 ways to place the two high answers puts
  // both at the low end.
  EXPECT_NEAR(falling_ranks_p_value({1, 1, 2, 2}, {5, 5, 3, 3}).value(), 1.0 / 6.0, 1e-12);
}

TEST(FallingRanks, NothingFallsWhereAllAreAlike) {
  EXPECT_FALSE(falling_ranks_p_value({1, 1, 1}, {3, 2, 1}).has_value());
  EXPECT_FALSE(falling_ranks_p_value({1, 2, 3}, {4, 4, 4}).has_value());
  EXPECT_FALSE(falling_ranks_p_value({}, {}).has_value());
}

TEST(FallingRanks, AmongAnswersAtRandomOneInAHundredIsFound) {
  // 27 trials, three at each of nine levels, as in an estimation, are too many for the exact
  // test.
  core::RandomStream random(5, "falling ranks");
  int num_found = 0;
  constexpr int kNumPeople = 20000;
  for (int person = 0; person < kNumPeople; ++person) {
    std::vector<double> x, y;
    for (int trial = 0; trial < 27; ++trial) {
      x.push_back(trial / 3);
      y.push_back(std::round(random.uniform(0.0, 20.0)));
    }
    num_found += falling_ranks_p_value(x, y).value() < 0.01 ? 1 : 0;
  }
  EXPECT_GT(num_found, 0.006 * kNumPeople);
  EXPECT_LE(num_found, 0.0115 * kNumPeople);
}

}  // namespace falling_ranks_test
}  // namespace jnd::analysis
