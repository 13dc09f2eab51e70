#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/random_stream.h"
#include "device/fault_injection.h"
#include "network_fault_fixture.h"

namespace jnd::device {
namespace network_fault_test {

using core::Fault;
using Sent = SimulatedNetwork::Sent;

TEST_P(NetworkFaultTest, UpToNineteenLostCommandsAreBridgedByTheLastOne) {
  for (const int num_lost : {1, 5, 19}) {
    lose_next(num_lost, kServer);
    const std::size_t first = mark();
    run(300);
    for (std::size_t i = first; i < first + 40; ++i) {
      double total = 0.0;
      for (const Eigen::Vector3d& force : scripted.received[i]) total += force.norm();
      EXPECT_GT(total, 0.5) << num_lost << " " << i - first;
    }
    EXPECT_EQ(fault(), Fault::kNone) << num_lost;
    network.on_send = nullptr;
    run(600);
  }
}

TEST_P(NetworkFaultTest, TwentyLostCommandsEndTheForceUntilItIsArmedAgain) {
  lose_next(20, kServer);
  const std::size_t first = mark();
  run(21);
  EXPECT_EQ(total_now_n(), 0.0);
  EXPECT_GT(max_total_since_n(first + 19), 0.5) << "and not one step before";
  expect_force_comes_back_when_armed();
}

TEST_P(NetworkFaultTest, UpToNineteenLostStatesAreBridgedByTheLastOne) {
  for (const int num_lost : {1, 5, 19}) {
    lose_next(num_lost, kProgram);
    run(300);
    EXPECT_EQ(fault(), Fault::kNone) << num_lost;
    EXPECT_GT(total_now_n(), 0.5) << num_lost;
    network.on_send = nullptr;
    run(600);
  }
}

TEST_P(NetworkFaultTest, TwentyLostStatesEndTheForceUntilItIsArmedAgain) {
  lose_next(20, kProgram);
  run(21);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  EXPECT_EQ(total_now_n(), 0.0);
  expect_force_comes_back_when_armed();
}

TEST_P(NetworkFaultTest, ACutCableEndsTheForceAndMendedItComesBackWhenArmed) {
  for (const int num_ms : {30, 150, 500, 3000}) {
    network.on_send = [](const Sent&) {};
    run(21);
    const std::size_t cut = mark();
    run(num_ms);
    EXPECT_EQ(max_total_since_n(cut), 0.0);
    network.on_send = nullptr;
    expect_force_comes_back_when_armed();
  }
}

TEST_P(NetworkFaultTest, DoubledAndReorderedDatagramsChangeNothingButTheCounts) {
  int num_sent = 0;
  network.on_send = [this, &num_sent](const Sent& sent) {
    Sent later = sent;
    // States and commands come by turns.
    const int turn = num_sent++ / 2;
    later.arrives_ns += (turn % 3) * kMs;
    if (turn % 2 == 0) network.post(sent);
    network.post(later);
  };
  run(1000);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
  EXPECT_GT(device->quality().counts().doubled, 100);
  EXPECT_GT(device->quality().counts().reordered, 50);
  EXPECT_EQ(device->quality().counts().lost, 0);
}

TEST_P(NetworkFaultTest, AForceOfLongAgoIsNotTakenForANewOne) {
  std::vector<Sent> old;
  network.on_send = [&](const Sent& sent) {
    if (sent.to == kServer && old.size() < 50) old.push_back(sent);
    network.post(sent);
  };
  run(100);
  loop_runs = false;
  run(30);
  ASSERT_EQ(total_now_n(), 0.0);
  network.on_send = nullptr;
  const std::size_t replayed = mark();
  for (int round = 0; round < 20; ++round) {
    for (const Sent& sent : old) network.post(sent);
    run(5);
  }
  EXPECT_EQ(max_total_since_n(replayed), 0.0);
}

TEST_P(NetworkFaultTest, CutCorruptAndForeignDatagramsAreAsGoodAsLost) {
  for (const int fault_kind : {0, 1, 2}) {
    int num_spoilt = 0;
    network.on_send = [&](const Sent& sent) {
      Sent spoilt = sent;
      if (++num_spoilt % 20 == 0) {
        if (fault_kind == 0) spoilt.bytes.resize(spoilt.bytes.size() / 2);
        if (fault_kind == 1) spoilt.bytes[60 % spoilt.bytes.size()] ^= std::byte{16};
        if (fault_kind == 2) spoilt.bytes[4] = std::byte{wire::kVersion + 1};
      }
      network.post(spoilt);
    };
    const std::int64_t refused = server->quality().counts().refused;
    run(150);
    EXPECT_EQ(fault(), Fault::kNone) << fault_kind;
    EXPECT_GT(total_now_n(), 0.5) << fault_kind;
    EXPECT_GT(server->quality().counts().refused, refused) << fault_kind;
    network.on_send = nullptr;
    run(700);
  }
}

TEST_P(NetworkFaultTest, NothingButSpoiltDatagramsEndsTheForce) {
  for (const int fault_kind : {0, 1, 2}) {
    network.on_send = [&](const Sent& sent) {
      Sent spoilt = sent;
      if (fault_kind == 0) spoilt.bytes.resize(spoilt.bytes.size() / 2);
      if (fault_kind == 1) spoilt.bytes[60 % spoilt.bytes.size()] ^= std::byte{16};
      if (fault_kind == 2) spoilt.bytes[4] = std::byte{wire::kVersion + 1};
      network.post(spoilt);
    };
    run(21);
    EXPECT_EQ(total_now_n(), 0.0);
    network.on_send = nullptr;
    expect_force_comes_back_when_armed();
  }
}

TEST_P(NetworkFaultTest, ABadConnectionEndsTheForceAndIsNotArmed) {
  for (const Address& to : {kServer, kProgram}) {
    lose_every(4, to);
    run(700);
    EXPECT_EQ(fault(), Fault::kLinkLost);
    // Each side has a guard of its own: the device knows nothing of lost states until our loop
    // halts it.
    EXPECT_EQ(server->counts().last_fault, to == kServer ? Fault::kLinkLost : Fault::kWatchdog);
    const std::size_t lost = mark();
    arm_loop();
    run(1000);
    EXPECT_EQ(max_total_since_n(lost), 0.0);
    EXPECT_EQ(fault(), Fault::kLinkLost);
    network.on_send = nullptr;
    expect_force_comes_back_when_armed();
  }
}

TEST_P(NetworkFaultTest, WhatOthersSendIsNotTakenForTheDevices) {
  wire::Datagram forged;
  network.on_send = [&](const Sent& sent) {
    network.post(sent);
    if (!(sent.to == kProgram)) return;
    ASSERT_EQ(wire::decode(sent.bytes, forged), wire::Problem::kNone);
    auto& state = std::get<wire::State>(forged.content);
    state.measured.tip_position_m[0].x() += 1.0;
    state.armed = false;
    forged.header.sequence += 3;
    Sent of_another = sent;
    of_another.bytes = encoded(forged);
    of_another.from = kOtherProgram;
    network.post(of_another);
    forged.header.stream_id += 1;
    Sent of_another_stream = sent;
    of_another_stream.bytes = encoded(forged);
    network.post(of_another_stream);
    forged.content = wire::Goodbye{};
    of_another_stream.bytes = encoded(forged);
    network.post(of_another_stream);
  };
  run(100);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
}

TEST_P(NetworkFaultTest, AProgramThatDiesLeavesNoForceBehind) {
  loop_runs = false;
  run(21);
  EXPECT_EQ(total_now_n(), 0.0);
  EXPECT_FALSE(server->is_armed());
  run(1000);
  EXPECT_FALSE(server->has_client()) << "another may come";
}

TEST_P(NetworkFaultTest, AStalledProgramFindsOutBeforeItGivesForceAgain) {
  for (const int num_ms : {2, 10}) {
    loop_runs = false;
    run(num_ms);
    loop_runs = true;
    run(100);
    EXPECT_EQ(fault(), Fault::kNone) << num_ms;
    EXPECT_GT(total_now_n(), 0.5) << num_ms;
  }
  for (const int num_ms : {50, 1000, 3000}) {
    loop_runs = false;
    run(num_ms);
    EXPECT_EQ(total_now_n(), 0.0) << num_ms;
    loop_runs = true;
    const std::size_t awake = mark();
    run(100);
    EXPECT_EQ(max_total_since_n(awake), 0.0) << num_ms;
    expect_force_comes_back_when_armed();
  }
}

TEST_P(NetworkFaultTest, ADeviceThatWasRestartedIsNoJumpAndNeedsArming) {
  server = nullptr;
  run(50);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  for (Eigen::Vector3d& tip : scripted.state.tip_position_m) tip += Eigen::Vector3d(0.2, 0, 0);
  scripted.state.device_time_ns = 0;
  serve({});
  const std::size_t restarted = mark();
  run(600);
  EXPECT_EQ(max_total_since_n(restarted), 0.0);
  expect_force_comes_back_when_armed();
}

TEST_P(NetworkFaultTest, ADeviceRestartedWithinATickIsNoticed) {
  serve({});
  run(5);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  EXPECT_EQ(total_now_n(), 0.0);
  expect_force_comes_back_when_armed();
}

TEST_P(NetworkFaultTest, AnotherDeviceAtTheSamePlaceIsNotTakenForTheOldOne) {
  scripted.device_capabilities.max_force_per_point_n = 3.0;
  serve({});
  run(1000);
  arm_loop();
  run(100);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  EXPECT_EQ(total_now_n(), 0.0);
}

TEST_P(NetworkFaultTest, AHaltTakesTheForceAtOnceAndLatches) {
  device->halt();
  network.pass(kMs);
  EXPECT_EQ(total_now_n(), 0.0);
  run(3);
  EXPECT_EQ(fault(), Fault::kWatchdog);
  run(300);
  EXPECT_EQ(total_now_n(), 0.0);
  arm_loop();
  run(700);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
}

TEST_P(NetworkFaultTest, AForceThatIsNoNumberIsNeverSent) {
  loop_runs = false;
  core::HapticState state;
  for (const double poison : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    core::PointVectors force = core::zero_vectors();
    force[0].y() = poison;
    (void)device->read(state);
    EXPECT_FALSE(device->write(force));
    EXPECT_EQ(device->fault(), Fault::kNonFiniteForce);
    run(2);
    EXPECT_EQ(total_now_n(), 0.0);
  }
}

TEST_P(NetworkFaultTest, WhateverTheNetworkDoesTheForceStaysSafe) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    core::RandomStream random(seed, "network");
    const double harm = random.uniform(0.0, 0.2);
    network.on_send = [&](const Sent& sent) {
      Sent changed = sent;
      if (random.with_probability(harm)) return;
      if (random.with_probability(harm)) {
        changed.arrives_ns += static_cast<std::int64_t>(random.below(30)) * kMs;
      }
      if (random.with_probability(harm)) network.post(changed);
      if (random.with_probability(harm)) {
        changed.bytes[random.below(changed.bytes.size())] ^=
            static_cast<std::byte>(random.below(256));
      }
      if (random.with_probability(harm)) {
        changed.bytes.resize(random.below(changed.bytes.size() + 1));
      }
      if (!changed.bytes.empty()) network.post(changed);
    };
    for (int round = 0; round < 6; ++round) {
      run(static_cast<int>(random.below(500)));
      loop_runs = random.with_probability(0.8);
      run(static_cast<int>(random.below(60)));
      loop_runs = true;
      if (random.with_probability(0.2)) serve({});
      arm_loop();
    }
    network.on_send = nullptr;
    run(1500);
    arm_loop();
    run(700);
    EXPECT_EQ(fault(), Fault::kNone) << seed;
    EXPECT_GT(total_now_n(), 0.5) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Points, NetworkFaultTest, ::testing::Values(1, 3, 5),
                         [](const auto& instance) {
                           return std::to_string(instance.param) + "Attached";
                         });

}  // namespace network_fault_test
}  // namespace jnd::device
