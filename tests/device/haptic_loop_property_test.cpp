// Tests what holds for every input. They are seeded, so that a failure comes again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/media/fluid_force.h"
#include "core/random_stream.h"
#include "haptic_loop_scene.h"

namespace jnd::device {
namespace haptic_loop_property_test {

using core::Fault;
using core::RandomStream;

/// Returns amounts from nothing to far beyond any study, which are sometimes negative.
core::MediumAmounts random_medium(RandomStream& random) {
  core::MediumAmounts medium;
  for (const auto amount : core::kAmounts) {
    if (random.with_probability(0.5)) continue;
    medium.*amount = std::pow(10.0, random.uniform(-3.0, 6.0));
    if (random.with_probability(0.1)) medium.*amount *= -1.0;
  }
  return medium;
}

core::ForceMap plate() {
  std::vector<core::ForceMap::Row> rows;
  for (int i = 0; i <= 18; ++i) {
    const double angle = std::numbers::pi / 36.0 * i;
    rows.push_back({angle, 1.0, 1.0, i == 18 ? 0.0 : std::sin(2.0 * angle)});
  }
  return core::ForceMap(rows);
}

TEST(HapticLoopProperty, WhateverIsCommandedAndMeasuredTheForceKeepsItsLimits) {
  const core::ForceMap map = plate();
  std::int64_t num_with_force = 0;
  for (int run = 0; run < 60; ++run) {
    RandomStream random(20, "property", {run});
    HapticLoop::Parameters parameters;
    parameters.force_map = &map;
    parameters.limits.per_point_n = random.uniform(0.5, 20.0);
    parameters.limits.total_n = random.uniform(0.5, 60.0);
    parameters.limits.slew_n_per_s = random.uniform(100.0, 5000.0);
    core::ForceLimiter::Parameters limits = parameters.limits;
    limits.per_point_n = std::min(limits.per_point_n, 10.0);
    limits.total_n = std::min(limits.total_n, 30.0);
    LoopScene scene(core::kAllAttached, parameters);
    core::PointVectors last = core::zero_vectors();
    for (int tick = 0; tick < 2000; ++tick) {
      if (random.with_probability(0.01)) {
        scene.command.medium = random_medium(random);
        scene.command.ramp_s = random.uniform(0.0, 0.1);
        scene.command.immersion = {.radius_m = random.uniform(0.05, 1.0),
                                   .depth_m = random.uniform(0.05, 1.0),
                                   .origin_z_m = random.uniform(-0.2, 0.2)};
        scene.publish();
      }
      if (random.with_probability(0.02)) {
        const double speed = random.with_probability(0.1) ? 6.0 : random.uniform(0.0, 2.0);
        for (Eigen::Vector3d& velocity : scene.device.state.tip_velocity_m_per_s) {
          velocity = speed * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
        }
      }
      for (Eigen::Vector3d& position : scene.device.state.tip_position_m) {
        position *= 0.99;  // This keeps the hand near.
      }
      if (random.with_probability(0.01)) {
        const auto point = random.below(core::kNumContactPoints);
        scene.device.state.attached[point] = !scene.device.state.attached[point];
      }
      if (random.with_probability(0.02)) scene.arm();
      scene.run(1);
      ASSERT_TRUE(is_safe(scene.last_received(), last, scene.device.state.attached, limits))
          << "run " << run << " tick " << tick;
      last = scene.last_received();
      num_with_force += sum_of_magnitudes_n(last) > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(num_with_force, 40'000) << "or nothing was tried";
}

TEST(HapticLoopProperty, TooFastIsZeroInTheSameTickWhicheverPointItIs) {
  RandomStream random(21, "over velocity");
  for (int run = 0; run < 300; ++run) {
    const auto& attached = kAttachments[random.below(kAttachments.size())];
    LoopScene scene(attached);
    scene.bring_to(kPhases[random.below(kPhases.size())]);
    const auto point = random.below(core::kNumContactPoints);
    const Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
    scene.device.state.tip_velocity_m_per_s[point] =
        random.uniform(5.01, 50.0) * direction.normalized();
    const bool is_held = attached[point];
    const core::PointVectors before = scene.last_received();
    scene.run(1);
    ASSERT_TRUE(is_safe(scene.last_received(), before, attached));
    if (!is_held) continue;
    ASSERT_EQ(sum_of_magnitudes_n(scene.last_received()), 0.0);
    ASSERT_EQ(scene.fault(), Fault::kOverVelocity);
  }
}

TEST(HapticLoopProperty, AThousandStopsAtRandomPhasesCutTheForceInTheirOwnTick) {
  RandomStream random(22, "stop");
  LoopScene scene;
  scene.command.ramp_s = 0.05;
  int num_in_force = 0;
  for (int press = 0; press < 1000; ++press) {
    // Some stops come into ramps, some into contact, into re-arming, into a fade, or on a
    // fault.
    if (random.with_probability(0.5)) scene.publish();
    scene.device.move_all(
        {0.1 * random.normal(), 0.0, random.with_probability(0.5) ? -0.05 : 0.05});
    scene.run(static_cast<int>(random.below(120)));
    if (random.with_probability(0.1)) {
      for (int tick = 0; tick < 260; ++tick) scene.loop.tick();
    }
    for (Eigen::Vector3d& position : scene.device.state.tip_position_m) {
      position = 0.9 * position + 0.1 * Eigen::Vector3d(0.0, position.y(), -0.105);
    }
    num_in_force += sum_of_magnitudes_n(scene.last_received()) > 0.01 ? 1 : 0;
    scene.stop.press();
    const auto held = static_cast<int>(random.below(20));
    for (int tick = 0; tick <= held; ++tick) {
      if (random.with_probability(0.3)) scene.arm();
      if (random.with_probability(0.3)) scene.publish();
      scene.run(1);
      ASSERT_EQ(sum_of_magnitudes_n(scene.last_received()), 0.0) << "press " << press;
      ASSERT_EQ(scene.fault(), Fault::kEmergencyStop);
    }
    ASSERT_TRUE(scene.stop.release(scene.stop.num_presses()));
    scene.run(1);
    ASSERT_EQ(sum_of_magnitudes_n(scene.last_received()), 0.0) << "released is not armed";
    scene.wait_to_arm();
    scene.arm();
    scene.run(1);
    ASSERT_LT(sum_of_magnitudes_n(scene.last_received()), 0.1) << "from zero";
  }
  EXPECT_GT(num_in_force, 300);
}

/// A mass that falls on a surface so hard that holding the force for a tick makes the surface
/// active.
class BouncingDevice final : public HapticDevice {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "bouncing"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return {.simulated = true};
  }
  void open() override {}
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    state = core::HapticState();
    state.device_time_ns = 1'000'000 * num_writes_;
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      state.tip_position_m[i] = {0.02 * i, 0.01 * (i % 2), z_m};
      state.tip_velocity_m_per_s[i].z() = v_m_per_s;
    }
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    double force_n = 0.0;
    for (const Eigen::Vector3d& force : force_on_hand_n) force_n += force.z();
    ++num_writes_;
    const double acceleration = force_n / kMassKg - kGravityMPerS2;
    const double way_m = 0.001 * v_m_per_s + 0.5e-6 * acceleration;
    v_m_per_s += 0.001 * acceleration;
    z_m += way_m;
    received_j += force_n * way_m;
    top_received_j = std::max(top_received_j, received_j);
    return true;
  }
  void close() noexcept override {}
  void halt() noexcept override {}
  /// The energy above the surface.
  [[nodiscard]] double energy_j() const {
    return kMassKg * (0.5 * v_m_per_s * v_m_per_s + kGravityMPerS2 * z_m);
  }

  double z_m = 0.02;
  double v_m_per_s = 0.0;
  double received_j = 0.0;
  double top_received_j = 0.0;

 private:
  static constexpr double kMassKg = 0.6;
  static constexpr double kGravityMPerS2 = 2.0;
  std::int64_t num_writes_ = 0;
};

constexpr double kWallNPerM = 10'000.0;

TEST(HapticLoopProperty, AnActiveSurfaceGivesOutNoMoreEnergyThanItGot) {
  BouncingDevice device;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop({.starts_armed = true}, device, {commands, telemetry, stop});
  commands.publish(
      {.sequence = 1, .medium = core::solid({.stiffness_n_per_m = kWallNPerM}), .ramp_s = 0.0});
  const double at_first_j = device.energy_j();
  for (int tick = 0; tick < 10'000; ++tick) loop.tick();
  // The way of the next tick is predicted from the velocity alone, with an error smaller than
  // the energy of one bounce; the next bounce pays it back.
  EXPECT_LT(device.top_received_j, 0.25 * at_first_j);
  const double after_ten_seconds_j = device.top_received_j;
  for (int tick = 0; tick < 50'000; ++tick) loop.tick();
  EXPECT_LT(device.top_received_j, 1.01 * after_ten_seconds_j) << "it does not add up";
  telemetry.fetch();
  EXPECT_EQ(telemetry.value().fault, Fault::kNone);
}

TEST(HapticLoopProperty, WithoutThePassivityControllerTheSameSurfaceGivesOutMore) {
  BouncingDevice device;
  core::SolidSurfaces surfaces;
  const core::MediumAmounts medium = core::solid({.stiffness_n_per_m = kWallNPerM});
  const double at_first_j = device.energy_j();
  for (int tick = 0; tick < 10'000; ++tick) {
    core::HapticState state;
    ASSERT_TRUE(device.read(state));
    core::PointVectors force;
    surfaces.render(medium, {}, core::kAreaShareRatio, state, 0.001, force);
    ASSERT_TRUE(device.write(force));
  }
  EXPECT_GT(device.top_received_j, 2.0 * at_first_j) << "or the test above proves nothing";
}

}  // namespace haptic_loop_property_test
}  // namespace jnd::device
