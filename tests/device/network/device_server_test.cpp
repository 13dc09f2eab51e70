#include "device/network/device_server.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "device/fault_injection.h"
#include "device/lumped_hand_device.h"
#include "device/scripted_device.h"
#include "simulated_network.h"

namespace jnd::device {
namespace {

using core::Fault;
constexpr std::int64_t kMs = 1'000'000;

/// A program that does as the test says, whatever the rules are.
class Program {
 public:
  Program(SimulatedNetwork& network, const Address& own, const Address& server)
      : port_(network.port(own)), server_(server) {}

  void send(const wire::Content& content) { send(content, ++sequence); }
  void send(const wire::Content& content, std::uint32_t with_sequence) {
    const Bytes bytes =
        encoded({{.stream_id = stream_id, .sequence = with_sequence, .sent_ns = 5}, content});
    (void)port_->send(bytes, server_);
  }
  void command(double force_n, std::uint32_t arm_number = 1) {
    send(with_force(force_n, arm_number));
  }
  [[nodiscard]] wire::Command with_force(double force_n, std::uint32_t arm_number = 1) const {
    wire::Command command{.arm_number = arm_number, .answered_sequence = answered};
    command.force_on_hand_n[0].x() = force_n;
    return command;
  }

  /// Takes in what has come; answers to the newest state unless told otherwise.
  void take_in() {
    std::array<std::byte, wire::kMaxBytes> bytes;
    Address from;
    for (std::size_t size; (size = port_->receive(bytes, from)) > 0;) {
      wire::Datagram datagram;
      ASSERT_EQ(wire::decode(std::span(bytes).first(size), datagram), wire::Problem::kNone);
      if (const auto* welcome = std::get_if<wire::Welcome>(&datagram.content)) {
        welcomed = *welcome;
        stream_id = datagram.header.stream_id;
      } else if (const auto* told = std::get_if<wire::State>(&datagram.content)) {
        state = *told;
        if (answers) answered = datagram.header.sequence;
      } else if (const auto* refused = std::get_if<wire::Refusal>(&datagram.content)) {
        refusal = refused->reason;
      } else if (std::holds_alternative<wire::Goodbye>(datagram.content)) {
        ++num_goodbyes;
      }
    }
  }

  std::uint64_t stream_id = 0;
  std::uint32_t sequence = 0;
  std::uint32_t answered = 0;
  bool answers = true;
  wire::State state;
  std::optional<wire::Welcome> welcomed;
  std::optional<wire::RefusalReason> refusal;
  int num_goodbyes = 0;

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
  /// So many good ticks with this force.
  void talk(int num_ticks, double force_n, std::uint32_t arm_number = 1) {
    for (int i = 0; i < num_ticks; ++i) {
      program.command(force_n, arm_number);
      step();
    }
  }
  void connect() {
    program.send(wire::Hello{.token = 77});
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
  program.send(wire::Hello{.token = 1});
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

TEST_F(DeviceServerTest, NobodyElseGetsAWordIn) {
  arm();
  talk(5, 1.0);
  Program other(network, address_number(3), kServer);
  other.sequence = 100'000;
  for (const std::uint64_t stream_id : {std::uint64_t{0}, program.stream_id}) {
    other.stream_id = stream_id;
    other.command(-2.0);
    other.send(wire::Halt{});
    other.send(wire::Goodbye{});
    talk(1, 1.0);
    other.take_in();
    EXPECT_EQ(felt_n(), 1.0);
    EXPECT_EQ(other.refusal, wire::RefusalReason::kUnknownStream);
  }
  const std::uint64_t stream_id = std::exchange(program.stream_id, 999);
  program.command(-2.0);
  program.send(wire::Halt{});
  step();
  EXPECT_EQ(program.refusal, wire::RefusalReason::kUnknownStream);
  EXPECT_EQ(felt_n(), 1.0) << "of a stream that was";
  program.stream_id = stream_id;
  other.stream_id = 0;
  other.send(wire::Hello{.token = 5});
  talk(1, 1.0);
  other.take_in();
  EXPECT_EQ(other.refusal, wire::RefusalReason::kBusy);
}

TEST_F(DeviceServerTest, OnlyAskingOpensNothing) {
  program.send(wire::Hello{.token = 5, .only_asks = true});
  step();
  ASSERT_TRUE(program.welcomed);
  EXPECT_EQ(program.stream_id, 0u);
  EXPECT_FALSE(server.has_client());
}

TEST_F(DeviceServerTest, ALostWelcomeIsSaidAgain) {
  connect();
  const std::uint64_t stream_id = program.stream_id;
  program.welcomed.reset();
  program.send(wire::Hello{.token = 77});
  step();
  EXPECT_TRUE(program.welcomed);
  EXPECT_EQ(program.stream_id, stream_id);
  EXPECT_EQ(server.counts().num_clients, 1);
}

TEST_F(DeviceServerTest, AProgramThatSaysHelloAnewIsDisarmed) {
  arm();
  talk(5, 1.0);
  program.send(wire::Hello{.token = 78});
  step();
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(program.state.armed_number, 0u);
  EXPECT_EQ(server.counts().num_clients, 2);
}

TEST_F(DeviceServerTest, ASilentProgramMakesRoomForAnother) {
  arm();
  talk(5, 1.0);
  for (int i = 0; i < 999; ++i) step();
  EXPECT_TRUE(server.has_client());
  step();
  EXPECT_FALSE(server.has_client());
}

TEST_F(DeviceServerTest, GoodbyeEndsIt) {
  arm();
  talk(5, 1.0);
  server.dismiss(network.now_ns);
  program.take_in();
  EXPECT_EQ(felt_n(), 0.0);
  EXPECT_EQ(program.num_goodbyes, 2);
  EXPECT_FALSE(server.has_client());
}

TEST_F(DeviceServerTest, AFloodCostsNoStep) {
  arm();
  for (int i = 0; i < 5000; ++i) {
    network.post({.bytes = Bytes(100), .from = address_number(9), .to = kServer});
  }
  talk(40, 0.0);
  EXPECT_GE(server.quality().counts().refused, 5000);
}

TEST_F(DeviceServerTest, ADeviceWithoutASimulatedHandTakesNoOrders) {
  arm();
  program.send(wire::Order{.number = 1, .movement_number = 1, .stroke = true});
  talk(2, 0.0);
  EXPECT_EQ(program.state.order_number, 0u);
}

TEST_F(DeviceServerTest, AnOrderCountsOnceAndAnOlderOneNotAtAll) {
  LumpedHandDevice lumped({});
  lumped.open();
  DeviceServer served(lumped, *port, {});
  const auto step_served = [&] {
    network.now_ns += kMs;
    served.step(network.now_ns);
    program.take_in();
  };
  program.send(wire::Hello{.token = 1});
  step_served();
  program.send(wire::Order{.number = 2, .movement_number = 2, .stroke = true});
  step_served();
  EXPECT_EQ(program.state.order_number, 2u);
  EXPECT_FALSE(program.state.is_home);
  program.send(wire::Order{.number = 1, .movement_number = 1});
  program.send(wire::Order{.number = 2, .movement_number = 2});
  for (int i = 0; i < 900; ++i) step_served();
  EXPECT_EQ(program.state.order_number, 2u);
  EXPECT_FALSE(program.state.is_home) << "it was not sent home";
}

TEST_F(DeviceServerTest, PuttingFingersBackDoesNotDisturbTheMovement) {
  class Hand final : public SimulatedHand {
   public:
    void begin_strokes(const StrokePlan&, const core::RandomStream&) override { ++num_strokes; }
    void go_home() noexcept override { ++num_home; }
    [[nodiscard]] std::int64_t strokes_finished() const noexcept override { return 3; }
    [[nodiscard]] bool is_home() const noexcept override { return false; }
    void put_fingers_back() noexcept override { ++num_put_back; }
    int num_strokes = 0, num_home = 0, num_put_back = 0;
  };
  class Handed final : public HapticDevice {
   public:
    [[nodiscard]] std::string_view name() const noexcept override { return "handed"; }
    [[nodiscard]] DeviceCapabilities capabilities() const noexcept override { return {}; }
    void open() override {}
    [[nodiscard]] bool read(core::HapticState&) noexcept override { return true; }
    [[nodiscard]] bool write(const core::PointVectors&) noexcept override { return true; }
    void close() noexcept override {}
    [[nodiscard]] SimulatedHand* simulated_hand() noexcept override { return &hand; }
    Hand hand;
  };
  Handed handed;
  DeviceServer served(handed, *port, {});
  const auto give = [&](const wire::Order& order) {
    program.send(order);
    network.now_ns += kMs;
    served.step(network.now_ns);
    program.take_in();
  };
  program.send(wire::Hello{.token = 1});
  give({.number = 1, .movement_number = 1, .stroke = true});
  give({.number = 2, .movement_number = 1, .num_put_back = 1, .stroke = true});
  EXPECT_EQ(program.state.order_number, 2u);
  EXPECT_EQ(program.state.strokes_finished, 3);
  EXPECT_EQ(handed.hand.num_strokes, 1);
  EXPECT_EQ(handed.hand.num_put_back, 1);
  give({.number = 5, .movement_number = 4, .num_put_back = 2});
  EXPECT_EQ(handed.hand.num_home, 1);
  EXPECT_EQ(handed.hand.num_put_back, 2);
}

}  // namespace
}  // namespace jnd::device
