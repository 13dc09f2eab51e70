#include "core/safety/heartbeat.h"

#include <gtest/gtest.h>

namespace jnd::core {
namespace heartbeat_test {

TEST(HeartbeatMonitor, HearsSilenceAfterItsTimeoutAndNotBefore) {
  Heartbeat heartbeat;
  HeartbeatMonitor monitor(&heartbeat, 250);
  for (int tick = 1; tick < 250; ++tick) EXPECT_FALSE(monitor.is_silent()) << tick;
  EXPECT_TRUE(monitor.is_silent());
  EXPECT_TRUE(monitor.is_silent());
}

TEST(HeartbeatMonitor, OneBeatStartsTheTimeAnew) {
  Heartbeat heartbeat;
  HeartbeatMonitor monitor(&heartbeat, 250);
  for (int second = 0; second < 10; ++second) {
    for (int tick = 0; tick < 249; ++tick) EXPECT_FALSE(monitor.is_silent());
    heartbeat.beat();
    EXPECT_FALSE(monitor.is_silent());
  }
}

TEST(HeartbeatMonitor, TicksThatWereMissedAreTime) {
  Heartbeat heartbeat;
  HeartbeatMonitor monitor(&heartbeat, 250);
  for (int tick = 1; tick < 25; ++tick) EXPECT_FALSE(monitor.is_silent(10)) << tick;
  EXPECT_TRUE(monitor.is_silent(10));
  heartbeat.beat();
  EXPECT_FALSE(monitor.is_silent(1000)) << "it came meanwhile";
}

TEST(HeartbeatMonitor, WhoeverMayBeginLateIsMissedOnlyAfterTheFirstBeat) {
  Heartbeat heartbeat;
  HeartbeatMonitor monitor(&heartbeat, 250, HeartbeatMonitor::Since::kFirstBeat);
  for (int tick = 0; tick < 1000; ++tick) EXPECT_FALSE(monitor.is_silent(10)) << tick;
  heartbeat.beat();
  EXPECT_FALSE(monitor.is_silent());
  for (int tick = 1; tick < 250; ++tick) EXPECT_FALSE(monitor.is_silent()) << tick;
  EXPECT_TRUE(monitor.is_silent());
}

TEST(HeartbeatMonitor, ASimulationNeedsNoHeart) {
  HeartbeatMonitor monitor(nullptr, 1);
  for (int tick = 0; tick < 1000; ++tick) EXPECT_FALSE(monitor.is_silent());
}

}  // namespace heartbeat_test
}  // namespace jnd::core
