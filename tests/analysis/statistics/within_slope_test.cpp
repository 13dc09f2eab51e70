#include "analysis/statistics/within_slope.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace within_slope_test {

TEST(WithinSlope, IsBlindToWhatDiffersBetweenGroups) {
  // Each group has 2 x, and one of them lies 100 lower and further right.
  const auto slope = within_slope({{{1, 1.0}, 0.0, 0.0},
                                   {{1, 1.0}, 1.0, 2.0},
                                   {{1, 2.0}, 10.0, -100.0},
                                   {{1, 2.0}, 12.0, -96.0}});
  ASSERT_TRUE(slope);
  EXPECT_NEAR(*slope, 2.0, 1e-12);
}

TEST(WithinSlope, WeighsGroupsByTheSpreadOfX) {
  // One group has the slope 1 over a spread of 1 (sum of squares 0.5), and the other the slope
  // 0 over a spread of 2 (2).
  const auto slope = within_slope(
      {{{1, 1.0}, 0.0, 0.0}, {{1, 1.0}, 1.0, 1.0}, {{2, 1.0}, 0.0, 5.0}, {{2, 1.0}, 2.0, 5.0}});
  EXPECT_NEAR(slope.value(), 0.5 / 2.5, 1e-12);
}

TEST(WithinSlope, IsAbsentWhereXIsAlikeWithinEveryGroup) {
  EXPECT_FALSE(within_slope({}));
  EXPECT_FALSE(
      within_slope({{{1, 1.0}, 3.0, 1.0}, {{1, 1.0}, 3.0, 2.0}, {{1, 2.0}, 4.0, 9.0}}));
}

}  // namespace within_slope_test
}  // namespace jnd::analysis
