#include "core/safety/emergency_stop.h"

#include <gtest/gtest.h>

#include <thread>

namespace jnd::core {
namespace emergency_stop_test {

TEST(EmergencyStop, StaysPressedUntilItIsReleased) {
  EmergencyStop stop;
  EXPECT_FALSE(stop.is_pressed());
  stop.press();
  stop.press();
  EXPECT_TRUE(stop.is_pressed());
  EXPECT_TRUE(stop.is_pressed());
  EXPECT_EQ(stop.num_presses(), 2U);
  EXPECT_TRUE(stop.release(2));
  EXPECT_FALSE(stop.is_pressed());
  EXPECT_TRUE(stop.release(2)) << "it is released already";
}

TEST(EmergencyStop, APressIsNotReleasedByWhoHasNotSeenIt) {
  EmergencyStop stop;
  stop.press();
  const std::uint64_t seen = stop.num_presses();
  stop.press();
  EXPECT_FALSE(stop.release(seen));
  EXPECT_TRUE(stop.is_pressed());
  EXPECT_TRUE(stop.release(stop.num_presses()));
}

TEST(EmergencyStop, IsSeenFromAnotherThread) {
  EmergencyStop stop;
  std::thread presser([&stop] { stop.press(); });
  while (!stop.is_pressed()) std::this_thread::yield();
  presser.join();
  EXPECT_TRUE(stop.is_pressed());
}

}  // namespace emergency_stop_test
}  // namespace jnd::core
