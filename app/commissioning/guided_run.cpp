#include "app/commissioning/guided_run.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <thread>

#include "app/command_line/stop_signals.h"
#include "core/error.h"
#include "core/exchange/latest_value.h"
#include "core/exchange/spsc_queue.h"
#include "core/exchange/telemetry.h"
#include "core/safety/heartbeat.h"
#include "core/safety/watchdog_state.h"
#include "device/haptic_loop.h"
#include "device/watched_loop.h"

namespace jnd::app {
namespace {

constexpr std::size_t kSampleCapacity = 32768;
/// The energy against 2 N of friction over half a metre, and no more: a device that runs away
/// is stopped.
constexpr double kMaxGiven_j = 1.0;

device::HapticLoop::Parameters loop_parameters(const GuidedRun::Parameters& parameters,
                                               const device::DeviceCapabilities& can,
                                               device::Guide& guide) {
  device::HapticLoop::Parameters loop;
  loop.starts_armed = can.simulated;
  loop.rate_hz = parameters.rate_hz;
  loop.limits = parameters.limits;
  loop.port_energy.max_given_j = kMaxGiven_j;
  loop.heartbeat_timeout_s = can.heartbeat_timeout_s;
  loop.guide = &guide;
  loop.oscillation.swing_n = parameters.swing_n;
  return loop;
}

}  // namespace

struct GuidedRun::Implementation {
  Implementation(device::HapticDevice& the_device, const Parameters& the_parameters)
      : parameters(the_parameters),
        device(the_device),
        in_real_time(!device.capabilities().simulated || device.capabilities().has_own_clock),
        stop(parameters.emergency_stop != nullptr ? *parameters.emergency_stop : own_stop),
        guide(device.capabilities().share_ratio),
        loop(loop_parameters(parameters, device.capabilities(), guide), device,
             {commands, telemetry, stop, &samples, in_real_time ? &heartbeat : nullptr,
              in_real_time ? &watched : nullptr}) {
    if (in_real_time) {
      running.emplace(
          device, loop, watched,
          device::WatchedLoop::Parameters{.allow_no_realtime = parameters.allow_no_realtime});
    } else {
      device.open();
      is_open = true;
    }
  }
  ~Implementation() { end(); }

  void end() noexcept {
    if (running) running->stop();
    if (is_open) device.close();
    is_open = false;
  }

  [[nodiscard]] core::Fault fault() {
    telemetry.fetch();
    if (watched.has_bitten()) return core::Fault::kWatchdog;
    return telemetry.value().fault;
  }

  /// Gives a sign of life, unless a window that should watch gives none. Only one thread calls
  /// it at a time.
  void beat() noexcept {
    if (parameters.watcher != nullptr) {
      const std::uint64_t count = parameters.watcher->count();
      if (count == last_watched) return;
      last_watched = count;
    }
    heartbeat.beat();
  }

  /// The beat comes only from whoever waits here, so that the force fades if the program hangs.
  /// A fault ends it, except within the first `patience_s`, in which only the emergency stop
  /// does.
  core::Fault run(double duration_s, const std::function<void(const core::Sample&)>& take,
                  double patience_s = 0.0) {
    const auto num_ticks = std::llround(duration_s * parameters.rate_hz);
    std::int64_t num_taken = 0;
    const auto visit = [&](const core::Sample& sample) {
      if (num_taken++ < num_ticks && take) take(sample);
    };
    if (!in_real_time) {
      constexpr std::int64_t kBatch = 256;
      for (std::int64_t done = 0; done < num_ticks; ++done) {
        loop.tick();
        if (done % kBatch == kBatch - 1) samples.drain(visit);
        if (done % kBatch == 0 && stop_requested()) stop.press();
      }
      samples.drain(visit);
      return fault();
    }
    // Drops samples from before.
    samples.drain([](const core::Sample&) {});
    const auto patience =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
    while (num_taken < num_ticks) {
      beat();
      if (stop_requested() && !stop.is_pressed()) stop.press();
      samples.drain(visit);
      const core::Fault found = fault();
      const bool waits =
          found != core::Fault::kEmergencyStop && std::chrono::steady_clock::now() < patience;
      if (core::is_failure(found) && !waits) return found;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return fault();
  }

  Parameters parameters;
  device::HapticDevice& device;
  bool in_real_time;
  bool is_open = false;
  core::LatestValue<core::HapticCommand> commands;
  std::uint64_t num_commands = 0;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop own_stop;
  core::EmergencyStop& stop;
  core::Heartbeat heartbeat;
  std::uint64_t last_watched = 0;
  core::WatchdogState watched;
  core::SpscQueue<core::Sample> samples{kSampleCapacity};
  device::MotionGuide guide;
  device::MotionGuide::Order ordered;
  device::HapticLoop loop;
  std::optional<device::WatchedLoop> running;
};

GuidedRun::GuidedRun(device::HapticDevice& device, const Parameters& parameters)
    : implementation_(std::make_unique<Implementation>(device, parameters)) {}

GuidedRun::~GuidedRun() = default;

void GuidedRun::arm(const std::function<void(const core::Sample&)>& take) {
  Implementation& my = *implementation_;
  if (my.fault() == core::Fault::kNone && my.telemetry.value().num_ticks > 0) return;
  constexpr int kAttempts = 50;
  constexpr double kAttempt_s = 0.1;
  core::Fault found = core::Fault::kNone;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    my.loop.rearm(my.telemetry.value().num_faults);
    // What was latched before stays until the loop's next tick.
    found = my.run(kAttempt_s, take, kAttempt_s);
    if (found == core::Fault::kNone) {
      (void)my.run(1.0, take);
      return;
    }
    if (found != core::Fault::kNotArmed && found != core::Fault::kLinkLost) break;
  }
  throw core::Error("device: expected to be armed, found: " + std::string(core::words(found)));
}

void GuidedRun::while_asking(const std::function<void()>& act) {
  Implementation& my = *implementation_;
  // A thread that waits for a person cannot beat, nor see that the program has to stop.
  const std::jthread beating([&my](const std::stop_token& ends) {
    while (!ends.stop_requested()) {
      my.beat();
      if (stop_requested() && !my.stop.is_pressed()) my.stop.press();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  act();
}

void GuidedRun::without_force(const std::function<void()>& act) {
  implementation_->loop.disarm();
  (void)implementation_->run(0.02, {});
  while_asking(act);
}

void GuidedRun::disarm() noexcept { implementation_->loop.disarm(); }

void GuidedRun::order(const device::MotionGuide::Order& order) {
  implementation_->ordered = order;
  implementation_->guide.order(order);
}

const device::MotionGuide::Order& GuidedRun::ordered() const noexcept {
  return implementation_->ordered;
}

void GuidedRun::render(const core::MediumAmounts& medium, double surface_z_m) {
  core::HapticCommand command{.sequence = ++implementation_->num_commands, .medium = medium};
  command.immersion.origin_z_m = surface_z_m;
  implementation_->commands.publish(command);
}

core::Fault GuidedRun::try_for(double duration_s,
                               const std::function<void(const core::Sample&)>& take) {
  const core::Fault found = implementation_->run(duration_s, take);
  if (stop_requested()) throw core::Error("commission: stopped; what was measured is kept");
  return found;
}

void GuidedRun::run_for(double duration_s,
                        const std::function<void(const core::Sample&)>& take) {
  const core::Fault found = try_for(duration_s, take);
  if (core::is_failure(found)) {
    throw core::Error("commission: " + std::string(core::words(found)));
  }
}

const core::Sample& GuidedRun::look() {
  constexpr double kLook_s = 0.02, kPatience_s = 0.1;
  const core::Fault found = implementation_->run(kLook_s, {}, kPatience_s);
  if (stop_requested()) throw core::Error("commission: stopped; what was measured is kept");
  if (found == core::Fault::kEmergencyStop) {
    throw core::Error("commission: " + std::string(core::words(found)));
  }
  return telemetry().sample;
}

const core::Telemetry& GuidedRun::telemetry() {
  (void)implementation_->telemetry.fetch();
  return implementation_->telemetry.value();
}

void GuidedRun::stop() noexcept { implementation_->end(); }

}  // namespace jnd::app
