#include "device/profiled_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/exchange/haptic_command.h"
#include "core/exchange/latest_value.h"
#include "core/exchange/spsc_queue.h"
#include "core/exchange/telemetry.h"
#include "core/sample.h"
#include "device/haptic_loop.h"
#include "device/lumped_hand_device.h"
#include "device/simulated_hand.h"
#include "scripted_device.h"
#include "support/allocation_counter.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::device {
namespace profiled_device_test {

using Eigen::Vector3d;

/// A quarter turn about z: the robot's x is the workspace's y, and its y is the workspace's -x.
Eigen::Matrix3d quarter_turn() {
  Eigen::Matrix3d rotation;
  rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return rotation;
}

const ProfiledDevice::Parameters kTurned = {.rotation = quarter_turn(),
                                            .offset_m = Vector3d(0.1, 0.2, -0.7)};

/// A state with everything that a device can measure, each number another one.
core::HapticState full_state() {
  core::HapticState state;
  for (std::size_t i = 0; i < state.tip_position_m.size(); ++i) {
    const auto step = static_cast<double>(i);
    state.tip_position_m[i] = Vector3d(1.0 + step, 2.0, 3.0);
    state.tip_velocity_m_per_s[i] = Vector3d(0.1, 0.2 + step, 0.3);
    state.acted_n[i] = Vector3d(4.0, 5.0, 6.0 + step);
    state.channels.force_n[i] = {7.0 + step, 8.0, 9.0};
  }
  state.end_effector_position_m = Vector3d(0.5, 0.6, 0.7);
  state.channels.bits = core::kAllChannels;
  state.channels.torque_n_m = {0.01, 0.02, 0.03};
  state.channels.gripper_m = 0.04;
  state.channels.buttons = 5;
  state.device_time_ns = 77;
  return state;
}

TEST(ProfiledDevice, WhatIsMeasuredComesInTheWorkspaceFrame) {
  ScriptedDevice robot;
  robot.state = full_state();
  ProfiledDevice device(robot, kTurned);
  core::HapticState seen;
  ASSERT_TRUE(device.read(seen));
  // The workspace's x is the robot's -y and its y the robot's x; positions are moved by the
  // offset besides. The numbers were computed by hand.
  EXPECT_TRUE(seen.tip_position_m[0].isApprox(Vector3d(-1.9, 1.2, 2.3), 1e-15));
  EXPECT_TRUE(seen.tip_position_m[4].isApprox(Vector3d(-1.9, 5.2, 2.3), 1e-15));
  EXPECT_EQ(seen.tip_velocity_m_per_s[1], Vector3d(-1.2, 0.1, 0.3));
  EXPECT_EQ(seen.acted_n[2], Vector3d(-5.0, 4.0, 8.0));
  EXPECT_EQ(seen.channels.force_n[3], (core::PlainVector{-8.0, 10.0, 9.0}));
  EXPECT_TRUE(seen.end_effector_position_m.isApprox(Vector3d(-0.5, 0.7, 0.0), 1e-15));
  EXPECT_EQ(seen.channels.torque_n_m, (core::PlainVector{-0.02, 0.01, 0.03}));
  EXPECT_EQ(seen.channels.gripper_m, 0.04);
  EXPECT_EQ(seen.channels.buttons, 5u);
  EXPECT_EQ(seen.device_time_ns, 77);
}

TEST(ProfiledDevice, AnOrientationIsTurnedAndOneThatIsNotThereStaysAway) {
  ScriptedDevice robot;
  robot.state = full_state();
  // The end effector is turned by a quarter about the robot's x axis, which is the workspace's
  // y axis.
  const double half = std::numbers::sqrt2 / 2.0;
  robot.state.channels.orientation_wxyz = {half, half, 0.0, 0.0};
  ProfiledDevice device(robot, kTurned);
  core::HapticState seen;
  ASSERT_TRUE(device.read(seen));
  const Eigen::Quaterniond turn(
      seen.channels.orientation_wxyz[0], seen.channels.orientation_wxyz[1],
      seen.channels.orientation_wxyz[2], seen.channels.orientation_wxyz[3]);
  // Its own x axis lies along the robot's x, the workspace's y. Its y axis lies along z of
  // both.
  EXPECT_TRUE((turn * Vector3d::UnitX()).isApprox(Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE((turn * Vector3d::UnitY()).isApprox(Vector3d::UnitZ(), 1e-12));

  robot.state.channels.bits = 0;
  robot.state.channels.orientation_wxyz = {0.0, 0.0, 0.0, 0.0};
  ASSERT_TRUE(device.read(seen));
  EXPECT_EQ(seen.channels.orientation_wxyz, (std::array<double, 4>{0.0, 0.0, 0.0, 0.0}));
}

TEST(ProfiledDevice, AForceGoesToTheRobotInItsOwnFrame) {
  ScriptedDevice robot;
  ProfiledDevice device(robot, kTurned);
  core::PointVectors force_n = core::zero_vectors();
  force_n[3] = Vector3d(1.0, 2.0, 3.0);
  ASSERT_TRUE(device.write(force_n));
  // To the right is the robot's -y, and away from the person is its x.
  EXPECT_EQ(robot.received.back()[3], Vector3d(2.0, -1.0, 3.0));
  EXPECT_EQ(robot.received.back()[0], Vector3d::Zero());
  // A force and its work are the same in both frames, so what is sent comes back as what acted.
  core::HapticState seen;
  ASSERT_TRUE(device.read(seen));
  EXPECT_EQ(seen.acted_n[3], force_n[3]);
}

TEST(ProfiledDevice, WhatIsNoNumberStaysNone) {
  ScriptedDevice robot;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  robot.state = full_state();
  robot.state.tip_position_m[1].y() = nan;
  robot.state.tip_velocity_m_per_s[2].z() = std::numeric_limits<double>::infinity();
  ProfiledDevice device(robot, kTurned);
  core::HapticState seen;
  ASSERT_TRUE(device.read(seen));
  EXPECT_FALSE(seen.tip_position_m[1].allFinite());
  EXPECT_FALSE(seen.tip_velocity_m_per_s[2].allFinite());
  EXPECT_TRUE(seen.tip_position_m[0].allFinite());
  core::PointVectors force_n = core::zero_vectors();
  force_n[0].x() = nan;
  ASSERT_TRUE(device.write(force_n));
  EXPECT_FALSE(robot.received.back()[0].allFinite());
}

TEST(ProfiledDevice, WhatTheDeviceHasNotIsNotMovedAnywhere) {
  ScriptedDevice robot;
  robot.device_capabilities.share_ratio = core::area_shares(0b01100);
  robot.state = full_state();
  robot.state.tip_position_m[0] = Vector3d::Zero();
  robot.state.end_effector_position_m = Vector3d::Zero();
  ProfiledDevice device(robot, kTurned);
  core::HapticState seen;
  ASSERT_TRUE(device.read(seen));
  EXPECT_EQ(seen.tip_position_m[0], Vector3d::Zero());
  EXPECT_EQ(seen.end_effector_position_m, Vector3d::Zero());
  EXPECT_NE(seen.tip_position_m[2], robot.state.tip_position_m[2]);
}

TEST(ProfiledDevice, ItsLimitsAreTheNarrowerOnes) {
  ScriptedDevice robot;
  robot.device_capabilities.max_force_per_point_n = 4.0;
  robot.device_capabilities.max_total_force_n = 20.0;
  robot.device_capabilities.max_slew_n_per_s = 500.0;
  robot.device_capabilities.max_speed_m_per_s = 3.0;
  robot.device_capabilities.own_mass_kg = 1.0;
  robot.device_capabilities.closed_loop_delay_s = 0.002;
  ProfiledDevice::Parameters profile;
  profile.max_force_per_point_n = 8.0;
  profile.max_total_force_n = 8.0;
  profile.max_slew_n_per_s = 1000.0;
  profile.max_speed_m_per_s = 1.0;
  profile.workspace = {0.3, 0.4, 0.5};
  profile.own_mass_kg = 0.7;
  profile.own_damping_n_s_per_m = 0.0;
  const ProfiledDevice device(robot, profile);
  const DeviceCapabilities can = device.capabilities();
  EXPECT_EQ(can.max_force_per_point_n, 4.0);
  EXPECT_EQ(can.max_total_force_n, 8.0);
  EXPECT_EQ(can.max_slew_n_per_s, 500.0);
  EXPECT_EQ(can.max_speed_m_per_s, 1.0);
  EXPECT_EQ(can.workspace.half_width_x_m, 0.3);
  EXPECT_EQ(can.workspace.half_width_y_m, 0.4);
  EXPECT_EQ(can.workspace.half_width_z_m, 0.5);
  EXPECT_EQ(can.own_mass_kg, 0.7);
  EXPECT_EQ(can.own_damping_n_s_per_m, 0.0);
  EXPECT_EQ(can.closed_loop_delay_s, 0.002) << "as it says, where that was not measured";
}

TEST(ProfiledDevice, TheRobotsOwnSpaceIsSeenFromTheWorkspace) {
  ScriptedDevice robot;
  robot.device_capabilities.workspace = {0.2, core::kInfinity, 0.1};
  const ProfiledDevice device(robot, kTurned);
  const core::Workspace seen = device.capabilities().workspace;
  // The robot's x is y here; z goes 0.1 m to either side of -0.7 m.
  EXPECT_EQ(seen.half_width_x_m, core::kInfinity);
  EXPECT_DOUBLE_EQ(seen.half_width_y_m, 0.4);
  EXPECT_DOUBLE_EQ(seen.half_width_z_m, 0.8);
}

TEST(ProfiledDevice, RefusesWhatIsNoRotationAndNoLimit) {
  ScriptedDevice robot;
  ProfiledDevice::Parameters mirror;
  mirror.rotation(0, 0) = -1.0;
  EXPECT_THROW(ProfiledDevice(robot, mirror), core::Error);
  ProfiledDevice::Parameters skew;
  skew.rotation(0, 1) = 0.01;
  EXPECT_THROW(ProfiledDevice(robot, skew), core::Error);
  ProfiledDevice::Parameters none;
  none.rotation(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ProfiledDevice(robot, none), core::Error);
  ProfiledDevice::Parameters limit;
  limit.max_total_force_n = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ProfiledDevice(robot, limit), core::Error);
  ProfiledDevice::Parameters far;
  far.offset_m.x() = core::kInfinity;
  EXPECT_THROW(ProfiledDevice(robot, far), core::Error);
}

/// A device that says of itself what no other device says, and notes what it is asked.
class TellingDevice final : public HapticDevice {
 public:
  std::string_view name() const noexcept override { return "telling"; }
  DeviceCapabilities capabilities() const noexcept override {
    return {.rate_hz = 1234.0, .has_own_clock = true, .paces_loop = true};
  }
  DeviceIdentity identity() const override { return {"model", "serial", "firmware"}; }
  void open() override { asked += "open "; }
  bool read(core::HapticState&) noexcept override { return false; }
  bool wait_for_sample(std::int64_t deadline_ns) noexcept override { return deadline_ns == 5; }
  bool write(const core::PointVectors&) noexcept override { return false; }
  void close() noexcept override { asked += "close "; }
  core::Fault fault() const noexcept override { return core::Fault::kLinkLost; }
  std::string words_of_fault() const override { return "told"; }
  bool may_arm() const noexcept override { return false; }
  void halt() noexcept override { asked += "halt "; }
  SimulatedHand* simulated_hand() noexcept override { return hand; }
  std::optional<LinkReport> link() const noexcept override {
    return LinkReport{.level = "good"};
  }
  core::ContactSums contact_sums() const noexcept override { return {.num_ticks = 9}; }

  std::string asked;
  // This is compared, never used.
  SimulatedHand* hand = reinterpret_cast<SimulatedHand*>(this);
};

TEST(ProfiledDevice, PassesOnWhateverElseItIsAsked) {
  TellingDevice inner;
  ProfiledDevice device(inner, kTurned);
  EXPECT_EQ(device.name(), "telling");
  EXPECT_EQ(device.capabilities().rate_hz, 1234.0);
  EXPECT_TRUE(device.capabilities().has_own_clock);
  EXPECT_TRUE(device.capabilities().paces_loop);
  EXPECT_EQ(device.identity().model, "model");
  EXPECT_EQ(device.identity().serial, "serial");
  EXPECT_EQ(device.identity().firmware, "firmware");
  core::HapticState state;
  EXPECT_FALSE(device.read(state));
  EXPECT_FALSE(device.write(core::zero_vectors()));
  EXPECT_TRUE(device.wait_for_sample(5));
  EXPECT_FALSE(device.wait_for_sample(6));
  EXPECT_EQ(device.fault(), core::Fault::kLinkLost);
  EXPECT_EQ(device.words_of_fault(), "told");
  EXPECT_FALSE(device.may_arm());
  EXPECT_EQ(device.simulated_hand(), inner.hand);
  ASSERT_TRUE(device.link());
  EXPECT_EQ(device.link()->level, "good");
  EXPECT_EQ(device.contact_sums().num_ticks, 9);
  device.open();
  device.halt();
  device.close();
  EXPECT_EQ(inner.asked, "open halt close ");
}

// If a function is added to devices and forgotten here, it would not ask the device.
TEST(ProfiledDevice, OverridesEveryFunctionOfADevice) {
  const auto source = [](const std::string& file) {
    return test_support::read_file(test_support::source_folder() / "device" / file);
  };
  const std::string base = source("haptic_device.h"), own = source("profiled_device.h");
  static const std::regex kVirtual(R"re(virtual [^~;{(]*?(\w+)\()re");
  int num_functions = 0;
  for (std::sregex_iterator it(base.begin(), base.end(), kVirtual), none; it != none; ++it) {
    const std::regex overridden("\\b" + (*it)[1].str() +
                                R"re(\([^)]*\)( const)?( noexcept)? override)re");
    EXPECT_TRUE(std::regex_search(own, overridden)) << (*it)[1].str();
    ++num_functions;
  }
  EXPECT_GE(num_functions, 15);
}

/// The lumped hand as a robot with another frame would report it.
class ElsewhereDevice final : public HapticDevice {
 public:
  ElsewhereDevice(HapticDevice& hand, const Eigen::Matrix3d& rotation, const Vector3d& offset_m)
      : hand_(hand), rotation_(rotation), offset_m_(offset_m) {}

  std::string_view name() const noexcept override { return hand_.name(); }
  DeviceCapabilities capabilities() const noexcept override { return hand_.capabilities(); }
  void open() override { hand_.open(); }
  bool read(core::HapticState& state) noexcept override {
    if (!hand_.read(state)) return false;
    const Eigen::Matrix3d back = rotation_.transpose();
    for (std::size_t i = 0; i < state.tip_position_m.size(); ++i) {
      state.tip_position_m[i] = (back * (state.tip_position_m[i] - offset_m_)).eval();
      state.tip_velocity_m_per_s[i] = (back * state.tip_velocity_m_per_s[i]).eval();
      state.acted_n[i] = (back * state.acted_n[i]).eval();
    }
    state.end_effector_position_m = (back * (state.end_effector_position_m - offset_m_)).eval();
    return true;
  }
  bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    core::PointVectors turned = force_on_hand_n;
    for (Vector3d& force : turned) force = (rotation_ * force).eval();
    return hand_.write(turned);
  }
  void close() noexcept override { hand_.close(); }
  void halt() noexcept override { hand_.halt(); }
  SimulatedHand* simulated_hand() noexcept override { return hand_.simulated_hand(); }

 private:
  HapticDevice& hand_;
  Eigen::Matrix3d rotation_;
  Vector3d offset_m_;
};

/// The samples of a second in a thick fluid.
std::vector<core::Sample> stroked_through_a_fluid(HapticDevice& device) {
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  core::SpscQueue<core::Sample> samples(4096);
  HapticLoop::Parameters parameters;
  parameters.starts_armed = true;
  HapticLoop loop(parameters, device,
                  HapticLoop::Exchange{commands, telemetry, stop, &samples, nullptr});
  commands.publish({.sequence = 1, .medium = {.damping_n_s_per_m = 20.0}, .ramp_s = 0.05});
  device.open();
  device.simulated_hand()->begin_strokes({.height_m = -0.15}, core::RandomStream(1, "stroke"));
  std::vector<core::Sample> all;
  for (int tick = 0; tick < 2000; ++tick) loop.tick();
  samples.drain([&](const core::Sample& sample) { all.push_back(sample); });
  device.close();
  return all;
}

TEST(ProfiledDevice, ALoopOverATurnedRobotGivesTheSamplesOfOneThatIsNot) {
  Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -1.0).normalized())).toRotationMatrix();
  const Vector3d offset_m(0.3, -0.4, 0.9);
  LumpedHandDevice plain({}), hand({});
  ElsewhereDevice robot(hand, rotation, offset_m);
  ProfiledDevice device(robot, {.rotation = rotation, .offset_m = offset_m});
  const std::vector<core::Sample> expected = stroked_through_a_fluid(plain);
  const std::vector<core::Sample> found = stroked_through_a_fluid(device);
  ASSERT_EQ(found.size(), 2000u);
  ASSERT_EQ(expected.size(), 2000u);
  double most_n = 0.0;
  for (std::size_t tick = 0; tick < found.size(); ++tick) {
    EXPECT_EQ(found[tick].tick, expected[tick].tick);
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(found[tick].tip_position_m[i][axis], expected[tick].tip_position_m[i][axis],
                    1e-9)
            << tick;
        ASSERT_NEAR(found[tick].tip_force_n[i][axis], expected[tick].tip_force_n[i][axis], 1e-7)
            << tick;
        most_n = std::max(most_n, std::abs(expected[tick].tip_force_n[i][axis]));
      }
    }
  }
  EXPECT_GT(most_n, 0.5) << "there was a force to be compared";
}

TEST(ProfiledDevice, TakesNoHeapWhileItRuns) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  ProfiledDevice device(std::make_unique<LumpedHandDevice>(LumpedHandDevice::Parameters{}),
                        kTurned);
  device.open();
  core::HapticState state;
  const test_support::AllocationCounter counter;
  for (int tick = 0; tick < 100; ++tick) {
    (void)device.read(state);
    (void)device.write(core::zero_vectors());
    (void)device.capabilities();
  }
  EXPECT_EQ(counter.allocations() + counter.frees(), 0u);
  device.close();
}

}  // namespace profiled_device_test
}  // namespace jnd::device
