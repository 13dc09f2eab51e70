#include <gtest/gtest.h>

#include "core/media/medium.h"
#include "device/haptic_loop.h"
#include "device/scripted_device.h"

namespace jnd::device {
namespace haptic_loop_points_test {

/// Returns the whole force that is sent to a device with `num_points` points, of which
/// `num_held` hold the hand, in a movement of 0.1 m/s.
Eigen::Vector3d total_n(const core::MediumAmounts& medium, int num_points, int num_held) {
  ScriptedDevice device;
  device.device_capabilities = {.share_ratio = core::area_shares_of_first(num_points),
                                .simulated = true};
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    const bool is_there = i < num_points;
    device.state.attached[static_cast<std::size_t>(i)] = i < num_held;
    const auto place = static_cast<std::size_t>(i);
    device.state.tip_velocity_m_per_s[place].setZero();
    if (is_there) device.state.tip_velocity_m_per_s[place].x() = 0.1;
    if (!is_there) device.state.tip_position_m[place].setZero();
  }
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  commands.publish({.sequence = 1,
                    .medium = medium,
                    .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                    .ramp_s = 0.0});
  HapticLoop loop({.starts_armed = true}, device, {commands, telemetry, stop});
  for (int i = 0; i < 300; ++i) loop.tick();
  telemetry.fetch();
  EXPECT_EQ(telemetry.value().fault, core::Fault::kNone);
  return device.last_total_n();
}

TEST(HapticLoopPoints, FewerPointsRenderTheSameTotal) {
  const core::MediumAmounts media[] = {
      core::viscous({.viscosity_pa_s = 5.0}), core::water({.scale = 4.0}),
      core::viscous_inertial({.viscosity_pa_s = 3.0}), core::buoyant(3.0),
      core::solid({.stiffness_n_per_m = 30.0})};
  for (const core::MediumAmounts& medium : media) {
    const Eigen::Vector3d of_five_n = total_n(medium, 5, 5);
    EXPECT_GT(of_five_n.norm(), 0.1);
    for (const int num_points : {1, 2}) {
      if (medium.plane_stiffness_n_per_m != 0.0) continue;
      EXPECT_NEAR((total_n(medium, num_points, num_points) - of_five_n).norm(), 0.0, 1e-9)
          << num_points;
    }
    // The force on a solid depends on the depth of the single points, so the tolerance is wide
    // there.
    EXPECT_NEAR(total_n(medium, 3, 3).norm() / of_five_n.norm(), 1.0,
                medium.plane_stiffness_n_per_m != 0.0 ? 0.2 : 1e-9);
  }
  const core::MediumAmounts thick = core::viscous({.viscosity_pa_s = 5.0});
  EXPECT_NEAR((total_n(thick, 3, 3) - total_n(thick, 5, 5)).norm(), 0.0, 1e-9);
}

/// Returns the forces that are sent to a device with these shares in a movement of 0.1 m/s.
core::PointVectors forces_n(const core::ShareRatios& shares) {
  ScriptedDevice device;
  device.device_capabilities = {.share_ratio = shares, .simulated = true};
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    device.state.tip_velocity_m_per_s[i] = {0.1, 0.0, 0.0};
  }
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  commands.publish({.sequence = 1,
                    .medium = core::viscous({.viscosity_pa_s = 5.0}),
                    .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                    .ramp_s = 0.0});
  HapticLoop loop({.starts_armed = true}, device, {commands, telemetry, stop});
  for (int i = 0; i < 300; ++i) loop.tick();
  return device.received.back();
}

TEST(HapticLoopPoints, EachPointGetsTheShareThatTheDeviceTells) {
  const double whole_n = 0.1 * core::viscous({.viscosity_pa_s = 5.0}).damping_n_s_per_m;
  const core::PointVectors of_pincer_n = forces_n({0.0, 0.0, 0.25, 0.75, 0.0});
  EXPECT_NEAR(of_pincer_n[2].x(), -0.25 * whole_n, 1e-9);
  EXPECT_NEAR(of_pincer_n[3].x(), -0.75 * whole_n, 1e-9);
  for (const int missing : {0, 1, 4}) EXPECT_TRUE(of_pincer_n[missing].isZero(0.0)) << missing;
  const core::PointVectors of_four_n = forces_n(core::area_shares(0b01111));
  EXPECT_NEAR(of_four_n[0].x(), -0.35 / 0.9 * whole_n, 1e-9);
  EXPECT_NEAR(of_four_n[3].x(), -0.10 / 0.9 * whole_n, 1e-9);
  EXPECT_TRUE(of_four_n[4].isZero(0.0));
}

TEST(HapticLoopPoints, ADeviceWithoutAnyPointIsRefused) {
  ScriptedDevice device;
  device.device_capabilities = {.share_ratio = {}, .simulated = true};
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  EXPECT_THROW(HapticLoop({}, device, {commands, telemetry, stop}), core::Error);
}

TEST(HapticLoopPoints, APointThatIsDeclaredAndNotHeldTakesItsShareWithIt) {
  const core::MediumAmounts thick = core::viscous({.viscosity_pa_s = 5.0});
  const double whole_n = total_n(thick, 5, 5).norm();
  EXPECT_NEAR(total_n(thick, 5, 1).norm(), 0.35 * whole_n, 1e-9);
  EXPECT_NEAR(total_n(thick, 2, 1).norm(), 0.5 * whole_n, 1e-9);
  EXPECT_NEAR(total_n(thick, 3, 2).norm(), 0.7 / 0.8 * whole_n, 1e-9);
}

TEST(HapticLoopPoints, WhatADeviceSaysOfPointsThatItDoesNotHaveIsNothing) {
  const core::MediumAmounts thick = core::viscous({.viscosity_pa_s = 5.0});
  // The device says that it holds these points and that they rest. They must neither get a
  // force nor slow down the mean.
  EXPECT_NEAR((total_n(thick, 2, 5) - total_n(thick, 2, 2)).norm(), 0.0, 1e-12);
}

}  // namespace haptic_loop_points_test
}  // namespace jnd::device
