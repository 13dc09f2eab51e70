#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "force_dimension_fixture.h"
#include "support/allocation_counter.h"

// Tests what the driver says of a device, how it finds one, and what it measures and sets. Its
// faults are in force_dimension_faults_test.cpp.

namespace jnd::device {
namespace force_dimension_plugin_test {

class ForceDimensionPluginTest : public ForceDimensionTest {
 protected:
  /// The driver's process cuts longer sentences, which would also cut the advice at their end.
  static void expect_refused(const std::string& said, const std::string& words) {
    EXPECT_TRUE(said.starts_with("device plugin ")) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
    const std::size_t found = said.find(", found: ");
    ASSERT_NE(found, std::string::npos) << said;
    EXPECT_LT(said.size() - found - 9, 200U) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
};

TEST_F(ForceDimensionPluginTest, WhatItTellsOfADeviceIsWhatTheLibrarySays) {
  const auto device = opened(argument());
  const DeviceCapabilities can = device->capabilities();
  EXPECT_TRUE(can.simulated && can.has_own_clock && can.tells_acting_force);
  EXPECT_TRUE(can.has_enable_switch);
  EXPECT_FALSE(can.moves_by_itself || can.paces_loop);
  EXPECT_EQ(can.num_contact_points(), 1);
  EXPECT_TRUE(can.has_point(0));
  EXPECT_EQ(can.max_force_per_point_n, 12.0);
  EXPECT_EQ(can.max_total_force_n, 12.0);
  EXPECT_EQ(can.workspace.half_width_x_m, 0.075);
  EXPECT_EQ(can.channels, core::kButtons);
  EXPECT_EQ(device->identity().model, "omega.3");
  EXPECT_EQ(device->identity().serial, "11311");
  EXPECT_EQ(device->identity().firmware, "controller 3.25, SDK 3.16.0");
}

TEST_F(ForceDimensionPluginTest, OtherModelsHaveOtherForcesAndChannels) {
  page().type = 60;
  auto device = opened(argument());
  EXPECT_EQ(device->identity().model, "Falcon");
  EXPECT_EQ(device->identity().serial, "") << "all Falcons tell the same";
  EXPECT_EQ(device->capabilities().max_force_per_point_n, 8.0);
  EXPECT_EQ(device->capabilities().workspace.half_width_y_m, 0.04);
  page().type = 35;
  page().has_wrist = page().has_gripper = 1;
  device = opened(argument());
  EXPECT_EQ(device->capabilities().channels,
            core::kButtons | core::kOrientation | core::kGripper);
}

TEST_F(ForceDimensionPluginTest, ARealOneIsUsedAsARealOne) {
  page().is_virtual = 0;
  const auto device = opened(argument());
  EXPECT_FALSE(device->capabilities().simulated);
  EXPECT_EQ(page().watchdog_steps * 0.125, 20.0) << "of the controller, ms";
  EXPECT_EQ(page().own_limit_n, 12.0) << "of the library";
  EXPECT_EQ(page().velocity_window_ms, 8);
}

TEST_F(ForceDimensionPluginTest, ALibraryThatCannotBeUsedIsToldInASentence) {
  const auto without_library = [](const std::string& option) {
    return why_not(driver().string() + ":simulated" + option);
  };
  // Somebody who runs the tests may have these libraries.
  if (::dlopen("libdhd.so", RTLD_LAZY) == nullptr &&
      ::dlopen("libdrd.so", RTLD_LAZY) == nullptr) {
    expect_refused(without_library(""), "neither libdhd.so nor libdrd.so on this machine");
  }
  expect_refused(without_library(",library=/nowhere/libdhd.so"), "no library that loads");
  expect_refused(without_library(",library=" + driver().string()),
                 "a library without the function dhdGetSDKVersion");
  expect_refused(why_not_with("", "LACKS_SET_FORCE"),
                 "a library without the function dhdSetForce; install version 3.7 or later");
  page().version[0] = 4;
  expect_refused(why_not_with(), "version 4.16.0 of the Force Dimension SDK");
  page().version[0] = 3;
  page().version[1] = 2;
  expect_refused(why_not_with(), "this driver is for 3.7 and later");
}

TEST_F(ForceDimensionPluginTest, ADeviceThatIsNotToBeHadIsToldInASentence) {
  page().num_devices = page().num_available = 0;
  expect_refused(why_not_with(), "no device; connect its cable, switch it on");
  page().num_devices = 1;
  expect_refused(why_not_with(), "a device that another program uses");
  page().num_available = 1;
  expect_refused(why_not_with(",serial=5"), "no such device");
  page().type = 81;
  expect_refused(why_not_with(), "a device of type 81, whose force and reach");
  page().type = 33;
  page().unplugged_in = TWIN_IN_OPEN;
  expect_refused(why_not_with(), "a device that does not open (communication error)");
  EXPECT_EQ(page().num_forces, 0);
}

TEST_F(ForceDimensionPluginTest, OfTwoDevicesOneHasToBeChosen) {
  page().num_devices = page().num_available = 2;
  expect_refused(why_not_with(), "2 devices, and none of them is chosen; write device=0 to");
  expect_refused(why_not_with(",device=2"), "device=2, and 2 connected");
  EXPECT_EQ(page().num_opened, 0);
  EXPECT_EQ(why_not_with(",device=1"), "");
  EXPECT_EQ(why_not_with(",serial=11311"), "");
  expect_refused(why_not_with(",serial=11311,device=1"), "device= and serial= at once");
}

TEST_F(ForceDimensionPluginTest, OneThatIsNotReadyIsToldInASentence) {
  page().has_power = 0;
  expect_refused(why_not_with(), "it has no power; switch it on");
  page().has_power = 1;
  page().trouble = TWIN_CONTROLLER_ERROR;
  expect_refused(why_not_with(), "its controller reports an error");
  page().trouble = TWIN_STATUS_FAILS;
  expect_refused(why_not_with(), "it does not tell how it is (communication error)");
  page().trouble = TWIN_READS_FAIL;
  expect_refused(why_not_with(), "a device that does not tell where it is");
  page().trouble = TWIN_NAN_POSITION;
  expect_refused(why_not_with(), "tells no position and velocity within half a second");
  page().trouble = TWIN_NAN_VELOCITY;
  expect_refused(why_not_with(), "tells no position and velocity within half a second");
  page().trouble = TWIN_IS_WELL;
  page().has_gravity_compensation = 0;
  expect_refused(why_not_with(), "a device that does not carry its own weight");
  EXPECT_EQ(why_not_with(",gravity_compensation=off"), "");
  page().has_gravity_compensation = 1;
  page().has_wrist = 1;
  page().is_wrist_calibrated = 0;
  expect_refused(why_not_with(), "a device whose wrist is not calibrated");
  page().has_wrist = 0;
  page().unplugged_in = TWIN_IN_PREPARATION;
  EXPECT_NE(why_not_with(), "");
  EXPECT_EQ(page().num_forces, 0);
}

TEST_F(ForceDimensionPluginTest, OneThatIsNotCalibratedIsRefusedOrGivenTime) {
  page().is_calibrated = 0;
  expect_refused(why_not_with(),
                 "a device that is not calibrated; put its end effector to its");
  expect_refused(why_not_with(",wait_for_calibration_s=0.2"),
                 "a device that nobody has calibrated within 0.2 s");
  page().unplugged_in = TWIN_IN_CALIBRATION;
  expect_refused(why_not_with(",wait_for_calibration_s=0.2"),
                 "a device that failed while it was calibrated (communication error)");
  page().unplugged_in = TWIN_NEVER;
  page().trouble = TWIN_IS_WELL;
  page().calibrates_after_ms = 100;
  EXPECT_EQ(why_not_with(",wait_for_calibration_s=2"), "");
  // A device that is calibrated is not asked for it again.
  page().calibrates_after_ms = -1;
  EXPECT_EQ(why_not_with(",wait_for_calibration_s=2"), "");
}

TEST_F(ForceDimensionPluginTest, ARealControllerHasToEndTheForceByItself) {
  page().is_virtual = page().has_watchdog = 0;
  const std::string words = "a controller that does not end the force by itself 20 ms after";
  expect_refused(why_not_with(), words);
  EXPECT_EQ(why_not_with(",controller_watchdog=off"), "");
  for (const int watchdog : {TWIN_KEEPS_ITS_WATCHDOG, TWIN_FORGETS_ITS_WATCHDOG}) {
    page().has_watchdog = watchdog;
    expect_refused(why_not_with(), words);
  }
  page().has_watchdog = 1;
  expect_refused(why_not_with("", "LACKS_WATCHDOG"), words);
  EXPECT_EQ(why_not_with(), "");
}

TEST_F(ForceDimensionPluginTest, ALibraryWithoutWhatNotAllHaveIsEnough) {
  EXPECT_EQ(why_not_with("", "LACKS_MAX_FORCE"), "");
  page().is_virtual = 0;
  EXPECT_EQ(why_not_with("", "LACKS_COM_MODE"), "");
}

TEST_F(ForceDimensionPluginTest, OptionsReachTheDevice) {
  {
    const auto device = opened(argument(
        ",effector_mass_kg=0.19,max_force_n=4,velocity_window_ms=12,time_guard_us=300"));
    EXPECT_EQ(page().effector_mass_kg, 0.19);
    EXPECT_EQ(page().own_limit_n, 4.0);
    EXPECT_EQ(page().velocity_window_ms, 12);
    EXPECT_EQ(page().time_guard_us, 300);
    EXPECT_EQ(device->capabilities().max_force_per_point_n, 4.0);
  }
  EXPECT_EQ(opened(argument(",max_force_n=19"))->capabilities().max_force_per_point_n, 12.0)
      << "for no more than the device has";
  expect_refused(why_not_with(",effector_mass=1"),
                 "the option effector_mass, which this driver");
  expect_refused(why_not_with(",max_force_n=lots"),
                 "max_force_n=lots; write a number from 0.1");
  expect_refused(why_not_with(",max_force_n=nan"), "max_force_n=nan; write a number");
  expect_refused(why_not_with(",gravity_compensation=on"), "write gravity_compensation=off or");
}

TEST_F(ForceDimensionPluginTest, AnotherSimulatorIsAskedForByItsName) {
  EXPECT_EQ(why_not_with(",simulator=on"), "");
  page().is_virtual = 0;
  expect_refused(why_not_with(",simulator=on"), "a real device where simulator=on asks for");
}

/// The device's x axis points to the person, and its y axis to the right.
TEST_F(ForceDimensionPluginTest, ItsFrameIsTurnedToOurs) {
  page().stroke_m = 0.0;
  page().held_m[0] = 0.01;
  page().held_m[1] = 0.02;
  page().held_m[2] = 0.03;
  const auto device = opened(argument(",surface_z_m=0.05"));
  EXPECT_EQ(device->capabilities().workspace.half_width_z_m, 0.075 + 0.05);
  core::HapticState state;
  const Eigen::Vector3d expected_m(0.02, -0.01, 0.03 - 0.05);
  core::PointVectors force_n = core::zero_vectors();
  ASSERT_TRUE(comes_to([&] {
    const bool is_read = device->read(state);
    (void)device->write(force_n);
    return is_read && (state.tip_position_m[0] - expected_m).norm() < 2e-4;
  })) << state.tip_position_m[0].transpose();
  EXPECT_LT((state.end_effector_position_m - state.tip_position_m[0]).norm(), 1e-9);
  force_n[0] = {1.0, 2.0, -0.5};
  ASSERT_TRUE(comes_to([&] {
    (void)device->read(state);
    (void)device->write(force_n);
    return (state.acted_n[0] - force_n[0]).norm() < 1e-9;
  }));
  EXPECT_DOUBLE_EQ(page().force_n[0], -2.0);
  EXPECT_DOUBLE_EQ(page().force_n[1], 1.0);
  EXPECT_DOUBLE_EQ(page().force_n[2], -0.5);
  // The hand gives way in the direction of the force on it, by 400 N/m.
  EXPECT_TRUE(comes_to([&] {
    (void)device->read(state);
    (void)device->write(force_n);
    return (state.tip_position_m[0] - expected_m - force_n[0] / 400.0).norm() < 2e-4;
  })) << (state.tip_position_m[0] - expected_m).transpose();
}

TEST_F(ForceDimensionPluginTest, WhatItMeasuresComesAcross) {
  page().type = 37;  // This type is left-handed.
  page().has_wrist = page().has_gripper = 1;
  page().gap_m = -0.012;
  page().buttons = 5;
  // This is a third of a turn, around x to y to z.
  const std::array<std::array<double, 3>, 3> turned = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) page().rotation[i][j] = turned[i][j];
  }
  const auto device = opened(argument());
  core::HapticState state;
  std::vector<double> to_the_right_m_per_s;
  for (int i = 0; i < 1800; ++i) {
    ASSERT_TRUE(device->read(state));
    ASSERT_TRUE(device->write(core::zero_vectors()));
    pause_ms(1);
    // In the first reads the hand still goes to where it wants to be.
    if (i < 200) continue;
    to_the_right_m_per_s.push_back(state.tip_velocity_m_per_s[0].x());
  }
  // The hand goes 0.04 m at 4 rad/s. A tenth of its velocities is above 95 % of the largest.
  std::ranges::sort(to_the_right_m_per_s);
  EXPECT_NEAR(to_the_right_m_per_s[to_the_right_m_per_s.size() * 9 / 10], 0.152, 0.03);
  EXPECT_DOUBLE_EQ(state.channels.gripper_m, 0.012);
  EXPECT_EQ(page().num_without_gripper, 0) << "its motors are told that they shall not";
  EXPECT_EQ(state.channels.buttons, 5U);
  // The same third of a turn is seen in axes that are turned by a quarter: x to -y to z to x.
  const auto& [w, x, y, z] = state.channels.orientation_wxyz;
  EXPECT_NEAR(w, 0.5, 1e-12);
  EXPECT_NEAR(x, 0.5, 1e-12);
  EXPECT_NEAR(y, -0.5, 1e-12);
  EXPECT_NEAR(z, 0.5, 1e-12);
}

TEST_F(ForceDimensionPluginTest, ASessionsLoopPushesAHandAndEndsWithBrakes) {
  {
    const auto device = opened(argument());
    StrokedFluid fluid(*device);
    double most_n = 0.0;
    for (int i = 0; i < 10; ++i) {
      ASSERT_EQ(fluid.run(100), core::Fault::kNone);
      most_n = std::max(most_n, std::abs(fluid.told().total_force_n[0]));
    }
    EXPECT_GT(most_n, 0.5);
    EXPECT_GT(page().num_forces, 300);
    EXPECT_LE(page().most_force_n, 12.0);
    EXPECT_EQ(page().is_on, 1);
    EXPECT_EQ(page().are_brakes_on, 0);
  }
  EXPECT_EQ(force_at_twin_n(), 0.0);
  EXPECT_EQ(page().is_on, 0);
  EXPECT_EQ(page().are_brakes_on, 1);
  EXPECT_EQ(page().num_closed, page().num_opened);
}

TEST_F(ForceDimensionPluginTest, ItsTickTakesNoHeap) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  page().type = 35;
  page().has_wrist = page().has_gripper = 1;
  const auto device = opened(argument(",in-process"));
  core::HapticState state;
  for (int i = 0; i < 20; ++i) {
    (void)device->read(state);
    (void)device->write(pushed(0.1));
    pause_ms(1);
  }
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 200; ++i) {
    (void)device->read(state);
    (void)device->write(pushed(0.1));
    if (i == 100) device->halt();
    if (i == 120) page().trouble = TWIN_UNPLUGGED;
  }
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_EQ(counter.frees(), 0U);
}

TEST_F(ForceDimensionPluginTest, ItIsFoundByItsName) {
  ::setenv("JND_DEVICE_PATH", driver().parent_path().c_str(), 1);
  const auto device = opened("force_dimension:simulated,library=" + twin().string());
  EXPECT_EQ(device->identity().model, "omega.3");
  ::unsetenv("JND_DEVICE_PATH");
}

}  // namespace force_dimension_plugin_test
}  // namespace jnd::device
