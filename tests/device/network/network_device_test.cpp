#include "device/network/network_device.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/error.h"
#include "device/fault_injection.h"
#include "device/lumped_hand_device.h"
#include "device/network/udp_port.h"
#include "network_fixture.h"
#include "support/allocation_counter.h"

namespace jnd::device {
namespace network_device_test {

using core::Fault;

class NetworkDeviceTest : public NetworkTest {
 protected:
  static std::string sentence(const std::function<void()>& act) {
    try {
      act();
    } catch (const core::Error& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(NetworkDeviceTest, WhatTheDeviceCanDoIsKnownBeforeItIsOpened) {
  scripted.device_capabilities = {.rate_hz = 1000.0,
                                  .max_force_per_point_n = 7.0,
                                  .max_total_force_n = 17.0,
                                  .simulated = true,
                                  .num_joints = 22,
                                  .tells_acting_force = true,
                                  .moves_by_itself = true};
  serve({});
  device = make_device();
  EXPECT_FALSE(device->capabilities().simulated) << "nobody in particular yet";
  EXPECT_EQ(device->simulated_hand(), nullptr);
  device->ask();
  const DeviceCapabilities can = device->capabilities();
  EXPECT_EQ(can.max_force_per_point_n, 7.0);
  EXPECT_EQ(can.max_total_force_n, 17.0);
  EXPECT_EQ(can.num_joints, 22);
  EXPECT_EQ(can.max_stale_s, 0.020);
  EXPECT_TRUE(can.simulated);
  EXPECT_TRUE(can.moves_by_itself);
  EXPECT_FALSE(can.takes_orders);
  EXPECT_EQ(device->simulated_hand(), nullptr) << "it strokes as it likes";
  EXPECT_EQ(device->name(), "network");
  EXPECT_EQ(device->served_name(), "scripted");
  EXPECT_FALSE(server->has_client()) << "asking is not connecting";
}

TEST_F(NetworkDeviceTest, WhatADeviceIsAndMeasuresComesAcross) {
  scripted.device_capabilities.share_ratio = {0.0, 0.0, 0.25, 0.75, 0.0};
  scripted.device_capabilities.channels = core::kMeasuredForce | core::kGripper;
  scripted.device_capabilities.max_slew_n_per_s = 700.0;
  scripted.device_capabilities.max_speed_m_per_s = 2.0;
  scripted.device_capabilities.workspace = {0.5, 0.4, 0.3};
  scripted.device_capabilities.own_mass_kg = 0.2;
  scripted.device_capabilities.closed_loop_delay_s = 0.003;
  scripted.device_capabilities.has_enable_switch = true;
  serve({});
  scripted.state.channels.bits = core::kMeasuredForce | core::kGripper;
  scripted.state.channels.force_n[3] = {1.0, -2.0, 1.0 / 3.0};
  scripted.state.channels.gripper_m = 0.04;
  device = make_device();
  device->open();
  const DeviceCapabilities can = device->capabilities();
  EXPECT_EQ(can.share_ratio, scripted.device_capabilities.share_ratio);
  EXPECT_EQ(can.channels, core::kMeasuredForce | core::kGripper);
  EXPECT_EQ(can.max_slew_n_per_s, 700.0);
  EXPECT_EQ(can.max_speed_m_per_s, 2.0);
  EXPECT_EQ(can.workspace.half_width_z_m, 0.3);
  EXPECT_EQ(can.own_mass_kg, 0.2);
  EXPECT_EQ(can.closed_loop_delay_s, 0.003);
  EXPECT_TRUE(can.has_enable_switch);
  EXPECT_EQ(device->identity().model, "scripted");
  network.pass(kMs);
  core::HapticState state;
  ASSERT_TRUE(device->read(state));
  EXPECT_EQ(state.channels.bits, can.channels);
  EXPECT_EQ(state.channels.force_n[3], scripted.state.channels.force_n[3]);
  EXPECT_EQ(state.channels.gripper_m, 0.04);
}

TEST_F(NetworkDeviceTest, MeasurementsAndForcesArriveToTheBit) {
  scripted.device_capabilities.num_joints = 22;
  serve({});
  for (int i = 0; i < core::kNumJoints; ++i) {
    scripted.state.joint_position_rad[i] = 0.1 * i;
    scripted.state.joint_torque_n_m[i] = -0.3 * i;
  }
  scripted.state.end_effector_position_m = {0.1, -0.2, 1.0 / 3.0};
  scripted.state.attached[2] = false;
  device = make_device();
  device->open();
  network.pass(kMs);
  core::HapticState state;
  ASSERT_TRUE(device->read(state));
  EXPECT_EQ(state.tip_position_m, scripted.state.tip_position_m);
  EXPECT_EQ(state.joint_position_rad, scripted.state.joint_position_rad);
  EXPECT_EQ(state.joint_torque_n_m, scripted.state.joint_torque_n_m);
  EXPECT_EQ(state.end_effector_position_m, scripted.state.end_effector_position_m);
  EXPECT_EQ(state.attached, scripted.state.attached);
  EXPECT_EQ(state.device_time_ns + kMs, scripted.state.device_time_ns);
  core::PointVectors force = core::zero_vectors();
  force[3] = {0.1, 0.2, -1.0 / 3.0};
  ASSERT_TRUE(device->write(force));
  network.pass(kMs);
  EXPECT_EQ(force_now(), force);
}

TEST_F(NetworkDeviceTest, NobodyAtTheOtherEndIsToldInOneSentence) {
  server = nullptr;
  const std::string said = sentence([this] { make_device()->ask(); });
  EXPECT_NE(said.find("expected a device to answer, found none"), std::string::npos) << said;
}

TEST_F(NetworkDeviceTest, ASecondProgramIsRefusedAndTheFirstFeelsNothing) {
  start();
  const auto second = make_device({}, kOtherProgram);
  second->ask();
  // Meanwhile the first loop goes on.
  const auto step = network.on_millisecond;
  network.on_millisecond = [this, step] {
    step();
    loop->tick();
  };
  const std::string said = sentence([&second] { second->open(); });
  network.on_millisecond = step;
  EXPECT_NE(said.find("another program uses it"), std::string::npos) << said;
  EXPECT_GT(server->counts().num_turned_away, 0);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
  device->close();
  run(1);
  EXPECT_EQ(total_now_n(), 0.0);
  EXPECT_NO_THROW(second->open());
}

TEST_F(NetworkDeviceTest, AnotherVersionIsNamedOnBothSides) {
  server = nullptr;
  Bytes refusal = encoded({{}, wire::Refusal{.reason = wire::RefusalReason::kOtherVersion}});
  refusal[4] = std::byte{wire::kVersion + 1};
  network.on_millisecond = [&] {
    network.post({.bytes = refusal, .from = kServer, .to = kProgram});
  };
  const std::string said = sentence([this] { make_device()->ask(); });
  EXPECT_NE(said.find("expected datagrams of version 3, found version 4"), std::string::npos)
      << said;

  serve({});
  network.on_millisecond = [this] { server->step(network.now_ns); };
  Bytes hello = encoded({{}, wire::Hello{}});
  hello[4] = std::byte{wire::kVersion + 1};
  network.post({.bytes = hello, .from = kOtherProgram, .to = kServer});
  run(1);
  std::array<std::byte, 2048> bytes;
  Address from;
  const std::size_t size = network.port(kOtherProgram)->receive(bytes, from);
  wire::Datagram answer;
  ASSERT_EQ(wire::decode(std::span(bytes).first(size), answer), wire::Problem::kNone);
  EXPECT_EQ(std::get<wire::Refusal>(answer.content).reason, wire::RefusalReason::kOtherVersion);
}

TEST_F(NetworkDeviceTest, ASlowerDeviceIsRefusedWithBothNumbers) {
  scripted.device_capabilities.rate_hz = 833.0;
  serve({});
  const std::string said = sentence([this] { make_device()->open(); });
  EXPECT_NE(said.find("expected a device at 1000 Hz or faster, found scripted at 833 Hz"),
            std::string::npos)
      << said;
}

TEST_F(NetworkDeviceTest, ABadConnectionIsNoneToBeginWith) {
  device = make_device();
  device->ask();
  int num_sent = 0;
  network.on_send = [&](const SimulatedNetwork::Sent& sent) {
    if (++num_sent % 5 != 0) network.post(sent);
  };
  const std::string said = sentence([this] { device->open(); });
  EXPECT_NE(said.find("expected a good connection, found"), std::string::npos) << said;
  EXPECT_EQ(max_total_since_n(0), 0.0);
}

TEST_F(NetworkDeviceTest, ADeviceThatDoesNotRepeatOurClockIsNamed) {
  device = make_device();
  device->ask();
  change_states([](wire::Header& header, wire::State&) { header.echo_ns = 0; });
  const std::string said = sentence([this] { device->open(); });
  EXPECT_NE(said.find("expected states that repeat the newest clock of our commands"),
            std::string::npos)
      << said;
  EXPECT_EQ(max_total_since_n(0), 0.0);
}

TEST_F(NetworkDeviceTest, ADeviceMayAskForPatience) {
  scripted.device_capabilities.simulated = true;
  serve({.watchdog_s = 0.050, .max_answer_age_s = 0.070});
  start();
  EXPECT_EQ(device->capabilities().max_stale_s, 0.050);
  for (const bool the_loop : {true, false}) {
    (the_loop ? loop_runs : server_runs) = false;
    run(45);
    EXPECT_EQ(total_now_n() > 0.5, true);
    loop_runs = server_runs = true;
    run(300);
    EXPECT_EQ(fault(), Fault::kNone);
    EXPECT_GT(total_now_n(), 0.5);
  }
  run(600);
  lose_next(20, kProgram);
  run(21);
  EXPECT_EQ(fault(), Fault::kLinkLost) << "patience is for what is late, not for what is lost";
  network.on_send = nullptr;
  run(600);
  loop->rearm();
  run(600);
  EXPECT_EQ(fault(), Fault::kNone);
  server_runs = false;
  run(51);
  EXPECT_EQ(fault(), Fault::kLinkLost);
}

TEST_F(NetworkDeviceTest, AMovingHandWhoseStatesAreMissingIsNotFrozen) {
  for (const double speed_m_per_s : {0.5, 0.7, 1.0}) {
    start();
    scripted.move_all({speed_m_per_s, 0.0, 0.0});
    run(50);
    lose_next(15, kProgram);
    run(30);
    EXPECT_NE(fault(), Fault::kPositionFrozen) << speed_m_per_s;
    network.on_send = nullptr;
  }
}

TEST_F(NetworkDeviceTest, TellsHowGoodItsLinkIs) {
  start();
  run(600);
  const LinkReport good = device->link().value();
  EXPECT_EQ(good.level, "excellent");
  EXPECT_TRUE(good.may_arm);
  EXPECT_EQ(good.lost_ratio, 0.0);
  EXPECT_GT(good.round_trip_s, 0.0);
  lose_every(25, kProgram);
  run(600);
  const LinkReport poor = device->link().value();
  EXPECT_EQ(poor.level, "poor");
  EXPECT_FALSE(poor.may_arm);
  EXPECT_TRUE(poor.may_give_force);
  EXPECT_NEAR(poor.lost_ratio, 0.02, 0.01) << "since the connection began";
}

TEST_F(NetworkDeviceTest, ARealDeviceGetsNoPatienceWhateverItAsksFor) {
  serve({.watchdog_s = 0.050, .max_answer_age_s = 0.070});
  start();
  EXPECT_EQ(device->capabilities().max_stale_s, 0.020);
  server_runs = false;
  run(22);
  EXPECT_EQ(fault(), Fault::kLinkLost);
}

TEST_F(NetworkDeviceTest, WhatADeviceSaysOfItselfIsNotBelievedUntold) {
  scripted.device_capabilities = {
      .simulated = true, .tells_acting_force = true, .moves_by_itself = true};
  serve({});
  device = make_device({.believes_simulated = false});
  device->ask();
  EXPECT_TRUE(device->says_simulated());
  EXPECT_FALSE(device->capabilities().simulated);
  EXPECT_EQ(device->capabilities().watchdog_timeout_s, 0.020);
  EXPECT_EQ(device->simulated_hand(), nullptr);
}

TEST_F(NetworkDeviceTest, WhereNobodyCanBeHurtTheWatchdogIsPatient) {
  device = make_device();
  device->ask();
  EXPECT_EQ(device->capabilities().watchdog_timeout_s, 0.020);
  scripted.device_capabilities.simulated = true;
  serve({});
  device->ask();
  EXPECT_EQ(device->capabilities().watchdog_timeout_s,
            LumpedHandDevice({}).capabilities().watchdog_timeout_s);
}

TEST_F(NetworkDeviceTest, SequenceNumbersMayWrapInMidFlight) {
  serve({.first_sequence = 0xffffff00u});
  start({.first_sequence = 0xfffffe80u});
  run(1500);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_GT(total_now_n(), 0.5);
  EXPECT_EQ(device->quality().counts().lost, 0);
  EXPECT_EQ(server->quality().counts().lost, 0);
  expect_safe_forces();
}

TEST_F(NetworkDeviceTest, AFaultOfTheServedDeviceComesThroughAndPassesWithIt) {
  for (const Injection injection :
       {Injection::kReadFailure, Injection::kNonFinitePosition, Injection::kWriteFailure}) {
    scripted.received.clear();
    FaultInjectingDevice faulty(
        scripted, {{.first_tick = 1000, .num_ticks = 30, .injection = injection}});
    served = &faulty;
    faulty.open();
    serve({});
    start();
    run(1100);
    const Fault expected = injection == Injection::kReadFailure ? Fault::kDeviceReadFailed
                           : injection == Injection::kNonFinitePosition
                               ? Fault::kNonFiniteState
                               : Fault::kDeviceWriteFailed;
    EXPECT_EQ(fault(), expected);
    EXPECT_EQ(total_now_n(), 0.0);
    run(500);
    loop->rearm();
    run(700);
    EXPECT_EQ(fault(), Fault::kNone);
    EXPECT_GT(total_now_n(), 0.5);
    expect_safe_forces();
    loop = nullptr;
    device = nullptr;
    server = nullptr;
    served = &scripted;
  }
}

TEST_F(NetworkDeviceTest, ALoopThatStartsLateIsNoFault) {
  device = make_device();
  device->open();
  loop = std::make_unique<HapticLoop>(
      HapticLoop::Parameters{.starts_armed = true}, *device,
      HapticLoop::Exchange{commands, published_telemetry, stop, nullptr, nullptr});
  loop_runs = false;
  run(60);
  loop_runs = true;
  run(500);
  EXPECT_EQ(fault(), Fault::kNone);
  EXPECT_TRUE(server->is_armed());
}

TEST_F(NetworkDeviceTest, ADisarmingAfterTheFirstForceIsToldHoweverEarly) {
  connect();
  run(10);
  ASSERT_GT(total_now_n(), 0.0);
  lose_next(21, kServer);
  run(25);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  const std::size_t disarmed = mark();
  run(600);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  EXPECT_EQ(max_total_since_n(disarmed), 0.0) << "nobody has armed";
}

TEST_F(NetworkDeviceTest, AForceForADeviceThatHasDisarmedIsAFault) {
  connect();
  loop_runs = false;
  run(60);
  loop_runs = true;
  const std::size_t first = mark();
  run(600);
  EXPECT_EQ(fault(), Fault::kLinkLost);
  EXPECT_EQ(max_total_since_n(first), 0.0);
}

TEST_F(NetworkDeviceTest, TheEmergencyStopReachesTheDeviceInOneTick) {
  start();
  stop.press();
  run(2);
  EXPECT_EQ(total_now_n(), 0.0);
}

/// Answers as a device does without using the heap, so that allocations can be counted.
class AnsweringPort final : public DatagramPort {
 public:
  bool send(std::span<const std::byte> datagram, const Address&) noexcept override {
    if (wire::decode(datagram, heard_) != wire::Problem::kNone) return true;
    if (const auto* hello = std::get_if<wire::Hello>(&heard_.content)) {
      answer_ = {.header = {.stream_id = hello->only_asks ? 0u : 5u},
                 .content = wire::Welcome{.token = hello->token}};
    } else if (const auto* command = std::get_if<wire::Command>(&heard_.content)) {
      answer_ = {
          .header = {.stream_id = 5, .sequence = ++sequence_, .echo_ns = heard_.header.sent_ns},
          .content = wire::State{
              .armed_number = command->arm_number, .armed = true, .is_measured = true}};
    } else {
      return true;
    }
    size_ = wire::encode(answer_, answer_bytes_);
    return true;
  }
  std::size_t receive(std::span<std::byte> bytes, Address& from) noexcept override {
    const std::size_t size = std::exchange(size_, 0);
    std::copy_n(answer_bytes_.begin(), size, bytes.begin());
    from = address_number(1);
    return size;
  }
  std::int64_t now_ns() const noexcept override { return now_ns_; }
  void pause(std::int64_t duration_ns) noexcept override { now_ns_ += duration_ns; }

 private:
  wire::Datagram heard_, answer_;
  std::array<std::byte, wire::kMaxBytes> answer_bytes_{};
  std::size_t size_ = 0;
  std::uint32_t sequence_ = 0;
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST(NetworkDevice, NeitherReadingNorWritingAllocates) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  auto port = std::make_unique<AnsweringPort>();
  AnsweringPort& clock = *port;
  NetworkDevice device(std::move(port), address_number(1), {});
  device.open();
  core::HapticState state;
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 1000; ++i) {
    clock.pause(kMs);
    ASSERT_TRUE(device.read(state));
    ASSERT_TRUE(device.write(core::zero_vectors()));
  }
  clock.pause(500 * kMs);
  for (int i = 0; i < 300; ++i) {
    clock.pause(kMs);
    (void)device.read(state);
    (void)device.write(core::zero_vectors());
  }
  device.halt();
  EXPECT_EQ(counter.allocations(), 0u);
  EXPECT_EQ(counter.frees(), 0u);
}

TEST(DeviceServer, ASteppingServerDoesNotAllocate) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  LumpedHandDevice lumped({});
  AnsweringPort port;
  DeviceServer server(lumped, port, {});
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 1000; ++i) server.step(i * kMs);
  EXPECT_EQ(counter.allocations(), 0u);
}

TEST(NetworkDevice, ParametersOutOfRangeAreRefused) {
  for (const NetworkDevice::Parameters& parameters :
       {NetworkDevice::Parameters{.rate_hz = 0.0},
        NetworkDevice::Parameters{.max_stale_s = NAN},
        NetworkDevice::Parameters{.patience_s = -1.0}}) {
    EXPECT_THROW(NetworkDevice(std::make_unique<AnsweringPort>(), {}, parameters), core::Error);
  }
  LumpedHandDevice lumped({});
  AnsweringPort port;
  for (const DeviceServer::Parameters& parameters :
       {DeviceServer::Parameters{.watchdog_s = 0.0},
        DeviceServer::Parameters{.max_answer_age_s = NAN},
        DeviceServer::Parameters{.client_timeout_s = INFINITY},
        DeviceServer::Parameters{.slew_n_per_s = -1.0}}) {
    EXPECT_THROW(DeviceServer(lumped, port, parameters), core::Error);
  }
}

}  // namespace network_device_test
}  // namespace jnd::device
