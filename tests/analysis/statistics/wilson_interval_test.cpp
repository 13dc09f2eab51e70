#include "analysis/statistics/wilson_interval.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace jnd::analysis {
namespace wilson_interval_test {

TEST(WilsonInterval, IsTheOneWorkedByHand) {
  // z = 1.959964, p = 0.8, n = 10: (0.8 + 0.192073) / 1.384146 -+ 1.416010 sqrt(0.016 +
  // 0.00960365).
  const auto [low, high] = wilson_interval(8, 10);
  EXPECT_NEAR(low, 0.490162, 1e-6);
  EXPECT_NEAR(high, 0.943318, 1e-6);
}

TEST(WilsonInterval, HasWidthWhereAllAnswersAgreeAndStaysWithinZeroAndOne) {
  const auto none = wilson_interval(0, 5);
  EXPECT_EQ(none.first, 0.0);
  // The upper end is z^2 / (n + z^2).
  EXPECT_NEAR(none.second, 3.841459 / 8.841459, 1e-6);
  const auto all = wilson_interval(5, 5);
  EXPECT_NEAR(all.first, 1.0 - none.second, 1e-12);
  EXPECT_EQ(all.second, 1.0);
}

TEST(WilsonInterval, SaysNothingWithoutTrialsAndRefusesImpossibleCounts) {
  EXPECT_EQ(wilson_interval(0, 0), (std::pair{0.0, 1.0}));
  EXPECT_THROW((void)wilson_interval(3, 2), core::Error);
  EXPECT_THROW((void)wilson_interval(-1, 2), core::Error);
}

}  // namespace wilson_interval_test
}  // namespace jnd::analysis
