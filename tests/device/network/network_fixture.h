#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/media/medium.h"
#include "device/haptic_loop.h"
#include "device/network/device_server.h"
#include "device/network/network_device.h"
#include "device/scripted_device.h"
#include "simulated_network.h"

namespace jnd::device {

/// A loop on one side of a network and a device on the other, both at 1 kHz in the network's
/// own time. The hand strokes through a thick fluid, so that there is always a force to lose.
class NetworkTest : public ::testing::Test {
 protected:
  NetworkTest() {
    network.on_millisecond = [this] {
      if (server != nullptr && server_runs) server->step(network.now_ns);
    };
    serve({});
  }
  /// The device still says goodbye, but `on_send` of a test refers to objects of the test that
  /// are gone.
  ~NetworkTest() override { network.on_send = nullptr; }

  void serve(DeviceServer::Parameters parameters) {
    server = nullptr;
    parameters.first_stream_id = next_stream_id += 1000;
    parameters.first_challenge = next_stream_id;
    if (!parameters.key) parameters.key = key;
    server_port = network.port(kServer);
    server = std::make_unique<DeviceServer>(*served, *server_port, parameters);
  }

  std::unique_ptr<NetworkDevice> make_device(NetworkDevice::Parameters parameters = {},
                                             const Address& own = kProgram) {
    parameters.token = next_token += 1000;
    if (!parameters.key) parameters.key = key;
    return std::make_unique<NetworkDevice>(network.port(own), kServer, parameters);
  }

  /// Connects, arms and waits until there is force.
  void start(const NetworkDevice::Parameters& parameters = {}) {
    connect(parameters);
    run(200);
  }

  /// Connects and arms, so that the loop can run.
  void connect(const NetworkDevice::Parameters& parameters = {}) {
    device = make_device(parameters);
    device->ask();
    device->open();
    loop = std::make_unique<HapticLoop>(
        HapticLoop::Parameters{.starts_armed = true}, *device,
        HapticLoop::Exchange{commands, published_telemetry, stop, nullptr, nullptr});
    commands.publish({.sequence = 1,
                      .medium = core::viscous({.viscosity_pa_s = 8.0}),
                      .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                      .ramp_s = 0.0});
  }

  /// Loses the next `num` datagrams to this address.
  void lose_next(int num, const Address& to) {
    network.on_send = [this, num, to](const SimulatedNetwork::Sent& sent) mutable {
      if (sent.to == to && num > 0) {
        --num;
      } else {
        network.post(sent);
      }
    };
  }

  /// Loses every `nth` datagram to this address.
  void lose_every(int nth, const Address& to) {
    network.on_send = [this, nth, to, num = 0](const SimulatedNetwork::Sent& sent) mutable {
      if (!(sent.to == to) || ++num % nth != 0) network.post(sent);
    };
  }

  /// Plays a controller of somebody else's: `change` changes the states that our server sends.
  void change_states(std::function<void(wire::Header&, wire::State&)> change) {
    network.on_send = [this, change = std::move(change)](const SimulatedNetwork::Sent& sent) {
      wire::Datagram datagram;
      SimulatedNetwork::Sent changed = sent;
      if (sent.to == kProgram && wire::decode(sent.bytes, datagram) == wire::Problem::kNone) {
        if (auto* state = std::get_if<wire::State>(&datagram.content)) {
          change(datagram.header, *state);
          changed.bytes = encoded(datagram);
        }
      }
      network.post(changed);
    };
  }

  void press_and_release_stop() {
    stop.press();
    run(50);
    EXPECT_EQ(total_now_n(), 0.0);
    EXPECT_TRUE(stop.release(stop.num_presses()));
    run(510);  // No sooner may anybody arm, see `core::kArmAfterRelease_s`.
  }
  /// As somebody who has seen all that is latched.
  void arm_loop() {
    published_telemetry.fetch();
    loop->rearm(published_telemetry.value().num_faults);
  }

  /// Runs this many ticks of both sides, except of a side that the test has stopped.
  void run(int num_ms) {
    for (int i = 0; i < num_ms; ++i) {
      if (num_run++ % 500 == 0) {
        scripted.move_all({num_run / 500 % 2 == 0 ? 0.3 : -0.3, 0.0, 0.0});
      }
      network.pass(kMs);
      if (loop_runs && loop != nullptr) loop->tick();
    }
  }

  void attach_first(int num_points) {
    for (int i = 0; i < core::kNumContactPoints; ++i)
      scripted.state.attached[i] = i < num_points;
  }

  [[nodiscard]] core::Fault fault() {
    published_telemetry.fetch();
    return published_telemetry.value().fault;
  }

  [[nodiscard]] const core::PointVectors& force_now() const { return scripted.received.back(); }
  [[nodiscard]] double total_now_n() const {
    double total = 0.0;
    for (const Eigen::Vector3d& force : force_now()) total += force.norm();
    return total;
  }
  [[nodiscard]] std::size_t mark() const { return scripted.received.size(); }
  [[nodiscard]] double max_total_since_n(std::size_t first) const {
    double max = 0.0;
    for (std::size_t i = first; i < scripted.received.size(); ++i) {
      double total = 0.0;
      for (const Eigen::Vector3d& force : scripted.received[i]) total += force.norm();
      max = std::max(max, total);
    }
    return max;
  }

  /// Expects that each force was safe whatever happened: it was a number, within the limits,
  /// zero at a point that is off the hand, and grew no faster than the slew allows.
  void expect_safe_forces(std::size_t first = 0) const {
    constexpr double kMaxStep_n = 2000.0 * 1e-3;
    core::PointVectors last = core::zero_vectors();
    for (std::size_t i = first; i < scripted.received.size(); ++i) {
      double total = 0.0;
      for (int point = 0; point < core::kNumContactPoints; ++point) {
        const Eigen::Vector3d& force = scripted.received[i][point];
        ASSERT_TRUE(force.allFinite()) << i;
        ASSERT_LE(force.norm(), 10.0 + 1e-9) << i;
        total += force.norm();
        if (!scripted.state.attached[point]) {
          ASSERT_EQ(force.norm(), 0.0) << i;
        }
        const bool fell_to_zero = force.norm() == 0.0;
        if (i > first && !fell_to_zero) {
          ASSERT_LE((force - last[point]).norm(), kMaxStep_n + 1e-9) << i << " " << point;
        }
        last[point] = force;
      }
      ASSERT_LE(total, 30.0 + 1e-9) << i;
    }
  }

  static inline const Address kServer = address_number(1);
  static inline const Address kProgram = address_number(2);
  static inline const Address kOtherProgram = address_number(3);

  SimulatedNetwork network;
  ScriptedDevice scripted;
  HapticDevice* served = &scripted;
  std::unique_ptr<DatagramPort> server_port;
  std::unique_ptr<DeviceServer> server;
  std::unique_ptr<NetworkDevice> device;

  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> published_telemetry;
  core::EmergencyStop stop;
  std::unique_ptr<HapticLoop> loop;
  /// The key of both sides, from the next `serve` and `make_device` on.
  std::optional<DeviceKey> key;
  bool loop_runs = true, server_runs = true;
  int num_run = 0;
  std::uint64_t next_stream_id = 0;
  std::uint64_t next_token = 0;
};

}  // namespace jnd::device
