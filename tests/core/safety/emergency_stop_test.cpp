#include "core/safety/emergency_stop.h"

#include <gtest/gtest.h>

#include <thread>

namespace jnd::core {
namespace {

TEST(EmergencyStop, StaysPressedUntilItIsReleased) {
  EmergencyStop stop;
  EXPECT_FALSE(stop.is_pressed());
  stop.press();
  stop.press();
  EXPECT_TRUE(stop.is_pressed());
  EXPECT_TRUE(stop.is_pressed());
  stop.release();
  EXPECT_FALSE(stop.is_pressed());
}

TEST(EmergencyStop, IsSeenFromAnotherThread) {
  EmergencyStop stop;
  std::thread presser([&stop] { stop.press(); });
  while (!stop.is_pressed()) std::this_thread::yield();
  presser.join();
  EXPECT_TRUE(stop.is_pressed());
}

}  // namespace
}  // namespace jnd::core
