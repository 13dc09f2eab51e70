#include "core/clock_offsets.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace jnd::core {
namespace clock_offsets_test {

TEST(ClockCorrection, WithoutComparisonsTimesStayAsTheyAre) {
  const ClockCorrection none({});
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.corrected_s(12.5), 12.5);
}

TEST(ClockCorrection, OneComparisonHoldsForAllTimes) {
  const ClockCorrection one({{.time_s = 100.0, .offset_s = -7.0, .round_trip_s = 1e-3}});
  EXPECT_EQ(one.corrected_s(0.0), -7.0);
  EXPECT_EQ(one.corrected_s(1000.0), 993.0);
}

TEST(ClockCorrection, ADriftIsFollowedBeyondBothEnds) {
  std::vector<ClockOffset> offsets;
  for (int i = 0; i < 100; ++i) {
    const double time_s = 2.0 * i;
    offsets.push_back({time_s, 5.0 + 1e-4 * time_s, 1e-3});
  }
  std::swap(offsets[3], offsets[90]);  // The offsets may come in any order.
  const ClockCorrection correction(offsets);
  for (const double time_s : {-20.0, 0.0, 31.7, 150.0, 198.0, 220.0}) {
    EXPECT_NEAR(correction.offset_s(time_s), 5.0 + 1e-4 * time_s, 1e-9) << time_s;
  }
}

TEST(ClockCorrection, AShortWayCountsMoreThanALongOne) {
  std::vector<ClockOffset> offsets;
  for (int i = 0; i < 30; ++i) {
    const bool is_slow = i % 3 == 0;
    offsets.push_back({2.0 * i, is_slow ? 1.004 : 1.0, is_slow ? 10e-3 : 0.2e-3});
  }
  EXPECT_NEAR(ClockCorrection(offsets).offset_s(30.0), 1.0, 5e-6);
}

TEST(ClockCorrection, ALeapBeginsAfresh) {
  std::vector<ClockOffset> offsets;
  for (int i = 0; i < 20; ++i) offsets.push_back({2.0 * i, i < 10 ? 3.0 : -500.0, 1e-3});
  const ClockCorrection correction(offsets);
  EXPECT_NEAR(correction.offset_s(17.0), 3.0, 1e-9);
  EXPECT_NEAR(correction.offset_s(19.9), 3.0, 1e-9) << "the clock before the leap";
  EXPECT_NEAR(correction.offset_s(20.0), -500.0, 1e-9);
}

TEST(ClockCorrection, WhatIsNoNumberIsPassedOver) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const ClockCorrection correction({{kNone, 1.0, 1e-3}, {1.0, kNone, 1e-3}, {1.0, 2.0, 1e-3}});
  EXPECT_EQ(correction.offset_s(1.0), 2.0);
}

}  // namespace clock_offsets_test
}  // namespace jnd::core
