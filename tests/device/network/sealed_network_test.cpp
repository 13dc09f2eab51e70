// Tests what a stranger on the network can do to a device and a program that share a key.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "device/network/datagram_seal.h"
#include "device_server_fixture.h"
#include "network_fault_fixture.h"
#include "support/allocation_counter.h"

namespace jnd::device {
namespace sealed_network_test {

using core::Fault;
using Side = DatagramSeal::Side;

DeviceKey key_number(int number) {
  DeviceKey key{};
  key[7] = static_cast<std::byte>(number);
  return key;
}

Bytes sealed_by(DatagramSeal& seal, const wire::Datagram& datagram) {
  std::array<std::byte, DatagramSeal::kMostBytes> bytes;
  const std::size_t size = seal.write(datagram, bytes);
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}

TEST(DatagramSeal, OneBitAnywhereBreaksIt) {
  DatagramSeal program(Side::kProgram, key_number(1)), device(Side::kDevice, key_number(1));
  program.begin_stream(5, 6);
  device.begin_stream(5, 6);
  wire::Datagram back;
  for (const wire::Content& content :
       {wire::Content(wire::Hello{.token = 3}), wire::Content(wire::Command{})}) {
    const Bytes bytes = sealed_by(program, {{}, content});
    EXPECT_EQ(device.read(bytes, back), wire::Problem::kNone);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      Bytes broken = bytes;
      broken[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
      EXPECT_NE(device.read(broken, back), wire::Problem::kNone) << bit;
    }
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_NE(device.read(std::span(bytes).first(size), back), wire::Problem::kNone) << size;
    }
  }
}

TEST(DatagramSeal, IsOfOneKeyOneStreamAndOneDirection) {
  DatagramSeal program(Side::kProgram, key_number(1)), device(Side::kDevice, key_number(1));
  program.begin_stream(5, 6);
  device.begin_stream(5, 6);
  const Bytes goodbye = sealed_by(program, {{}, wire::Goodbye{}});
  const Bytes hello = sealed_by(program, {{}, wire::Hello{}});
  wire::Datagram back;
  ASSERT_EQ(device.read(goodbye, back), wire::Problem::kNone);
  EXPECT_EQ(program.read(goodbye, back), wire::Problem::kOtherKey) << "one's own word";
  device.begin_stream(5, 7);
  EXPECT_EQ(device.read(goodbye, back), wire::Problem::kOtherKey) << "of another stream";
  device.begin_stream(4, 6);
  EXPECT_EQ(device.read(goodbye, back), wire::Problem::kOtherKey) << "of another program";
  EXPECT_EQ(device.read(hello, back), wire::Problem::kNone) << "of no stream yet";
  DatagramSeal other(Side::kDevice, key_number(2)), open(Side::kDevice, std::nullopt);
  EXPECT_EQ(other.read(hello, back), wire::Problem::kOtherKey);
  EXPECT_EQ(open.read(hello, back), wire::Problem::kOtherKey);
  EXPECT_EQ(device.read(encoded({{}, wire::Hello{}}), back), wire::Problem::kOtherKey);
}

TEST(DatagramSeal, TakesNoMemory) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  DatagramSeal program(Side::kProgram, key_number(1)), device(Side::kDevice, key_number(1));
  std::array<std::byte, DatagramSeal::kMostBytes> bytes;
  const wire::Datagram state{{}, wire::State{}};
  wire::Datagram back;
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 100; ++i) {
    program.begin_stream(5, 6);
    device.begin_stream(5, 6);
    const std::size_t size = device.write(state, bytes);
    ASSERT_EQ(program.read(std::span(bytes).first(size), back), wire::Problem::kNone);
  }
  EXPECT_EQ(counter.allocations(), 0u);
  EXPECT_EQ(counter.frees(), 0u);
}

class SealedNetworkTest : public NetworkTest {
 protected:
  SealedNetworkTest() {
    key = key_number(1);
    serve({});
  }
  static std::string why_not(const std::function<void()>& act) {
    try {
      act();
    } catch (const core::Error& error) {
      return error.what();
    }
    return "no error";
  }
  void expect_undisturbed(const char* by) {
    EXPECT_EQ(fault(), Fault::kNone) << by;
    EXPECT_GT(total_now_n(), 0.5) << by;
    EXPECT_EQ(server->counts().num_armings, 1) << by;
    EXPECT_EQ(server->counts().num_disarmings, 0) << by;
  }
};

TEST_F(SealedNetworkTest, CarriesForceAndTheStop) {
  start();
  EXPECT_GT(total_now_n(), 0.5);
  device->halt();
  run(2);
  EXPECT_EQ(total_now_n(), 0.0);
  EXPECT_EQ(server->counts().last_fault, Fault::kWatchdog) << "the halt was understood";
}

TEST_F(SealedNetworkTest, WhoeverLacksTheKeyIsToldSo) {
  key.reset();
  EXPECT_NE(why_not([this] { make_device()->ask(); }).find("found one that has one"),
            std::string::npos);
  EXPECT_NE(why_not([this] {
              make_device({.key = key_number(2)})->ask();
            }).find("expected a device with the same key"),
            std::string::npos);
  serve({});
  EXPECT_NE(why_not([this] {
              make_device({.key = key_number(2)})->ask();
            }).find("expected a device with the same key"),
            std::string::npos);
}

TEST_F(SealedNetworkTest, NobodyWithoutTheKeyGetsAWordIn) {
  Program stranger(network, kOtherProgram, kServer);
  for (int i = 0; i < 300; ++i) {
    stranger.hello(9);
    stranger.send(wire::Hello{.token = 9, .only_asks = true});
    stranger.command(i < 200 ? 0.0 : 1.0);
    run(1);
    stranger.take_in();
  }
  EXPECT_FALSE(server->has_client());
  EXPECT_EQ(stranger.num_welcomes, 0);
  EXPECT_EQ(stranger.refusal, wire::RefusalReason::kOtherKey);
  EXPECT_EQ(server->counts().num_armings, 0);
  EXPECT_EQ(max_total_since_n(0), 0.0);
}

TEST_F(SealedNetworkTest, AConversationThatIsPlayedAgainDoesNothing) {
  std::vector<SimulatedNetwork::Sent> heard;
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    if (sent.to == kServer) heard.push_back(sent);
    network.post(sent);
  };
  start();
  ASSERT_GT(total_now_n(), 0.5);
  loop = nullptr;
  device = nullptr;
  run(2);
  network.on_send = nullptr;
  const std::size_t over = mark();
  for (const Address& from : {kProgram, kOtherProgram}) {
    for (SimulatedNetwork::Sent sent : heard) {
      sent.from = from;
      network.post(sent);
      run(1);
    }
    EXPECT_FALSE(server->has_client());
  }
  EXPECT_EQ(server->counts().num_armings, 1);
  EXPECT_EQ(max_total_since_n(over), 0.0);
}

/// Somebody at the cable repeats everything, from every address and to every address.
TEST_F(SealedNetworkTest, WhatIsSaidAgainDuringASessionEndsNothing) {
  std::vector<SimulatedNetwork::Sent> heard;
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    network.post(sent);
    if (heard.size() < 20'000) heard.push_back(sent);
  };
  start();
  ASSERT_GT(total_now_n(), 0.5);
  const std::vector<SimulatedNetwork::Sent> said = heard;
  for (std::size_t i = 0; i < said.size(); ++i) {
    for (const Address& from : {kServer, kProgram, kOtherProgram}) {
      for (const Address& to : {kServer, kProgram}) {
        if (from == to) continue;
        SimulatedNetwork::Sent again = said[i];
        again.from = from;
        again.to = to;
        network.post(again);
      }
    }
    run(1);
    if (i % 50 == 0) expect_undisturbed("what was said before");
  }
  expect_undisturbed("what was said before");
}

/// After a fault, both sides judge the link again. What was sent before must not count as new.
TEST_F(SealedNetworkTest, OldStatesDoNotHoldUpTheWayBackFromAFault) {
  std::vector<SimulatedNetwork::Sent> said;
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    network.post(sent);
    if (sent.to == kProgram && said.size() < 300) said.push_back(sent);
  };
  start();
  run(200);
  const auto run_among_old_ones = [&](int num_ms) {
    for (int i = 0; i < num_ms; ++i) {
      network.post(said[100 + static_cast<std::size_t>(i) % 200]);
      run(1);
    }
  };
  scripted.state.enabled = false;
  run_among_old_ones(20);
  scripted.state.enabled = true;
  EXPECT_EQ(fault(), Fault::kNotEnabled);
  run_among_old_ones(700);
  loop->rearm();
  run_among_old_ones(800);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
}

TEST_F(SealedNetworkTest, AHelloThatWasRefusedIsWorthNothingLater) {
  start();
  SimulatedNetwork::Sent kept;
  DatagramSeal seal(Side::kDevice, key);
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    network.post(sent);
    wire::Datagram said;
    if (!(sent.from == kOtherProgram)) return;
    if (seal.read(sent.bytes, said) != wire::Problem::kNone) return;
    const auto* hello = std::get_if<wire::Hello>(&said.content);
    if (hello != nullptr && !hello->only_asks) kept = sent;
  };
  const auto second = make_device({.patience_s = 0.2}, kOtherProgram);
  second->ask();
  EXPECT_NE(why_not([&] { second->open(); }).find("another program uses it"),
            std::string::npos);
  network.on_send = nullptr;
  run(600);
  loop->rearm();
  run(700);
  ASSERT_EQ(fault(), Fault::kNone);
  ASSERT_FALSE(kept.bytes.empty());
  kept.from = kProgram;
  network.post(kept);
  run(100);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
}

TEST_F(SealedNetworkTest, OldHellosDoNotKeepOthersOut) {
  std::vector<SimulatedNetwork::Sent> hellos;
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    network.post(sent);
    if (sent.to == kServer && hellos.size() < 2) hellos.push_back(sent);
  };
  start();
  loop = nullptr;
  device = nullptr;
  run(1100);
  network.on_send = nullptr;
  network.on_millisecond = [this, old = hellos.back()] {
    SimulatedNetwork::Sent again = old;
    again.from = kOtherProgram;
    network.post(again);
    server->step(network.now_ns);
  };
  EXPECT_EQ(why_not([this] {
              const auto next = make_device();
              next->ask();
              next->open();
            }),
            "no error");
}

/// The stranger passes on to the program whatever the device answers to the stranger.
TEST_F(SealedNetworkTest, NoAnswerToAStrangerServesAgainstTheProgram) {
  start();
  int num_answers = 0;
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    network.post(sent);
    SimulatedNetwork::Sent bent = sent;
    if (sent.to == kServer && sent.from == kProgram) {
      bent.from = kOtherProgram;
      network.post(bent);
    } else if (sent.to == kOtherProgram) {
      ++num_answers;
      bent.to = kProgram;
      network.post(bent);
    }
  };
  run(500);
  EXPECT_EQ(num_answers, 0);
  expect_undisturbed("its own words from elsewhere");
}

TEST_F(SealedNetworkTest, WhatWasChangedOnItsWayIsLostAndNoFault) {
  start();
  int num = 0;
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    SimulatedNetwork::Sent changed = sent;
    if (++num % 60 == 0) changed.bytes[60] ^= std::byte{1};
    network.post(changed);
  };
  run(500);
  expect_undisturbed("a bit in sixty datagrams");
  EXPECT_GT(device->quality().counts().refused + server->quality().counts().refused, 10);
}

TEST_F(SealedNetworkTest, ADeviceThatWasRestartedIsFoundAgain) {
  start();
  serve({});
  run(700);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  EXPECT_EQ(total_now_n(), 0.0);
  loop->rearm();
  run(700);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
}

}  // namespace sealed_network_test
}  // namespace jnd::device
