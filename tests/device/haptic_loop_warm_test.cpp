#include <gtest/gtest.h>

#include "core/media/medium.h"
#include "device/haptic_loop.h"
#include "scripted_device.h"

namespace jnd::device {
namespace haptic_loop_warm_test {

/// Runs a hundred ticks of a moving hand in a viscous fluid. Returns what the device received.
std::vector<core::PointVectors> forces(bool warmed) {
  ScriptedDevice device;
  device.move_all({0.3, 0.1, 0.0});
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  commands.publish({.sequence = 1, .medium = core::viscous({.viscosity_pa_s = 5})});
  HapticLoop loop({.starts_armed = true, .rearm_s = 0.01}, device, {commands, telemetry, stop});
  for (int i = 0; i < 100; ++i) {
    if (warmed) loop.warm();
    loop.tick();
  }
  return device.received;
}

TEST(HapticLoop, WarmingTheCacheChangesNothing) {
  const std::vector<core::PointVectors> plain = forces(false);
  ASSERT_GT(plain.back()[0].norm(), 0.1);
  EXPECT_EQ(forces(true), plain);
}

}  // namespace haptic_loop_warm_test
}  // namespace jnd::device
