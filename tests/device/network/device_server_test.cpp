#include "device/network/device_server.h"

#include <gtest/gtest.h>

#include "device/fault_injection.h"
#include "device_server_fixture.h"

namespace jnd::device {
namespace device_server_test {

using core::Fault;

TEST_F(DeviceServerTest, PassesOnTheForceOfAnArmedProgram) {
  arm();
  talk(5, 1.5);
  EXPECT_EQ(felt_n(), 1.5);
  EXPECT_EQ(server.counts().num_armings, 1);
}

TEST_F(DeviceServerTest, DoesNotArmOnACommandWithForce) {
  connect();
  talk(400, 1.0);
  EXPECT_FALSE(program.state.armed);
  EXPECT_EQ(felt_n(), 0.0);
}

TEST_F(DeviceServerTest, DoesNotArmBeforeTheConnectionHasBeenGoodForAWhile) {
  connect();
  talk(100, 0.0);
  EXPECT_FALSE(program.state.armed);
  for (int i = 0; i < 600; ++i) {
    if (i % 8 == 0) ++program.sequence;
    talk(1, 0.0);
  }
  EXPECT_FALSE(program.state.armed) << "one in nine is lost";
  EXPECT_LT(program.state.level, LinkLevel::kGood);
}

TEST_F(DeviceServerTest, DoesNotArmOnAnAnswerToAnOldState) {
  connect();
  program.answers = false;
  talk(400, 0.0);
  EXPECT_FALSE(program.state.armed);
  program.answers = true;
  talk(2, 0.0);
  EXPECT_TRUE(program.state.armed);
}

TEST_F(DeviceServerTest, DoesNotArmBeforeItHasMeasuredARoundTrip) {
  connect();
  program.echoes = false;
  talk(400, 0.0);
  EXPECT_FALSE(program.state.armed);
  program.echoes = true;
  program.late_ns = -3600 * 1'000'000'000LL;
  talk(50, 0.0);
  EXPECT_FALSE(program.state.armed) << "an hour ahead of our own clock";
  program.late_ns = 0;
  talk(2, 0.0);
  EXPECT_TRUE(program.state.armed);
}

TEST_F(DeviceServerTest, ATooSlowWayBackEndsTheForce) {
  arm();
  talk(10, 1.0);
  EXPECT_NEAR(server.quality().round_trip_s(), 0.001, 1e-6);
  program.late_ns = 30 * kMs;
  talk(30, 1.0);
  EXPECT_EQ(felt_n(), 1.0) << "older echoes than before tell nothing";
  talk(60, 1.0);
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(program.state.fault, Fault::kLinkLost);
  EXPECT_EQ(program.state.level, LinkLevel::kUnacceptable);
}

TEST_F(DeviceServerTest, WhatWaitedWhileEverythingStoodStillCountsForNothing) {
  arm();
  talk(10, 1.0);
  program.command(1.5);
  network.now_ns += 300 * kMs;
  step();
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(program.state.fault, Fault::kWatchdog);
  talk(200, 1.0);
  EXPECT_EQ(felt_n(), 0.0) << "the old number";
  // An echo from before the pause would also make the connection too bad, so none is sent.
  program.echoes = false;
  program.command(0.0, 2);
  network.now_ns += 300 * kMs;
  step();
  EXPECT_FALSE(program.state.armed) << "asked before the pause";
  program.echoes = true;
  talk(1, 0.0, 2);
  talk(1, 1.0, 2);
  EXPECT_EQ(felt_n(), 1.0);
}

TEST_F(DeviceServerTest, AForceThatAnswersToAnOldStateEnds) {
  arm();
  talk(10, 1.0);
  program.answers = false;
  talk(35, 1.0);
  EXPECT_EQ(felt_n(), 1.0);
  talk(10, 1.0);
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(program.state.fault, Fault::kLinkLost);
}

TEST_F(DeviceServerTest, OnceDisarmedItWaitsForAnotherNumber) {
  arm();
  talk(10, 1.0);
  for (int i = 0; i < 19; ++i) step();
  EXPECT_EQ(felt_n(), 1.0);
  step();
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(server.counts().num_disarmings, 1);
  talk(300, 0.0);
  talk(10, 1.0);
  EXPECT_EQ(felt_n(), 0.0) << "the old number";
  talk(10, 1.0, 2);
  EXPECT_EQ(felt_n(), 0.0) << "a new number with force";
  talk(1, 0.0, 2);
  talk(1, 1.0, 2);
  EXPECT_EQ(felt_n(), 1.0);
}

TEST_F(DeviceServerTest, NumberZeroIsNoArming) {
  arm();
  talk(10, 0.0, 0);
  EXPECT_FALSE(program.state.armed) << "it means no force of the arming before";
  talk(10, 1.0, 0);
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(server.counts().num_armings, 1);
}

TEST_F(DeviceServerTest, AnotherNumberTakesTheForceOfTheOneBefore) {
  arm();
  talk(10, 1.0);
  talk(1, 1.0, 2);
  EXPECT_EQ(felt_n(), 0.0);
}

TEST_F(DeviceServerTest, ForcesAreLimitedAgain) {
  arm();
  program.command(9.0);
  step();
  EXPECT_NEAR(felt_n(), 2.0, 1e-12) << "the slew";
  talk(20, 1000.0);
  EXPECT_NEAR(felt_n(), 10.0, 1e-9) << "the point's limit";
  device.state.attached[0] = false;
  talk(1, 9.0);
  EXPECT_EQ(felt_n(), 0.0) << "off the hand";
}

TEST_F(DeviceServerTest, WhoAsksForNoForceAnyMoreGetsNoneAtOnce) {
  arm();
  talk(20, 9.0);
  ASSERT_EQ(felt_n(), 9.0);
  talk(1, 0.0);
  EXPECT_EQ(felt_n(), 0.0) << "a stop is not slowed down by the slew";
  talk(1, 9.0);
  EXPECT_EQ(felt_n(), 2.0) << "and what comes back begins at zero";
}

TEST_F(DeviceServerTest, ADeviceThatTakesNoWritesIsHaltedAndDoesNotKeepItsLastForce) {
  arm();
  talk(20, 5.0);
  ASSERT_EQ(felt_n(), 5.0);
  FaultInjectingDevice faulty(device,
                              {{.num_ticks = 3, .injection = Injection::kWriteFailure}});
  faulty.open();
  const auto other_port = network.port(address_number(3));
  DeviceServer other(faulty, *other_port, {});
  other.step(network.now_ns);
  EXPECT_TRUE(device.halted);
  EXPECT_EQ(device.standing_n, core::zero_vectors());
}

TEST_F(DeviceServerTest, ATooFastHandEndsTheForce) {
  arm();
  talk(10, 1.0);
  device.state.tip_velocity_m_per_s[0].x() = 6.0;
  talk(2, 1.0);
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(program.state.fault, Fault::kOverVelocity);
}

TEST_F(DeviceServerTest, AnOlderCommandDoesNotReplaceANewerOne) {
  arm();
  talk(5, 1.0);
  const std::uint32_t skipped = ++program.sequence;
  talk(1, 1.2);
  EXPECT_EQ(felt_n(), 1.2);
  program.send(program.with_force(0.3), skipped);
  step();
  EXPECT_EQ(felt_n(), 1.2);
  EXPECT_EQ(server.quality().counts().reordered, 1);
}

TEST_F(DeviceServerTest, ARepeatedDatagramCountsForNothing) {
  arm();
  talk(5, 1.0);
  const std::uint32_t last = program.sequence;
  for (int i = 0; i < 30; ++i) {
    program.send(program.with_force(1.0), last);
    step();
  }
  EXPECT_EQ(felt_n(), 0.0) << "it keeps nothing alive";
}

TEST_F(DeviceServerTest, ADeviceThatCannotBeReadGetsNoForceUntilArmedAnew) {
  FaultInjectingDevice faulty(device, {{.first_tick = 250, .num_ticks = 5}});
  faulty.open();
  DeviceServer served(faulty, *port, {});
  const auto talk_to = [&](int num_ticks, double force_n) {
    for (int i = 0; i < num_ticks; ++i) {
      program.command(force_n);
      network.now_ns += kMs;
      served.step(network.now_ns);
      program.take_in();
    }
  };
  program.hello(1);
  talk_to(200, 0.0);
  talk_to(40, 1.0);
  EXPECT_EQ(felt_n(), 1.0);
  talk_to(12, 1.0);
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_FALSE(program.state.is_measured);
  EXPECT_EQ(program.state.fault, Fault::kDeviceReadFailed);
  talk_to(20, 1.0);
  EXPECT_TRUE(program.state.is_measured);
  EXPECT_EQ(felt_n(), 0.0);
}

TEST_F(DeviceServerTest, AHaltTakesTheForceUntilArmedAnew) {
  arm();
  talk(5, 1.0);
  program.send(wire::Halt{});
  talk(5, 1.0);
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(program.state.fault, Fault::kWatchdog);
  talk(1, 0.0, 2);
  talk(1, 1.0, 2);
  EXPECT_EQ(felt_n(), 1.0);
}

TEST_F(DeviceServerTest, AHaltOfLongAgoIsNotTakenForANewOne) {
  arm();
  program.send(wire::Halt{});
  const std::uint32_t halted = program.sequence;
  talk(1, 0.0);
  talk(1, 0.0, 2);
  talk(5, 1.0, 2);
  program.send(wire::Halt{}, halted);
  talk(1, 1.0, 2);
  EXPECT_EQ(felt_n(), 1.0);
}

TEST_F(DeviceServerTest, AnOpenSwitchEndsTheForceAndClosingItBringsNone) {
  arm();
  talk(5, 1.0);
  ASSERT_EQ(felt_n(), 1.0);
  device.state.enabled = false;
  talk(1, 1.0);
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_FALSE(program.state.armed);
  EXPECT_EQ(program.state.fault, Fault::kNotEnabled);
  EXPECT_FALSE(program.state.measured.enabled);
  talk(200, 0.0, 2);
  EXPECT_TRUE(program.state.armed) << "a program may get ready";
  talk(5, 1.0, 2);
  EXPECT_EQ(felt_n(), 0.0) << "and gets no force";
  device.state.enabled = true;
  talk(5, 1.0, 2);
  EXPECT_EQ(felt_n(), 0.0) << "nor does a force that waits for the switch";
  talk(200, 0.0, 3);
  talk(5, 1.0, 3);
  EXPECT_EQ(felt_n(), 1.0);
}

}  // namespace device_server_test
}  // namespace jnd::device
