#include "device/haptic_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "device/lumped_hand_device.h"
#include "haptic_loop_fixture.h"
#include "support/allocation_counter.h"

namespace jnd::device {
namespace haptic_loop_test {

using core::Fault;

TEST_F(HapticLoopTest, RendersNothingBeforeAnyCommand) {
  device.move_all({1.0, 0.0, 0.0});
  run(10);
  EXPECT_EQ(max_received_n(0), 0.0);
  EXPECT_EQ(telemetry().command_sequence, 0U);
  EXPECT_EQ(telemetry().num_ticks, 10);
}

TEST_F(HapticLoopTest, SendsTheForceOfTheThesisForWaterHeadOn) {
  device.move_all({1.0, 0.0, 0.0});
  command(core::water({}));
  run(50);
  // The force is 6.585 N against the motion, of which each half of the palm bears 35 %.
  EXPECT_NEAR(device.last_total_n().x(), -6.58526, 1e-9);
  EXPECT_NEAR(device.received.back()[0].x(), -0.35 * 6.58526, 1e-9);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_FALSE(telemetry().limited);
  EXPECT_NEAR(telemetry().total_force_n[0], -6.58526, 1e-9);
  EXPECT_NEAR(telemetry().hand_velocity_m_per_s[0], 1.0, 1e-15);
}

TEST_F(HapticLoopTest, AChangeOfMediumIsARampAndNeverAStep) {
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 16.06}), 0.050);
  run(100);
  const double full_n = 1.776 * 16.06 * 0.5;
  EXPECT_NEAR(device.last_total_n().x(), -full_n, 1e-9);
  double last_n = 0.0;
  for (int tick = 0; tick < 100; ++tick) {
    double total_n = 0.0;
    for (const Eigen::Vector3d& force : device.received[tick]) total_n -= force.x();
    EXPECT_LE(std::abs(total_n - last_n), full_n / 50.0 + 1e-9) << tick;
    last_n = total_n;
  }
  EXPECT_TRUE(telemetry().ramp_finished);
}

TEST_F(HapticLoopTest, SaysWhetherTheRampIsOver) {
  command(core::viscous({.viscosity_pa_s = 1.0}), 0.050);
  run(25);
  EXPECT_FALSE(telemetry().ramp_finished);
  EXPECT_EQ(telemetry().command_sequence, 1U);
  run(30);
  EXPECT_TRUE(telemetry().ramp_finished);
}

TEST_F(HapticLoopTest, AHandAboveTheSurfaceFeelsNothing) {
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.z() += 1.0;
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(20);
  EXPECT_EQ(max_received_n(0), 0.0);
  EXPECT_EQ(telemetry().sample.immersed_bits, 0);
}

TEST_F(HapticLoopTest, AHandOnTheSolidSurfaceIsPushedUp) {
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.z() = -0.004;
  command(core::solid({.stiffness_n_per_m = 1000.0}));
  run(100);
  // The hand is 4 mm deep at 1000 N/m, after the surface has risen to its place under a hand
  // that began there.
  EXPECT_NEAR(device.last_total_n().z(), 4.0, 1e-9);
  EXPECT_NEAR(device.received.back()[0].z(), 0.35 * 4.0, 1e-9);
}

TEST_F(HapticLoopTest, TheSolidSurfaceIsTheFluidsSurface) {
  core::HapticCommand raised{.sequence = 1,
                             .medium = core::solid({.stiffness_n_per_m = 1000.0})};
  raised.immersion.origin_z_m = 0.5;
  raised.ramp_s = 0.0;
  commands.publish(raised);
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.z() = 0.498;
  run(100);
  EXPECT_NEAR(device.last_total_n().z(), 2.0, 1e-9);
}

TEST_F(HapticLoopTest, APointThatCameOffIsNoBusinessOfTheSurface) {
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.z() = -0.004;
  device.state.attached[0] = false;
  command(core::solid({.stiffness_n_per_m = 1000.0}), 0.050);
  run(100);
  EXPECT_NEAR(device.last_total_n().z(), 0.65 * 4.0, 1e-9);
  EXPECT_EQ(telemetry().num_limited_ticks, 0U) << "nothing was left for the limiter to take";
}

TEST_F(HapticLoopTest, ASurfaceThatHardensUnderTheHandGivesBackNoMoreThanItGot) {
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.z() = 0.0;
  command(core::solid({.stiffness_n_per_m = 200.0}));
  device.move_all({0.0, 0.0, -0.1});
  run(100);  // 10 mm deep, 10 mJ are stored.
  device.move_all({0.0, 0.0, 0.0});
  command(core::solid({.stiffness_n_per_m = 1000.0}), 0.050);
  run(100);  // It would now give back 50 mJ.
  device.move_all({0.0, 0.0, 0.1});
  run(150);
  double given_back_j = 0.0;
  for (std::size_t tick = 0; tick < device.received.size(); ++tick) {
    const double way_m = tick < 100 ? -0.0001 : tick < 200 ? 0.0 : 0.0001;
    for (const Eigen::Vector3d& force : device.received[tick]) {
      given_back_j += force.z() * way_m;
    }
  }
  EXPECT_LT(given_back_j, 1e-6);
  EXPECT_GT(given_back_j, -0.002) << "and nearly all that it got";
}

TEST_F(HapticLoopTest, RecordsWhatWasMeasuredAndSentInEveryTick) {
  make_loop({}, {.first_tick = 1000});
  device.move_all({1.0, 0.0, 0.0});
  command(core::water({}));
  run(30);
  std::vector<core::Sample> recorded;
  samples.drain([&recorded](const core::Sample& sample) { recorded.push_back(sample); });
  ASSERT_EQ(recorded.size(), 30U);
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    EXPECT_EQ(recorded[i].tick, 1000 + static_cast<std::int64_t>(i));
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(recorded[i].tip_force_n[point][axis], device.received[i][point][axis]);
      }
    }
  }
  EXPECT_EQ(recorded.back().command_sequence, 1U);
  EXPECT_EQ(recorded.back().attached_bits, 0b11111);
  EXPECT_EQ(recorded.back().immersed_bits, 0b11111);
  EXPECT_NEAR(recorded[7].tip_position_m[0][0], 0.007, 1e-12);
}

TEST_F(HapticLoopTest, CountsTheSamplesThatAFullQueueDropped) {
  core::SpscQueue<core::Sample> small(4);
  HapticLoop short_of_room({}, device, {commands, published_telemetry, stop, &small});
  for (int i = 0; i < 10; ++i) short_of_room.tick();
  EXPECT_EQ(telemetry().num_dropped_samples, 6U);
}

TEST_F(HapticLoopTest, MarksWhereTheLimiterChangedTheForce) {
  device.move_all({1.0, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 30.0}), 0.050);
  run(100);
  // The medium asks for 53 N, and the limits are 10 N at a point and 30 N in all: 10 + 10 + 3 *
  // 5.328 N, scaled.
  EXPECT_NEAR(device.last_total_n().norm(), 30.0, 1e-9);
  EXPECT_TRUE(telemetry().limited);
  EXPECT_EQ(telemetry().sample.limited, 1);
  EXPECT_GT(telemetry().num_limited_ticks, 40U);
  EXPECT_LT(telemetry().num_limited_ticks, 100U);
}

TEST_F(HapticLoopTest, TheWeakerOfLoopAndDeviceSetsTheLimit) {
  device.device_capabilities.max_force_per_point_n = 1.0;
  make_loop({});
  device.move_all({1.0, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 30.0}), 0.050);
  run(100);
  EXPECT_LE(max_received_n(0), 1.0 + 1e-12);
}

TEST_F(HapticLoopTest, RejectsParametersThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_loop({}, {.rate_hz = 0.0}), core::Error);
  EXPECT_THROW(make_loop({}, {.fade_speed_m_per_s = nan}), core::Error);
  EXPECT_THROW(make_loop({}, {.limits = {.total_n = -1.0}}), core::Error);
  EXPECT_THROW(make_loop({}, {.max_stale_s = nan}), core::Error);
  EXPECT_THROW(make_loop({}, {.rearm_s = 0.0}), core::Error);
}

TEST_F(HapticLoopTest, ATickDoesNotAllocateInAnyOfItsStates) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  core::Heartbeat heartbeat;
  make_loop({{50, 1, Injection::kNonFinitePosition}}, {}, &heartbeat);
  device.move_all({0.5, 0.0, 0.0});
  core::MediumAmounts everything = core::solid({.stiffness_n_per_m = 100.0});
  everything.quadratic_kg_per_m = 7.0;
  everything.damping_n_s_per_m = 50.0;
  const test_support::AllocationCounter counter;
  command(everything, 0.050);
  run(400);
  loop->rearm();
  run(400);
  stop.press();
  run(10);
  EXPECT_EQ(counter.allocations(), 0U);
}

TEST_F(HapticLoopTest, ATickWithTheSimulatedHandDoesNotAllocate) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  LumpedHandDevice hand(LumpedHandDevice::Parameters{.dry_friction_n = 0.3});
  HapticLoop hand_loop({}, hand, {commands, published_telemetry, stop, &samples});
  hand.open();
  const test_support::AllocationCounter counter;
  command(core::water({}), 0.050);
  hand.simulated_hand()->begin_strokes({.num_strokes = 1}, core::RandomStream(1, "stroke"));
  for (int i = 0; i < 6000; ++i) hand_loop.tick();
  hand.simulated_hand()->go_home();
  for (int i = 0; i < 1000; ++i) hand_loop.tick();
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_EQ(hand.simulated_hand()->strokes_finished(), 1);
}

TEST_F(HapticLoopTest, AddsUpWhatAHandIsExposedTo) {
  run(10);
  EXPECT_EQ(telemetry().exposure.force_time_n_s, 0.0) << "free space";
  command(core::viscous({.viscosity_pa_s = 8.0}));
  device.move_all({0.2, 0.0, 0.0});
  run(500);
  double force_time_n_s = 0.0;
  int num_felt = 0;
  for (const core::PointVectors& forces : device.received) {
    double whole_n = 0.0;
    for (const Eigen::Vector3d& force : forces) whole_n += force.norm();
    force_time_n_s += 0.001 * whole_n;
    if (whole_n >= 0.1) ++num_felt;
  }
  ASSERT_GT(force_time_n_s, 0.5);
  EXPECT_NEAR(telemetry().exposure.force_time_n_s, force_time_n_s, 1e-9);
  EXPECT_NEAR(telemetry().exposure.under_force_s, 0.001 * num_felt, 1e-9);
}

}  // namespace haptic_loop_test
}  // namespace jnd::device
