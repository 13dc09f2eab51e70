#include "device/lumped_hand_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "core/error.h"
#include "device/haptic_loop.h"

namespace jnd::device {
namespace lumped_hand_device_test {

core::PointVectors no_force() { return core::zero_vectors(); }

/// The hand, which a loop drives through a medium.
struct Laboratory {
  explicit Laboratory(const LumpedHandDevice::Parameters& parameters = {}) : hand(parameters) {
    hand.open();
  }

  void feel(const core::MediumAmounts& medium) {
    commands.publish({.sequence = ++sequence, .medium = medium, .ramp_s = 0.0});
    for (int i = 0; i < 20; ++i) loop.tick();
  }

  /// Makes these strokes. Returns what was felt over them.
  core::ContactSums stroke(const StrokePlan& plan, std::int64_t trial = 1) {
    const core::ContactSums from = hand.contact_sums();
    hand.simulated_hand()->begin_strokes(plan, core::RandomStream(5, "stroke", {trial}));
    while (hand.simulated_hand()->strokes_finished() < plan.num_strokes) tick();
    return hand.contact_sums() - from;
  }

  void tick() {
    loop.tick();
    telemetry.fetch();
    const core::Telemetry& now = telemetry.value();
    low_m = std::min(low_m, now.hand_position_m[0]);
    high_m = std::max(high_m, now.hand_position_m[0]);
    fastest_m_per_s = std::max(fastest_m_per_s, now.hand_velocity_m_per_s[0]);
  }

  LumpedHandDevice hand;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop{{.starts_armed = true}, hand, {commands, telemetry, stop}};
  std::uint64_t sequence = 0;
  double low_m = 1.0, high_m = -1.0, fastest_m_per_s = 0.0;
};

TEST(LumpedHandDevice, TheTipsLieOnTheGridOfARecordingAroundTheHand) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& tip : lumped_hand_tips_m()) {
    sum += tip;
    for (const double coordinate : tip) {
      EXPECT_NEAR(coordinate * 1e7, std::round(coordinate * 1e7), 1e-6);
    }
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-15);
  // A stroke along x meets the medium head on.
  EXPECT_NEAR(std::abs(core::hand_plane_normal(lumped_hand_tips_m()).x()), 1.0, 1e-15);
}

TEST(LumpedHandDevice, ItsTimeMovesOnByOnePeriodAWrite) {
  LumpedHandDevice hand(LumpedHandDevice::Parameters{.rate_hz = 500.0});
  hand.open();
  core::HapticState state;
  for (int tick = 0; tick < 5; ++tick) {
    ASSERT_TRUE(hand.read(state));
    EXPECT_EQ(state.device_time_ns, tick * 2'000'000);
    ASSERT_TRUE(hand.write(no_force()));
  }
}

TEST(LumpedHandDevice, AFreeMassObeysNewton) {
  LumpedHandDevice hand(LumpedHandDevice::Parameters{
      .mass_kg = 2.0, .arm = {.stiffness_n_per_m = 0.0, .damping_n_s_per_m = 0.0}});
  hand.open();
  core::PointVectors force = no_force();
  force[0] = {1.0, 0.0, 0.0};
  force[3] = {3.0, 0.0, 0.0};
  for (int tick = 0; tick < 100; ++tick) ASSERT_TRUE(hand.write(force));
  core::HapticState state;
  ASSERT_TRUE(hand.read(state));
  // 4 N act on 2 kg for 0.1 s.
  EXPECT_NEAR(state.tip_velocity_m_per_s[2].x(), 0.2, 1e-12);
  EXPECT_NEAR(state.tip_position_m[2].x(), 0.5 * 2.0 * 0.01, 1.1e-4);
}

TEST(LumpedHandDevice, MechanicalViscosityAndFrictionSlowAFreeHandDown) {
  LumpedHandDevice hand(LumpedHandDevice::Parameters{
      .mass_kg = 1.0,
      .mechanical_viscosity_n_s_per_m = 5.0,
      .dry_friction_n = 0.4,
      .arm = {.stiffness_n_per_m = 0.0, .damping_n_s_per_m = 0.0}});
  hand.open();
  core::PointVectors push = no_force();
  push[0] = {500.0, 0.0, 0.0};
  ASSERT_TRUE(hand.write(push));
  core::HapticState state;
  ASSERT_TRUE(hand.read(state));
  const double start = state.tip_velocity_m_per_s[0].x();
  EXPECT_NEAR(start, 0.5, 1e-12);
  ASSERT_TRUE(hand.write(no_force()));
  ASSERT_TRUE(hand.read(state));
  // One step of 1 ms has 5 * 0.5 + 0.4 * 0.5 / sqrt(0.25 + 0.0001) N.
  EXPECT_NEAR(state.tip_velocity_m_per_s[0].x(), 0.5 - 0.001 * (2.5 + 0.4 * 0.9998000600),
              1e-9);
  for (int tick = 0; tick < 5000; ++tick) ASSERT_TRUE(hand.write(no_force()));
  ASSERT_TRUE(hand.read(state));
  EXPECT_NEAR(state.tip_velocity_m_per_s[0].x(), 0.0, 1e-9) << "and it comes to rest";
}

TEST(LumpedHandDevice, WhatWasFeltIsTheMediumPlusTheDevice) {
  Laboratory laboratory(LumpedHandDevice::Parameters{.mechanical_viscosity_n_s_per_m = 4.83});
  for (const double viscosity : {1.093, 1.853, 3.883, 10.1, 16.06}) {
    laboratory.feel(core::viscous({.viscosity_pa_s = viscosity}));
    const core::ContactSums felt = laboratory.stroke({.num_strokes = 2});
    // At slow turning points, where each tip's share fades, the rendered force is a hair
    // smaller.
    EXPECT_NEAR(felt.delivered_damping_n_s_per_m(), 1.776 * viscosity, 1e-3 * viscosity);
    EXPECT_NEAR((felt.opposing_n - felt.rendered_opposing_n) / felt.speed_m_per_s, 4.83, 1e-9);
  }
}

TEST(LumpedHandDevice, FrictionIsFeltAndIsNotRendered) {
  Laboratory laboratory(LumpedHandDevice::Parameters{.dry_friction_n = 0.4});
  const core::ContactSums felt = laboratory.stroke({.num_strokes = 2});
  EXPECT_EQ(felt.delivered_damping_n_s_per_m(), 0.0);
  EXPECT_NEAR(felt.opposing_n / static_cast<double>(felt.num_ticks), 0.4, 0.02);
}

TEST(LumpedHandDevice, TheContactSumsLeaveWithTheTelemetry) {
  Laboratory laboratory;
  laboratory.feel(core::viscous({.viscosity_pa_s = 2.0}));
  laboratory.stroke({.num_strokes = 1});
  EXPECT_EQ(laboratory.telemetry.value().contact_sums.num_ticks,
            laboratory.hand.contact_sums().num_ticks);
  EXPECT_GT(laboratory.telemetry.value().contact_sums.opposing_n, 0.0);
}

TEST(LumpedHandDevice, OpenedAgainItStartsAfresh) {
  Laboratory laboratory;
  EXPECT_TRUE(laboratory.hand.simulated_hand()->is_home());
  laboratory.hand.simulated_hand()->begin_strokes({}, core::RandomStream(1, "stroke"));
  EXPECT_FALSE(laboratory.hand.simulated_hand()->is_home())
      << "even before the loop has heard of it";
  for (int tick = 0; tick < 500; ++tick) laboratory.tick();
  laboratory.hand.open();
  EXPECT_EQ(laboratory.hand.contact_sums().num_ticks, 0);
  EXPECT_EQ(laboratory.hand.contact_sums().speed_m_per_s, 0.0);
  core::HapticState state;
  ASSERT_TRUE(laboratory.hand.read(state));
  EXPECT_EQ(state.device_time_ns, 0);
  EXPECT_EQ(state.tip_position_m[0].x(), 0.0);
}

TEST(LumpedHandDevice, AThickerMediumSlowsTheHandDown) {
  double last_width_m = 1.0;
  double last_speed_m_per_s = 1.0;
  for (const double viscosity : {1.853, 16.06, 29.335}) {
    Laboratory laboratory(LumpedHandDevice::Parameters{.arm = {.stiffness_n_per_m = 120.0}});
    laboratory.feel(core::viscous({.viscosity_pa_s = viscosity}));
    laboratory.stroke({.num_strokes = 2});
    const double width_m = laboratory.high_m - laboratory.low_m;
    EXPECT_LT(width_m, last_width_m);
    EXPECT_LT(laboratory.fastest_m_per_s, last_speed_m_per_s);
    EXPECT_GT(width_m, 0.2);
    last_width_m = width_m;
    last_speed_m_per_s = laboratory.fastest_m_per_s;
  }
}

TEST(LumpedHandDevice, IsBackHomeWithinASecondInFreeSpace) {
  Laboratory laboratory;
  laboratory.stroke({.num_strokes = 1});
  laboratory.hand.simulated_hand()->go_home();
  EXPECT_FALSE(laboratory.hand.simulated_hand()->is_home());
  for (int tick = 0; tick < 900; ++tick) laboratory.tick();
  EXPECT_TRUE(laboratory.hand.simulated_hand()->is_home());
  EXPECT_NEAR(laboratory.telemetry.value().hand_position_m[0], 0.0, 0.002);
}

TEST(LumpedHandDevice, CountsTheStrokesOfTheOrderInForceAlone) {
  Laboratory laboratory;
  laboratory.stroke({.num_strokes = 2});
  EXPECT_EQ(laboratory.hand.simulated_hand()->strokes_finished(), 2);
  laboratory.hand.simulated_hand()->begin_strokes({.num_strokes = 1},
                                                  core::RandomStream(1, "stroke"));
  EXPECT_EQ(laboratory.hand.simulated_hand()->strokes_finished(), 0)
      << "even before the loop has heard of it";
  EXPECT_FALSE(laboratory.hand.simulated_hand()->is_home());
  laboratory.tick();
  EXPECT_EQ(laboratory.hand.simulated_hand()->strokes_finished(), 0);
  while (laboratory.hand.simulated_hand()->strokes_finished() < 1) laboratory.tick();
  laboratory.hand.simulated_hand()->go_home();
  EXPECT_EQ(laboratory.hand.simulated_hand()->strokes_finished(), 1)
      << "going home takes none away";
  laboratory.tick();
  EXPECT_EQ(laboratory.hand.simulated_hand()->strokes_finished(), 1);
}

TEST(LumpedHandDevice, RepeatsARunToTheBit) {
  const auto run = [] {
    Laboratory laboratory(LumpedHandDevice::Parameters{.mechanical_viscosity_n_s_per_m = 4.83,
                                                       .dry_friction_n = 0.2});
    laboratory.feel(core::water({.scale = 2.0}));
    laboratory.stroke({.num_strokes = 3});
    return laboratory.telemetry.value();
  };
  const core::Telemetry one = run();
  const core::Telemetry two = run();
  EXPECT_EQ(one.num_ticks, two.num_ticks);
  EXPECT_EQ(std::memcmp(&one.contact_sums, &two.contact_sums, sizeof one.contact_sums), 0);
  EXPECT_EQ(std::memcmp(&one.hand_position_m, &two.hand_position_m, sizeof one.hand_position_m),
            0);
}

TEST(LumpedHandDevice, StaysCalmInEveryStimulusOfTheStudiesAndOnASurface) {
  for (const core::MediumAmounts& medium :
       {core::water({.scale = 8.0}), core::viscous({.viscosity_pa_s = 29.335}),
        core::solid({.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 10.0})}) {
    Laboratory laboratory;
    laboratory.feel(medium);
    laboratory.stroke({.height_m = -0.02, .num_strokes = 2});
    EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kNone);
    EXPECT_LT(laboratory.fastest_m_per_s, 0.6);
  }
}

TEST(LumpedHandDevice, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Parameters = LumpedHandDevice::Parameters;
  EXPECT_THROW(LumpedHandDevice(Parameters{.rate_hz = nan}), core::Error);
  EXPECT_THROW(LumpedHandDevice(Parameters{.mass_kg = 0.0}), core::Error);
  EXPECT_THROW(LumpedHandDevice(Parameters{.mechanical_viscosity_n_s_per_m = -1.0}),
               core::Error);
  EXPECT_THROW(LumpedHandDevice(Parameters{.dry_friction_n = nan}), core::Error);
  EXPECT_THROW(LumpedHandDevice(Parameters{.friction_speed_m_per_s = 0.0}), core::Error);
  EXPECT_THROW(LumpedHandDevice(Parameters{.max_total_force_n = nan}), core::Error);
  // With 20 N s/m of arm damping, 10 g would become unstable within two periods.
  EXPECT_THROW(LumpedHandDevice(Parameters{.mass_kg = 0.01}), core::Error);
  Laboratory laboratory;
  EXPECT_THROW(laboratory.hand.simulated_hand()->begin_strokes({.amplitude_m = nan},
                                                               core::RandomStream(1, "")),
               core::Error);
}

}  // namespace lumped_hand_device_test
}  // namespace jnd::device
