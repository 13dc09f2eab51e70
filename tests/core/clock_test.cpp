#include "core/clock.h"

#include <gtest/gtest.h>

namespace jnd::core {
namespace clock_test {

TEST(SimulatedClock, StandsStillUntilItIsMoved) {
  SimulatedClock clock;
  EXPECT_EQ(clock.now_ns(), 0);
  clock.advance_ns(1'500);
  clock.advance_ns(500);
  EXPECT_EQ(clock.now_ns(), 2'000);
}

TEST(SystemClock, CountsNanosecondsSince1970) {
  // The time is between 2017 and 2100.
  EXPECT_GT(SystemClock().now_ns(), 1'500'000'000'000'000'000LL);
  EXPECT_LT(SystemClock().now_ns(), 4'100'000'000'000'000'000LL);
}

}  // namespace clock_test
}  // namespace jnd::core
