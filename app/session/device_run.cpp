#include "app/session/device_run.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "app/command_line/stop_signals.h"
#include "core/exchange/latest_value.h"
#include "core/exchange/spsc_queue.h"
#include "core/safety/heartbeat.h"
#include "core/safety/watchdog_state.h"
#include "device/haptic_loop.h"
#include "device/watched_loop.h"

namespace jnd::app {
namespace {

/// As large as a session's: half a minute at 1 kHz.
constexpr std::size_t kSampleCapacity = 32768;
constexpr std::chrono::milliseconds kBetweenBeats(20);

}  // namespace

struct DeviceRun::Implementation {
  Implementation(device::HapticDevice& device, const Parameters& parameters)
      : stop(parameters.emergency_stop != nullptr ? *parameters.emergency_stop : own_stop),
        loop({.starts_armed = device.capabilities().simulated,
              .rate_hz = parameters.rate_hz,
              .heartbeat_timeout_s = device.capabilities().heartbeat_timeout_s},
             device, {commands, telemetry, stop, &samples, &heartbeat, &watched}),
        beating([this](const std::stop_token& ends) { beat_until(ends); }),
        running(device, loop, watched,
                {.allow_no_realtime = parameters.allow_no_realtime, .cpu = parameters.cpu}) {}

  void beat_until(const std::stop_token& ends) {
    while (!ends.stop_requested()) {
      heartbeat.beat();
      if (stop_requested() && !stop.is_pressed()) stop.press();
      std::this_thread::sleep_for(kBetweenBeats);
    }
  }

  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop own_stop;
  core::EmergencyStop& stop;
  core::Heartbeat heartbeat;
  core::WatchdogState watched;
  core::SpscQueue<core::Sample> samples{kSampleCapacity};
  core::HapticCommand command;
  device::HapticLoop loop;
  std::jthread beating;  ///< Ends after the device is closed.
  device::WatchedLoop running;
};

DeviceRun::DeviceRun(device::HapticDevice& device, const Parameters& parameters)
    : implementation_(std::make_unique<Implementation>(device, parameters)) {}

DeviceRun::~DeviceRun() = default;

void DeviceRun::render(const core::MediumAmounts& medium) {
  Implementation& my = *implementation_;
  ++my.command.sequence;
  my.command.medium = medium;
  my.commands.publish(my.command);
}

void DeviceRun::take(const std::function<void(const core::Sample&)>& sample) {
  implementation_->samples.drain(sample);
}

const core::Telemetry& DeviceRun::telemetry() noexcept {
  implementation_->telemetry.fetch();
  return implementation_->telemetry.value();
}

void DeviceRun::stop() noexcept { implementation_->running.stop(); }

const device::RealtimeThread& DeviceRun::thread() const noexcept {
  return implementation_->running.thread();
}

std::uint64_t DeviceRun::num_dropped_samples() const noexcept {
  return implementation_->samples.num_dropped();
}

}  // namespace jnd::app
