#include "app/commissioning/device_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace jnd::app {
namespace device_watch_test {

std::string value_of(const std::vector<WatchedLine>& lines, const std::string& what) {
  const auto line = std::find_if(lines.begin(), lines.end(),
                                 [&](const WatchedLine& one) { return one.what == what; });
  return line == lines.end() ? "no such line" : line->value;
}

TEST(DeviceWatch, TellsSwitchAndButtonsAsTheyAre) {
  device::DeviceCapabilities can{.has_enable_switch = true};
  core::Telemetry telemetry;
  telemetry.enabled = false;
  telemetry.sample.channels.bits = core::kButtons;
  telemetry.sample.channels.buttons = 0b101;
  EXPECT_EQ(value_of(watched_lines(can, telemetry), "Enabling switch"), "open: no force");
  EXPECT_EQ(value_of(watched_lines(can, telemetry), "Buttons"), "1, 3 pressed");
  telemetry.enabled = true;
  telemetry.sample.channels.buttons = 0;
  EXPECT_EQ(value_of(watched_lines(can, telemetry), "Enabling switch"), "closed");
  EXPECT_EQ(value_of(watched_lines(can, telemetry), "Buttons"), "none is pressed");
  can.has_enable_switch = false;
  EXPECT_EQ(value_of(watched_lines(can, telemetry), "Enabling switch"), "it has none");
}

TEST(DeviceWatch, TellsPlacesAndSpeedsInUnitsAndNothingThatTheDeviceLacks) {
  core::Telemetry telemetry;
  telemetry.sample.tip_position_m[0] = {0.01, -0.02, 0.1234};
  telemetry.hand_velocity_m_per_s = {0.03, 0.0, 0.04};
  telemetry.sample.attached_bits = 0b10001;
  const std::vector<WatchedLine> lines = watched_lines({}, telemetry);
  EXPECT_EQ(value_of(lines, "Place of point 1, device's frame"), "10.0, -20.0, 123.4 mm");
  EXPECT_EQ(value_of(lines, "Speed of the hand"), "50 mm/s");
  EXPECT_EQ(value_of(lines, "Contact points that are held"), "1, 5");
  EXPECT_EQ(value_of(lines, "Gripper"), "no such line");
  EXPECT_EQ(value_of(lines, "Force that its sensors measure"), "no such line");
  telemetry.sample.channels.bits = core::kGripper | core::kMeasuredForce;
  telemetry.sample.channels.gripper_m = 0.025;
  telemetry.sample.channels.force_n[0] = {1.0, 0.0, 0.5};
  telemetry.sample.channels.force_n[4] = {0.5, 0.0, 0.5};
  EXPECT_EQ(value_of(watched_lines({}, telemetry), "Gripper"), "25.0 mm");
  EXPECT_EQ(value_of(watched_lines({}, telemetry), "Force that its sensors measure"),
            "1.5, 0.0, 1.0 N");
}

}  // namespace device_watch_test
}  // namespace jnd::app
