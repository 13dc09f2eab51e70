#include <gtest/gtest.h>

#include <limits>

#include "device/haptic_loop.h"
#include "haptic_loop_fixture.h"

namespace jnd::device {
namespace haptic_loop_arming_test {

using core::Arming;
using core::Fault;

/// A hand that moves through a thick fluid, on a loop that nobody has armed.
class LoopArmingTest : public HapticLoopTest {
 protected:
  LoopArmingTest() {
    starts_armed = false;
    make_loop({});
    device.move_all({0.2, 0.0, 0.0});
    command(core::viscous({.viscosity_pa_s = 8.0}));
  }
};

TEST_F(LoopArmingTest, ThereIsNoForceBeforeSomebodyAsksForIt) {
  run(2000);
  EXPECT_EQ(max_received_n(0), 0.0);
  EXPECT_EQ(telemetry().arming, Arming::kDisarmed);
  EXPECT_EQ(telemetry().fault, Fault::kNotArmed);
  EXPECT_EQ(telemetry().num_faults, 0U) << "nothing is wrong";
  EXPECT_FALSE(loop->flight_recorder().is_frozen());
}

TEST_F(LoopArmingTest, ItFadesInOverHalfASecond) {
  run(10);
  loop->rearm();
  run(1);
  EXPECT_EQ(telemetry().arming, Arming::kArming);
  run(250);
  const double half_n = device.last_total_n().norm();
  run(300);
  EXPECT_EQ(telemetry().arming, Arming::kArmed);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_NEAR(half_n / device.last_total_n().norm(), 0.5, 0.01);
}

TEST_F(LoopArmingTest, AHandThatIsBeingPutInIsNoFault) {
  device.state.tip_position_m[2].x() += 0.5;
  run(1);
  device.move_all({9.0, 0.0, 0.0});
  run(1);
  device.move_all({0.0, 0.0, 0.0});
  device.state.tip_position_m[2].x() = 3.0;
  run(1);
  EXPECT_EQ(telemetry().fault, Fault::kNotArmed);
}

TEST_F(LoopArmingTest, WhatIsWrongWithTheDeviceIsToldAllTheSame) {
  device.state.tip_position_m[0].x() = std::numeric_limits<double>::quiet_NaN();
  run(1);
  EXPECT_EQ(telemetry().fault, Fault::kNonFiniteState);
  EXPECT_EQ(telemetry().arming, Arming::kFaulted);
}

TEST_F(LoopArmingTest, AStopThatIsPressedHoldsAgainstArming) {
  stop.press();
  run(1);
  EXPECT_EQ(telemetry().fault, Fault::kEmergencyStop);
  const auto num_faults = telemetry().num_faults;
  loop->rearm();
  run(1000);
  EXPECT_EQ(max_received_n(0), 0.0);
  EXPECT_EQ(telemetry().num_faults, num_faults) << "it was armed for a part of a tick";
  EXPECT_TRUE(stop.release(stop.num_presses()));
  run(1000);
  EXPECT_EQ(max_received_n(0), 0.0) << "releasing is no arming";
  loop->rearm();
  run(1000);
  EXPECT_GT(max_received_n(0), 0.5);
}

TEST_F(LoopArmingTest, DisarmedIsZeroAtOnce) {
  loop->rearm();
  run(1000);
  loop->disarm();
  const std::size_t from = device.received.size();
  run(100);
  EXPECT_EQ(max_received_n(from), 0.0);
  EXPECT_EQ(telemetry().arming, Arming::kDisarmed);
  EXPECT_EQ(telemetry().num_faults, 0U);
}

TEST_F(LoopArmingTest, WhoAsksToArmAndToDisarmAtOnceGetsNoForce) {
  run(10);
  loop->disarm();
  loop->rearm();
  run(1000);
  EXPECT_EQ(max_received_n(0), 0.0);
  EXPECT_EQ(telemetry().arming, Arming::kDisarmed);
}

TEST_F(LoopArmingTest, AStopPressedAndReleasedBetweenTwoTicksLatches) {
  loop->rearm();
  run(1000);
  stop.press();
  ASSERT_TRUE(stop.release(stop.num_presses()));
  const std::size_t from = device.received.size();
  run(10);
  EXPECT_EQ(telemetry().fault, Fault::kEmergencyStop);
  EXPECT_EQ(max_received_n(from), 0.0);
}

TEST_F(LoopArmingTest, WhoAskedBeforeAStopHasToAskAgain) {
  run(10);
  loop->rearm();
  stop.press();
  ASSERT_TRUE(stop.release(stop.num_presses()));
  run(1000);
  EXPECT_EQ(max_received_n(0), 0.0) << "pressed and released before anybody looked";
  stop.press();
  run(10);
  loop->rearm();
  ASSERT_TRUE(stop.release(stop.num_presses()));
  run(1000);
  EXPECT_EQ(max_received_n(0), 0.0)
      << "asked for while it was pressed, just before its release";
  loop->rearm();
  run(1000);
  EXPECT_GT(max_received_n(0), 0.5);
}

TEST_F(LoopArmingTest, AMachineThatSleptIsAFault) {
  loop->rearm();
  run(1000);
  loop->suspended();
  const std::size_t from = device.received.size();
  run(10);
  EXPECT_EQ(telemetry().fault, Fault::kSuspended);
  EXPECT_EQ(max_received_n(from), 0.0);
  loop->rearm();
  run(1000);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
}

TEST_F(LoopArmingTest, WhoAsksWhileTheLoopStandsStillIsRefused) {
  const auto stand_still = [this](bool suspends) {
    suspends ? loop->suspended() : loop->stalled();
    loop->rearm();
    const std::size_t from = device.received.size();
    run(600);
    EXPECT_EQ(telemetry().fault, suspends ? Fault::kSuspended : Fault::kWatchdog);
    EXPECT_EQ(max_received_n(from), 0.0);
    loop->rearm();
    run(600);
    EXPECT_EQ(telemetry().fault, Fault::kNone) << "who has seen it may";
    loop->disarm();
    run(10);
  };
  stand_still(false);
  stand_still(true);
}

TEST_F(LoopArmingTest, WhoAsksWhileItStandsStillAgainIsRefusedToo) {
  loop->stalled();
  run(10);
  loop->rearm();
  loop->stalled();
  const std::size_t from = device.received.size();
  run(600);
  EXPECT_EQ(telemetry().fault, Fault::kWatchdog);
  EXPECT_EQ(max_received_n(from), 0.0) << "that it had stood still once before is no news";
}

TEST_F(LoopArmingTest, ADeviceThatWasHaltedGetsItsZerosFirst) {
  run(10);
  device.halt();
  device.halted = true;
  loop->rearm();
  run(1);
  EXPECT_FALSE(device.halted) << "a write of zeros has ended it";
  run(600);
  EXPECT_GT(device.last_total_n().norm(), 0.5);
}

/// If the same measurement comes again and again, the device is at fault, unless the loop
/// itself stood still.
TEST_F(LoopArmingTest, AnOldMeasurementIsTheMachinesFaultWhereTicksWereMissed) {
  for (const bool missed : {false, true}) {
    device.while_read = nullptr;
    make_loop({{.first_tick = 20, .num_ticks = 100, .injection = Injection::kStaleTime}});
    run(1);
    loop->rearm();
    for (int tick = 0; tick < 60; ++tick) {
      loop->due(1 + tick, missed && tick % 4 == 0 ? 2 : 0);
      run(1);
    }
    EXPECT_EQ(telemetry().fault, missed ? Fault::kHostTooSlow : Fault::kStaleSample);
  }
}

}  // namespace haptic_loop_arming_test
}  // namespace jnd::device
