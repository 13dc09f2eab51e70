#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>

#include "device/network/device_server.h"
#include "device/scripted_device.h"
#include "simulated_network.h"

namespace jnd::device {

/// A program that does what the test says, whatever the rules are.
class Program {
 public:
  Program(SimulatedNetwork& network, const Address& own, const Address& server)
      : port_(network.port(own)), server_(server) {}

  void send(const wire::Content& content) { send(content, ++sequence); }
  void send(const wire::Content& content, std::uint32_t with_sequence) {
    const std::int64_t echo_ns = echoes && heard_ns != 0 ? heard_ns - late_ns : 0;
    const wire::Header header{
        .stream_id = stream_id, .sequence = with_sequence, .sent_ns = 5, .echo_ns = echo_ns};
    (void)port_->send(encoded({header, content}), server_);
  }
  /// Sends a hello with the challenge of the last welcome, as the rules want it.
  void hello(std::uint64_t token) { send(wire::Hello{.token = token, .challenge = challenge}); }
  void command(double force_n, std::uint32_t arm_number = 1) {
    send(with_force(force_n, arm_number));
  }
  [[nodiscard]] wire::Command with_force(double force_n, std::uint32_t arm_number = 1) const {
    wire::Command command{.arm_number = arm_number, .answered_sequence = answered};
    command.force_on_hand_n[0].x() = force_n;
    return command;
  }

  /// Takes in what has come. Answers to the newest state unless the test says otherwise.
  void take_in() {
    std::array<std::byte, wire::kMaxBytes> bytes;
    Address from;
    for (std::size_t size; (size = port_->receive(bytes, from)) > 0;) {
      wire::Datagram datagram;
      ASSERT_EQ(wire::decode(std::span(bytes).first(size), datagram), wire::Problem::kNone);
      if (const auto* welcome = std::get_if<wire::Welcome>(&datagram.content)) {
        welcomed = *welcome;
        challenge = welcome->challenge;
        ++num_welcomes;
        stream_id = datagram.header.stream_id;
      } else if (const auto* told = std::get_if<wire::State>(&datagram.content)) {
        state = *told;
        heard_ns = datagram.header.sent_ns;
        num_lost += static_cast<int>(datagram.header.sequence -
                                     std::exchange(last_sequence, datagram.header.sequence)) -
                    1;
        if (answers) answered = datagram.header.sequence;
      } else if (const auto* refused = std::get_if<wire::Refusal>(&datagram.content)) {
        refusal = refused->reason;
        ++num_refusals;
      } else if (std::holds_alternative<wire::Goodbye>(datagram.content)) {
        ++num_goodbyes;
      }
    }
  }

  std::uint64_t stream_id = 0;
  std::uint64_t challenge = 0;
  std::uint32_t sequence = 0;
  std::uint32_t answered = 0;
  bool answers = true;
  bool echoes = true;
  std::int64_t heard_ns = 0;  ///< The server's time of the newest state.
  std::int64_t late_ns = 0;   ///< The program says that it heard the state this much earlier.
  std::uint32_t last_sequence = 0;
  int num_lost = 0;  ///< The number of states that were lost, by their numbers.
  wire::State state;
  std::optional<wire::Welcome> welcomed;
  std::optional<wire::RefusalReason> refusal;
  int num_welcomes = 0, num_refusals = 0, num_goodbyes = 0;

 private:
  std::unique_ptr<DatagramPort> port_;
  Address server_;
};

class DeviceServerTest : public ::testing::Test {
 protected:
  void step() {
    network.now_ns += kMs;
    server.step(network.now_ns);
    program.take_in();
  }
  /// Runs this many good ticks with this force.
  void talk(int num_ticks, double force_n, std::uint32_t arm_number = 1) {
    for (int i = 0; i < num_ticks; ++i) {
      program.command(force_n, arm_number);
      step();
    }
  }
  void connect() {
    program.hello(77);
    step();
    ASSERT_TRUE(program.welcomed);
    EXPECT_EQ(program.welcomed->token, 77u);
    ASSERT_NE(program.stream_id, 0u);
  }
  void arm() {
    connect();
    talk(200, 0.0);
    ASSERT_TRUE(program.state.armed);
    ASSERT_EQ(program.state.armed_number, 1u);
  }
  [[nodiscard]] double felt_n() const { return device.received.back()[0].x(); }

  static inline const Address kServer = address_number(1);
  SimulatedNetwork network;
  ScriptedDevice device;
  std::unique_ptr<DatagramPort> port = network.port(kServer);
  DeviceServer server{device, *port, {.first_stream_id = 41}};
  Program program{network, address_number(2), kServer};
};

}  // namespace jnd::device
