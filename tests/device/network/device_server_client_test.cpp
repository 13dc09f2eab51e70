#include <gtest/gtest.h>

#include <utility>

#include "device/exoskeleton/exoskeleton_device.h"
#include "device/lumped_hand_device.h"
#include "device_server_fixture.h"

namespace jnd::device {
namespace device_server_client_test {

using core::Fault;

TEST_F(DeviceServerTest, ARealDeviceThatDoesNotTellItsForceIsNotServed) {
  ScriptedDevice silent;
  silent.device_capabilities = {.simulated = false};
  const auto port_of_its_own = network.port(address_number(7));
  EXPECT_THROW(DeviceServer(silent, *port_of_its_own, {}), core::Error);
  silent.device_capabilities = {.simulated = true};
  EXPECT_NO_THROW(DeviceServer(silent, *port_of_its_own, {}));
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
  other.hello(5);
  talk(1, 1.0);
  other.take_in();
  EXPECT_EQ(other.refusal, wire::RefusalReason::kBusy);
}

TEST_F(DeviceServerTest, AnswersToStrangersCostNoStateAndAreFew) {
  arm();
  talk(5, 1.0);
  Program other(network, address_number(3), kServer);
  for (int i = 0; i < 10; ++i) {
    const int num_answers = other.num_welcomes + other.num_refusals;
    other.stream_id = program.stream_id;
    for (int k = 0; k < 20; ++k) {
      other.command(1.0);
      other.hello(5);
      other.send(wire::Hello{.token = 6, .only_asks = true});
    }
    talk(1, 1.0);
    other.take_in();
    EXPECT_EQ(other.num_welcomes + other.num_refusals - num_answers, 8 + 1)
        << "eight welcomes and a refusal a step";
  }
  EXPECT_EQ(program.num_lost, 0) << "they have no numbers of this stream";
  EXPECT_EQ(felt_n(), 1.0);
  program.hello(77);
  talk(5, 1.0);
  EXPECT_EQ(program.num_lost, 0);
  EXPECT_EQ(felt_n(), 1.0);
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
  program.hello(77);
  step();
  EXPECT_TRUE(program.welcomed);
  EXPECT_EQ(program.stream_id, stream_id);
  EXPECT_EQ(server.counts().num_clients, 1);
}

TEST_F(DeviceServerTest, AProgramThatSaysHelloAnewIsDisarmed) {
  arm();
  talk(5, 1.0);
  program.hello(78);
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
  talk(5, 1.0);
  for (int i = 0; i < 5120; ++i) {
    network.post({.bytes = Bytes(100), .from = address_number(9), .to = kServer});
  }
  for (int i = 1; i <= 20; ++i) {
    talk(1, 1.0);
    EXPECT_EQ(server.quality().counts().refused, 256 * i) << "no more are taken in a step";
  }
  EXPECT_EQ(felt_n(), 0.0) << "behind it all, the commands are too late";
  EXPECT_EQ(program.state.fault, Fault::kLinkLost);
  talk(200, 0.0, 2);
  talk(1, 1.0, 2);
  EXPECT_EQ(felt_n(), 1.0) << "once it is over";
}

TEST_F(DeviceServerTest, AProgramFindsTheDeviceAsItWasAtTheStart) {
  ExoskeletonDevice robot({});
  DeviceServer served(robot, *port, {});
  const auto step_served = [&](Program& with) {
    network.now_ns += kMs;
    served.step(network.now_ns);
    served.renew_device();
    with.take_in();
  };
  program.hello(1);
  step_served(program);
  program.send(wire::Order{.number = 1, .movement_number = 1, .stroke = true});
  for (int i = 0; i < 300; ++i) {
    program.command(0.0);
    step_served(program);
  }
  robot.detach(3);
  step_served(program);
  EXPECT_FALSE(program.state.measured.attached[3]);
  const std::int64_t num_ticks = program.state.contact_sums.num_ticks;
  EXPECT_GT(num_ticks, 290);

  program.hello(2);
  step_served(program);
  EXPECT_FALSE(program.state.measured.attached[3]) << "the same session goes on";
  EXPECT_GT(program.state.contact_sums.num_ticks, num_ticks);

  // The next program is so quick that the device has not been put in order yet.
  Program next(network, address_number(3), kServer);
  next.challenge = program.challenge;
  program.send(wire::Goodbye{});
  next.hello(3);
  step_served(next);
  ASSERT_TRUE(next.welcomed);
  step_served(next);
  EXPECT_TRUE(next.state.measured.attached[3]);
  EXPECT_LE(next.state.contact_sums.num_ticks, 2);
  const std::int64_t device_time_ns = next.state.measured.device_time_ns;
  for (int i = 0; i < 100; ++i) step_served(next);
  EXPECT_EQ(next.state.measured.device_time_ns, device_time_ns + 100 * kMs) << "only once";
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
  program.hello(1);
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
    [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
      return {.simulated = true};
    }
    void open() override {}
    [[nodiscard]] bool read(core::HapticState&) noexcept override { return true; }
    [[nodiscard]] bool write(const core::PointVectors&) noexcept override { return true; }
    void close() noexcept override {}
    void halt() noexcept override {}
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
  program.hello(1);
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

}  // namespace device_server_client_test
}  // namespace jnd::device
