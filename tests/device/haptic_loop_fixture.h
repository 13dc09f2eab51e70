#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "device/fault_injection.h"
#include "device/haptic_loop.h"
#include "scripted_device.h"

namespace jnd::device {

/// A loop with a scripted device, into which faults may be injected, and with everything that
/// the loop exchanges.
class HapticLoopTest : public ::testing::Test {
 protected:
  HapticLoopTest() { make_loop({}); }

  void make_loop(std::vector<ScheduledFault> faults, const HapticLoop::Parameters& with = {},
                 const core::Heartbeat* heartbeat = nullptr) {
    HapticLoop::Parameters parameters = with;
    parameters.starts_armed = starts_armed;
    faulty = std::make_unique<FaultInjectingDevice>(device, std::move(faults));
    loop = std::make_unique<HapticLoop>(
        parameters, *faulty,
        HapticLoop::Exchange{commands, published_telemetry, stop, &samples, heartbeat});
  }

  void command(const core::MediumAmounts& medium, double ramp_s = 0.0) {
    commands.publish({.sequence = ++sequence, .medium = medium, .ramp_s = ramp_s});
  }

  void run(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) loop->tick();
  }

  const core::Telemetry& telemetry() {
    published_telemetry.fetch();
    return published_telemetry.value();
  }

  /// Returns the largest force that the device has received at any point since `first_tick`.
  double max_received_n(std::size_t first_tick) const {
    double max = 0.0;
    for (std::size_t tick = first_tick; tick < device.received.size(); ++tick) {
      for (const Eigen::Vector3d& force : device.received[tick]) {
        EXPECT_TRUE(force.allFinite());
        max = std::max(max, force.norm());
      }
    }
    return max;
  }

  ScriptedDevice device;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> published_telemetry;
  core::EmergencyStop stop;
  core::SpscQueue<core::Sample> samples{8192};
  std::unique_ptr<FaultInjectingDevice> faulty;
  std::unique_ptr<HapticLoop> loop;
  std::uint64_t sequence = 0;
  bool starts_armed = true;  ///< This holds for loops that are made from now on.
};

}  // namespace jnd::device
