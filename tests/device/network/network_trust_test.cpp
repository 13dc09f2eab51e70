#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "network_fault_fixture.h"

namespace jnd::device {
namespace network_trust_test {

using core::Fault;

/// Tests that neither side trusts what the other says of itself and of time further than it can
/// check this.
class NetworkTrustTest : public NetworkFaultTest {};

TEST_P(NetworkTrustTest, APoorConnectionGoesOnAndIsNotArmedAgain) {
  for (const Address& to : {kServer, kProgram}) {
    lose_every(25, to);
    run(700);
    EXPECT_EQ(fault(), Fault::kNone) << "four in a hundred are bridged";
    EXPECT_GT(total_now_n(), 0.5);
    press_and_release_stop();
    const std::size_t refused = mark();
    arm_loop();
    run(600);
    EXPECT_EQ(max_total_since_n(refused), 0.0);
    EXPECT_EQ(fault(), Fault::kLinkLost) << "it says what is wrong";
    network.on_send = nullptr;
    expect_force_comes_back_when_armed();
  }
}

TEST_P(NetworkTrustTest, AForceIsNotOlderThanTheConnectionMayBeSlow) {
  struct Case {
    int one_way_ms;
    bool goes_on, may_arm;
  };
  for (const Case& delayed : {Case{2, true, true}, Case{5, true, false}, Case{10, false, false},
                              Case{20, false, false}}) {
    delay_all(delayed.one_way_ms);
    run(300);
    EXPECT_EQ(fault(), delayed.goes_on ? Fault::kNone : Fault::kLinkLost) << delayed.one_way_ms;
    EXPECT_EQ(total_now_n() > 0.5, delayed.goes_on) << delayed.one_way_ms;
    if (delayed.goes_on) {
      press_and_release_stop();
      arm_loop();
      run(700);
      EXPECT_EQ(total_now_n() > 0.5, delayed.may_arm) << delayed.one_way_ms;
      EXPECT_EQ(fault(), delayed.may_arm ? Fault::kNone : Fault::kLinkLost);
    }
    network.on_send = nullptr;
    run(700);
    arm_loop();
    run(700);
    EXPECT_GT(total_now_n(), 0.5) << delayed.one_way_ms;
  }
}

TEST_P(NetworkTrustTest, AnArmingThatIsNotOursEndsTheForce) {
  struct Case {
    bool armed;
    std::uint32_t number;
    Fault fault, latched;
  };
  for (const Case& other : {Case{false, 0, Fault::kOverVelocity, Fault::kOverVelocity},
                            Case{false, 0, Fault::kNone, Fault::kLinkLost},
                            Case{true, 77, Fault::kNone, Fault::kLinkLost}}) {
    change_states([&other](wire::Header&, wire::State& state) {
      state.armed = other.armed;
      state.armed_number = other.number;
      state.fault = other.fault;
    });
    run(2);
    EXPECT_EQ(fault(), other.latched);
    EXPECT_EQ(total_now_n(), 0.0);
    run(500);
    EXPECT_EQ(total_now_n(), 0.0);
    network.on_send = nullptr;
    expect_force_comes_back_when_armed(other.latched);
  }
}

TEST_P(NetworkTrustTest, AMeasurementThatFailedIsNoneWhateverTheDeviceGoesOnWith) {
  change_states([](wire::Header&, wire::State& state) { state.is_measured = false; });
  run(2);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  EXPECT_EQ(total_now_n(), 0.0);
  run(500);
  EXPECT_EQ(total_now_n(), 0.0);
  network.on_send = nullptr;
  expect_force_comes_back_when_armed();
}

TEST_P(NetworkTrustTest, ADeviceThatDoesNotHearUsIsNotTrusted) {
  for (const std::int64_t echo_ns : {std::int64_t{0}, network.now_ns + 1'000'000'000'000'000,
                                     std::numeric_limits<std::int64_t>::min()}) {
    change_states([echo_ns](wire::Header& header, wire::State&) { header.echo_ns = echo_ns; });
    run(50);
    EXPECT_EQ(fault(), Fault::kNone) << echo_ns << " may be lost commands";
    run(12);
    EXPECT_EQ(fault(), Fault::kLinkLost) << echo_ns;
    EXPECT_EQ(total_now_n(), 0.0) << echo_ns;
    run(300);
    arm_loop();
    run(300);
    EXPECT_EQ(total_now_n(), 0.0) << echo_ns;
    network.on_send = nullptr;
    expect_force_comes_back_when_armed();
  }
}

TEST_P(NetworkTrustTest, WhateverFaultTheDeviceTellsOfNothingFades) {
  for (int number = 1; number <= static_cast<int>(core::kLastFault); ++number) {
    change_states([number](wire::Header&, wire::State& state) {
      state.armed = false;
      state.fault = static_cast<Fault>(number);
    });
    run(1);
    published_telemetry.fetch();
    const core::Telemetry& now = published_telemetry.value();
    EXPECT_NE(now.fault, Fault::kNone) << number;
    EXPECT_NE(now.fault, Fault::kHeartbeatLost) << "ours alone";
    EXPECT_EQ(now.authority_ratio, 0.0) << number;
    for (const core::PlainVector& force : now.sample.tip_force_n) {
      EXPECT_EQ(force, (core::PlainVector{0.0, 0.0, 0.0})) << number;
    }
    network.on_send = nullptr;
    run(300);
    arm_loop();
    run(700);
    EXPECT_GT(total_now_n(), 0.5) << number;
  }
}

TEST_P(NetworkTrustTest, CommandsThatCannotBeSentAreNoticedBeforeTheDeviceDoes) {
  network.unplugged = kProgram;
  run(4);
  network.unplugged.reset();
  run(50);
  EXPECT_EQ(fault(), Fault::kNone) << "a few are bridged";
  network.unplugged = kProgram;
  run(5);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  run(20);
  EXPECT_EQ(total_now_n(), 0.0) << "by the device's own watchdog";
  network.unplugged.reset();
  expect_force_comes_back_when_armed();
}

TEST_P(NetworkTrustTest, AFreezeOfTheWholeMachineLeavesNoForce) {
  for (const int num_ms : {30, 300, 5000}) {
    run(50);
    ASSERT_GT(total_now_n(), 0.5);
    // A command waits while everything stands still; the server wakes up first.
    const std::size_t frozen = mark();
    network.now_ns += num_ms * kMs;
    run(100);
    EXPECT_EQ(max_total_since_n(frozen), 0.0) << num_ms;
    EXPECT_NE(fault(), Fault::kNone) << num_ms;
    expect_force_comes_back_when_armed(fault());
  }
}

/// The clocks of two machines are 0.3 ms apart, and one is faster by 100 ppm, so that their
/// ticks pass one another within fifteen seconds.
TEST_P(NetworkTrustTest, ClocksThatDriftPastOneAnotherChangeNothing) {
  network.on_millisecond = nullptr;
  const std::int64_t start_ns = network.now_ns;
  std::int64_t num_ticks = 0, num_steps = 0;
  const std::size_t first = mark();
  while (num_ticks < 15'000) {
    const std::int64_t tick_ns = start_ns + (num_ticks + 1) * kMs;
    const std::int64_t step_ns = start_ns + 300'000 + (num_steps + 1) * 999'900;
    network.now_ns = std::min(tick_ns, step_ns);
    if (tick_ns <= step_ns) {
      ++num_ticks;
      loop->tick();
      continue;
    }
    if (num_steps++ % 500 == 0) {
      scripted.move_all({num_steps / 500 % 2 == 0 ? 0.3 : -0.3, 0.0, 0.0});
    }
    server->step(step_ns);
  }
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_EQ(server->counts().num_disarmings, 0);
  EXPECT_EQ(num_steps, 15'001);
  EXPECT_EQ(device->quality().level(), LinkLevel::kExcellent);
  EXPECT_EQ(server->quality().level(), LinkLevel::kExcellent);
  EXPECT_LT(device->quality().round_trip_s(), 0.003);
  EXPECT_GT(max_total_since_n(first), 0.5);
  expect_safe_forces(first);
}

INSTANTIATE_TEST_SUITE_P(Points, NetworkTrustTest, ::testing::Values(1, 3, 5),
                         [](const auto& instance) {
                           return std::to_string(instance.param) + "Attached";
                         });

}  // namespace network_trust_test
}  // namespace jnd::device
