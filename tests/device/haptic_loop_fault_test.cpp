#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "haptic_loop_fixture.h"

namespace jnd::device {
namespace haptic_loop_fault_test {

using core::Fault;

TEST_F(HapticLoopTest, TheEmergencyStopCutsTheForceInItsOwnTickAndStays) {
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(50);
  ASSERT_GT(max_received_n(49), 1.0);
  stop.press();
  run(1);
  EXPECT_EQ(max_received_n(50), 0.0);
  command(core::viscous({.viscosity_pa_s = 5.0}));
  loop->rearm();
  run(1000);
  EXPECT_EQ(max_received_n(50), 0.0) << "pressed, neither a command nor arming helps";
  EXPECT_EQ(telemetry().fault, Fault::kEmergencyStop);

  (void)stop.release(stop.num_presses());
  run(100);
  EXPECT_EQ(max_received_n(50), 0.0) << "released, it still has to be armed";
  loop->rearm();
  run(1);
  EXPECT_LT(max_received_n(50), 0.05) << "and comes back from zero";
  run(600);
  EXPECT_NEAR(device.last_total_n().x(), -1.776 * 5.0 * 0.5, 1e-9);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(HapticLoopTest, AStopOfAMomentIsNotMissed) {
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(50);
  stop.press();
  run(1);
  (void)stop.release(stop.num_presses());
  run(10);
  EXPECT_EQ(max_received_n(50), 0.0);
}

TEST_F(HapticLoopTest, ASilentWindowFadesTheForceOutWithoutAStep) {
  core::Heartbeat heartbeat;
  make_loop({}, {}, &heartbeat);
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  for (int i = 0; i < 100; ++i) {
    heartbeat.beat();
    run(1);
  }
  run(249);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  run(1);
  EXPECT_EQ(telemetry().fault, Fault::kHeartbeatLost);
  run(150);
  EXPECT_EQ(device.last_total_n().norm(), 0.0);
  for (std::size_t tick = 349; tick < 500; ++tick) {
    const double step = (device.received[tick][0] - device.received[tick - 1][0]).norm();
    EXPECT_LE(step, 0.35 * 8.88 / 100.0 + 1e-9) << tick;
  }
  heartbeat.beat();
  run(10);
  EXPECT_EQ(telemetry().fault, Fault::kHeartbeatLost) << "latched, though it beats again";
  loop->rearm();
  heartbeat.beat();
  run(1);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(HapticLoopTest, AStopDuringTheFadeCutsAtOnce) {
  core::Heartbeat heartbeat;
  make_loop({}, {}, &heartbeat);
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(300);
  ASSERT_GT(max_received_n(299), 0.1);
  stop.press();
  run(1);
  EXPECT_EQ(max_received_n(300), 0.0);
  EXPECT_EQ(telemetry().fault, Fault::kEmergencyStop);
}

TEST_F(HapticLoopTest, ACommandThatIsNoNumberIsAFaultThatARepairedCommandEnds) {
  device.move_all({0.5, 0.0, 0.0});
  command({.damping_n_s_per_m = std::numeric_limits<double>::quiet_NaN()}, 0.050);
  run(100);
  EXPECT_EQ(max_received_n(0), 0.0);
  EXPECT_EQ(telemetry().fault, Fault::kNonFiniteForce);
  command(core::viscous({.viscosity_pa_s = 1.0}), 0.050);
  run(10);
  loop->rearm();
  run(600);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_NEAR(device.last_total_n().x(), -0.888, 1e-9);
}

TEST_F(HapticLoopTest, AMediumThatIsNowhereIsAFaultAndNotFreeSpace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double core::Immersion::*const field :
       {&core::Immersion::origin_x_m, &core::Immersion::origin_y_m,
        &core::Immersion::origin_z_m, &core::Immersion::radius_m, &core::Immersion::depth_m}) {
    device = ScriptedDevice();
    make_loop({});
    device.move_all({0.5, 0.0, 0.0});
    core::HapticCommand nowhere{.sequence = ++sequence,
                                .medium = core::viscous({.viscosity_pa_s = 10.0})};
    nowhere.immersion.*field = nan;
    commands.publish(nowhere);
    run(1);
    EXPECT_EQ(telemetry().fault, Fault::kNonFiniteForce);
    EXPECT_EQ(device.last_total_n(), Eigen::Vector3d::Zero());
  }
}

TEST_F(HapticLoopTest, AMomentWithoutANewMeasurementIsBridged) {
  make_loop({{100, 3, Injection::kStaleTime}});
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(200);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_NEAR(device.received[101][0].x(), -0.35 * 8.88, 1e-9);
}

TEST_F(HapticLoopTest, ADeviceThatComesBackElsewhereCanBeArmed) {
  make_loop({{10, 10, Injection::kReadFailure}});
  run(20);
  EXPECT_EQ(telemetry().fault, Fault::kDeviceReadFailed);
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.x() += 0.3;
  loop->rearm();
  run(1);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(HapticLoopTest, ArmedAgainItBridgesAMomentAnew) {
  make_loop({{10, 20, Injection::kStaleTime}, {31, 2, Injection::kStaleTime}});
  run(30);
  EXPECT_EQ(telemetry().fault, Fault::kStaleSample);
  loop->rearm();
  run(10);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(HapticLoopTest, AHandAtRestIsNotTakenForAFrozenSample) {
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(1000);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(HapticLoopTest, APointThatCameOffGetsNothingAndTheOthersKeepTheirShare) {
  make_loop({{100, 1000, Injection::kDetachedPoint, core::ContactPoint::kMiddle}});
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(200);
  EXPECT_EQ(device.received[100][4], Eigen::Vector3d::Zero());
  EXPECT_NEAR(device.received[150][0].x(), -0.35 * 8.88, 1e-9);
  // A loose finger does not change what the other points feel, either.
  device.state.tip_velocity_m_per_s[4] = {-2.0, 1.0, 0.0};
  run(1);
  EXPECT_NEAR(device.received.back()[0].x(), -0.35 * 8.88, 1e-9);
  EXPECT_EQ(telemetry().sample.attached_bits, 0b01111);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(HapticLoopTest, ADanglingFingerDoesNotSteerTheForceOnTheOthers) {
  constexpr double kRightAngle = std::numbers::pi / 2.0;
  const core::ForceMap map({{.angle_of_attack_rad = 0.0, .drag_coefficient = 0.3},
                            {.angle_of_attack_rad = kRightAngle / 2.0,
                             .drag_coefficient = 0.6,
                             .lift_coefficient = 0.5},
                            {.angle_of_attack_rad = kRightAngle, .drag_coefficient = 0.9}});
  HapticLoop::Parameters parameters;
  parameters.force_map = &map;
  for (const core::MediumAmounts& medium :
       {core::water({}), core::mapped_water({}), core::ellipsoid({.viscosity_pa_s = 10.0})}) {
    device = ScriptedDevice();
    make_loop({}, parameters);
    device.move_all({0.4, 0.1, 0.0});
    device.state.attached[3] = false;
    command(medium);
    run(100);
    const Eigen::Vector3d before = device.received.back()[0];
    EXPECT_GT(before.norm(), 0.01);
    for (int tick = 0; tick < 20; ++tick) {
      device.state.tip_position_m[3] +=
          Eigen::Vector3d(tick % 2 == 0 ? 0.08 : -0.08, 0.0, 0.02);
      run(1);
      EXPECT_LT((device.received.back()[0] - before).norm(), 1e-9) << tick;
    }
    EXPECT_EQ(telemetry().fault, Fault::kNone);
  }
}

TEST_F(HapticLoopTest, ADeviceThatTakesNoMoreWritesIsHaltedAndDoesNotKeepItsLastForce) {
  make_loop({{100, 1'000'000, Injection::kWriteFailure}});
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(100);
  ASSERT_GT(device.standing_n[0].norm(), 1.0);
  for (int tick = 0; tick < 100; ++tick) {
    run(1);
    ASSERT_EQ(device.standing_n, core::zero_vectors()) << tick;
  }
  EXPECT_EQ(telemetry().fault, Fault::kDeviceWriteFailed);
}

TEST_F(HapticLoopTest, AStopOrABiteInTheMiddleOfATickStillCutsItsForce) {
  for (const bool by_watchdog : {false, true}) {
    for (const bool in_write : {false, true}) {
      SCOPED_TRACE(std::string(by_watchdog ? "watchdog" : "stop") +
                   (in_write ? ", in write" : ", in read"));
      device = ScriptedDevice();
      core::EmergencyStop pressed;
      core::WatchdogState watchdog;
      HapticLoop watched({.starts_armed = true}, device,
                         {commands, published_telemetry, pressed, nullptr, nullptr, &watchdog});
      device.move_all({0.5, 0.0, 0.0});
      command(core::viscous({.viscosity_pa_s = 10.0}));
      for (int tick = 0; tick < 100; ++tick) watched.tick();
      ASSERT_GT(device.standing_n[0].norm(), 1.0);
      const auto strike = [&] {
        if (!by_watchdog) return pressed.press();
        watchdog.bite();
        device.halt();
      };
      (in_write ? device.before_write : device.while_read) = strike;
      watched.tick();
      device.before_write = device.while_read = nullptr;
      // A stop that comes during the write is obeyed in the next tick.
      if (by_watchdog || !in_write) {
        EXPECT_EQ(device.standing_n, core::zero_vectors());
      }
      watched.tick();
      EXPECT_EQ(device.standing_n, core::zero_vectors());
    }
  }
}

TEST_F(HapticLoopTest, ALeapOfTheClockExcusesNoLeapOfTheHand) {
  device.move_all({0.1, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(100);
  device.state.device_time_ns += 1'000'000'000;
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.x() += 0.05;
  run(1);
  EXPECT_EQ(telemetry().fault, Fault::kPositionJump);
  EXPECT_EQ(device.last_total_n(), Eigen::Vector3d::Zero());
}

TEST_F(HapticLoopTest, OneFingerThatFreezesAmongMovingOnesIsSeen) {
  device.move_all({0.2, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(100);
  const Eigen::Vector3d frozen_m = device.state.tip_position_m[2];
  int ticks = 0;
  while (telemetry().fault == Fault::kNone && ticks < 50) {
    device.state.tip_position_m[2] = frozen_m;
    run(1);
    ++ticks;
  }
  EXPECT_EQ(telemetry().fault, Fault::kStaleSample);
  EXPECT_LE(ticks, 17) << "3 mm at 0.2 m/s";
}

TEST_F(HapticLoopTest, AnArmingWhileTheStopIsPressedChangesNothing) {
  run(50);
  stop.press();
  run(5);
  const std::size_t flight = loop->flight_recorder().contents().size();
  loop->rearm();
  run(5);
  EXPECT_EQ(telemetry().num_faults, 1U);
  EXPECT_TRUE(loop->flight_recorder().is_frozen());
  EXPECT_EQ(loop->flight_recorder().contents().size(), flight) << "still that of the stop";
  (void)stop.release(stop.num_presses());
  run(5);
  EXPECT_EQ(telemetry().fault, Fault::kEmergencyStop) << "nor does it wait to take effect";
}

TEST_F(HapticLoopTest, EveryFaultIsCounted) {
  EXPECT_EQ(telemetry().num_faults, 0U);
  for (std::uint64_t fault = 1; fault <= 3; ++fault) {
    stop.press();
    run(1);
    (void)stop.release(stop.num_presses());
    run(5);
    EXPECT_EQ(telemetry().num_faults, fault);
    loop->rearm();
    run(1);
  }
}

TEST_F(HapticLoopTest, AFilteredVelocityAfterAHandHasStoppedIsNotStale) {
  // After 0.5 m/s, a filter of 40 Hz shows 2 mm of further movement, and a coarse encoder
  // repeats its positions.
  command(core::viscous({.viscosity_pa_s = 8.0}));
  device.move_all({0.5, 0.0, 0.0});
  run(200);
  const core::PointVectors stopped_m = device.state.tip_position_m;
  double speed_m_per_s = 0.5;
  for (int tick = 0; tick < 100; ++tick) {
    speed_m_per_s *= std::exp(-2.0 * 3.14159265 * 40.0 * 0.001);
    device.state.tip_velocity_m_per_s.fill({speed_m_per_s, 0.0, 0.0});
    device.state.tip_position_m = stopped_m;
    run(1);
  }
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(HapticLoopTest, ADeviceTimeThatRunsBackIsStale) {
  device.state.device_time_ns = std::numeric_limits<std::int64_t>::max() - 2'000'000;
  run(1);
  for (int i = 0; i < 10; ++i) {
    device.state.device_time_ns = 1000 - i;
    run(1);
  }
  EXPECT_EQ(telemetry().fault, Fault::kStaleSample);
}

struct FaultCase {
  const char* name;
  ScheduledFault injected;
  Fault expected;
  int ticks_allowed;  ///< The number of ticks within which the device must have received zero.
};

class HapticLoopFaultTest : public HapticLoopTest,
                            public ::testing::WithParamInterface<FaultCase> {};

TEST_P(HapticLoopFaultTest, TheDeviceReceivesZeroUntilItIsArmedAgain) {
  const FaultCase& fault = GetParam();
  make_loop({fault.injected});
  device.move_all({0.5, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 10.0}));
  run(100);
  const std::size_t before = device.received.size();
  ASSERT_GT(max_received_n(before - 1), 1.0);
  run(400);
  const std::size_t zero_from = before + static_cast<std::size_t>(fault.ticks_allowed);
  EXPECT_EQ(max_received_n(zero_from), 0.0);
  EXPECT_LT(max_received_n(before), 8.88 * 0.35 + 1e-9) << "and never more than before";
  EXPECT_EQ(telemetry().fault, fault.expected);
  EXPECT_EQ(telemetry().sample.fault, static_cast<std::uint8_t>(fault.expected));
  samples.drain([](const core::Sample& sample) {
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_TRUE(std::isfinite(sample.tip_position_m[i][axis] +
                                  sample.tip_velocity_m_per_s[i][axis]));
      }
    }
  });

  const std::vector<core::Sample> flight = loop->flight_recorder().contents();
  EXPECT_TRUE(loop->flight_recorder().is_frozen());
  ASSERT_GT(flight.size(), 100U);
  EXPECT_EQ(flight.back().fault, static_cast<std::uint8_t>(fault.expected));
  EXPECT_EQ(flight[flight.size() - 2].fault, 0);

  loop->rearm();
  run(1);
  EXPECT_LT(device.last_total_n().norm(), 0.05) << "from zero";
  EXPECT_EQ(loop->flight_recorder().contents().size(), 1U) << "and a new flight begins";
  run(600);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_NEAR(device.last_total_n().x(), -8.88, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Every, HapticLoopFaultTest,
    ::testing::Values(
        FaultCase{"NonFinitePosition",
                  {100, 5, Injection::kNonFinitePosition},
                  Fault::kNonFiniteState,
                  0},
        FaultCase{"NonFiniteVelocity",
                  {100, 5, Injection::kNonFiniteVelocity},
                  Fault::kNonFiniteState,
                  0},
        FaultCase{
            "ReadFailure", {100, 5, Injection::kReadFailure}, Fault::kDeviceReadFailed, 0},
        FaultCase{
            "WriteFailure", {100, 5, Injection::kWriteFailure}, Fault::kDeviceWriteFailed, 0},
        FaultCase{"FrozenSample", {100, 50, Injection::kFrozenSample}, Fault::kStaleSample, 7},
        FaultCase{"StaleTime", {100, 50, Injection::kStaleTime}, Fault::kStaleSample, 5},
        FaultCase{"PositionJump",
                  {100, 50, Injection::kPositionJump, core::ContactPoint::kIndex, 0.05},
                  Fault::kPositionJump,
                  0},
        FaultCase{"VelocitySpike",
                  {100, 1, Injection::kVelocitySpike, core::ContactPoint::kThumb, 20.0},
                  Fault::kOverVelocity,
                  0}),
    [](const auto& fault_case) { return std::string(fault_case.param.name); });

}  // namespace haptic_loop_fault_test
}  // namespace jnd::device
