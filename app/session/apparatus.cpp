#include "app/session/apparatus.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "app/command_line/stop_signals.h"
#include "app/profile/profile_choice.h"
#include "app/session/device_checks.h"
#include "app/session/movement_meter.h"
#include "app/session/sleep_inhibitor.h"
#include "core/error.h"
#include "core/exchange/latest_value.h"
#include "core/exchange/spsc_queue.h"
#include "core/safety/fault.h"
#include "core/storage/recording.h"
#include "device/exoskeleton/exoskeleton_device.h"
#include "device/exoskeleton/exoskeleton_options.h"
#include "device/fault_injection.h"
#include "device/haptic_loop.h"
#include "device/lumped_hand_device.h"
#include "device/mouse_device.h"
#include "device/profiled_device.h"
#include "device/registry/device_registry.h"
#include "device/simulated_hand.h"
#include "device/watched_loop.h"

namespace jnd::app {
namespace {

// Both are powers of two. In real time at 1 kHz, the queue holds more than half a minute while
// storage is held up. In simulated time, samples are taken after each batch, while they are
// still in the cache.
constexpr std::size_t kRealtimeQueueCapacity = 32768;
constexpr std::size_t kSimulatedQueueCapacity = 256;

constexpr std::string_view kLumped = "lumped";
constexpr std::string_view kExoskeleton = "exoskeleton";
constexpr std::string_view kMouse = "mouse";

device::StrokingArm::Parameters arm_parameters(const Apparatus::Parameters& parameters,
                                               const experiments::Laboratory& laboratory) {
  return {.stiffness_n_per_m = laboratory.arm.stiffness_n_per_m,
          .damping_n_s_per_m = laboratory.arm.damping_n_s_per_m,
          .home_z_m = parameters.home_height_m,
          .home_s = laboratory.arm.home_s};
}

device::LumpedHandDevice::Parameters lumped_parameters(
    const Apparatus::Parameters& parameters, const experiments::Laboratory& laboratory) {
  device::LumpedHandDevice::Parameters device;
  device.rate_hz = parameters.rate_hz;
  device.mass_kg = laboratory.device.mass_kg;
  device.mechanical_viscosity_n_s_per_m = laboratory.device.mechanical_viscosity_n_s_per_m;
  device.dry_friction_n = laboratory.device.dry_friction_n;
  device.max_force_per_point_n = laboratory.device.max_force_per_point_n;
  device.max_total_force_n = laboratory.device.max_total_force_n;
  device.arm = arm_parameters(parameters, laboratory);
  return device;
}

std::unique_ptr<device::HapticDevice> make_device(const Apparatus::Parameters& parameters,
                                                  const experiments::Laboratory* laboratory) {
  if (parameters.device == kLumped && laboratory != nullptr) {
    return std::make_unique<device::LumpedHandDevice>(
        lumped_parameters(parameters, *laboratory));
  }
  if (device::kind_of(parameters.device) == kExoskeleton && laboratory != nullptr) {
    device::ExoskeletonDevice::Parameters exoskeleton =
        device::exoskeleton_parameters(device::argument_of(parameters.device));
    exoskeleton.rate_hz = parameters.rate_hz;
    exoskeleton.arm = arm_parameters(parameters, *laboratory);
    return std::make_unique<device::ExoskeletonDevice>(exoskeleton);
  }
  if (parameters.device == kMouse) {
    return std::make_unique<device::MouseDevice>(
        device::MouseDevice::Parameters{.rate_hz = parameters.rate_hz,
                                        .height_m = parameters.home_height_m},
        parameters.exchange != nullptr ? &parameters.exchange->pointer : nullptr);
  }
  return device::make_device(parameters.device, parameters.rate_hz);
}

device::HapticLoop::Parameters loop_parameters(const Apparatus::Parameters& parameters,
                                               const experiments::Laboratory* laboratory,
                                               const device::DeviceCapabilities& device) {
  device::HapticLoop::Parameters loop;
  loop.starts_armed = device.simulated;
  loop.shadows_guards = parameters.shadow_guards;
  loop.heartbeat_timeout_s = device.heartbeat_timeout_s;
  loop.session_timeout_s = std::max(loop.session_timeout_s, device.heartbeat_timeout_s);
  loop.force_map = parameters.force_map.get();
  loop.rate_hz = parameters.rate_hz;
  loop.first_tick = parameters.first_tick;
  if (laboratory != nullptr) {
    // A laboratory may lower the loop's limits but never raise them.
    loop.limits.per_point_n =
        std::min(loop.limits.per_point_n, laboratory->device.max_force_per_point_n);
    loop.limits.total_n = std::min(loop.limits.total_n, laboratory->device.max_total_force_n);
    loop.limits.slew_n_per_s =
        std::min(loop.limits.slew_n_per_s, laboratory->device.max_slew_n_per_s);
  }
  return loop;
}

/// The device as it was measured; nullptr if there is no profile. Throws `core::Error` if the
/// device needs one.
std::unique_ptr<device::HapticDevice> as_measured(device::HapticDevice& bare,
                                                  const Apparatus::Parameters& parameters) {
  if (parameters.profile != nullptr) {
    return std::make_unique<device::ProfiledDevice>(
        bare, device_parameters(parameters.profile->profile));
  }
  if (!parameters.wants_profile || bare.capabilities().simulated) return nullptr;
  throw core::Error(parameters.device +
                    ": expected a profile of the device, as of every real one that is to give "
                    "force, found none; measure it with `jnd commission`");
}

/// The device with injected faults; nullptr if there are none.
std::unique_ptr<device::HapticDevice> with_faults(
    device::HapticDevice& sound, const std::vector<device::ScheduledFault>& faults) {
  if (faults.empty()) return nullptr;
  return std::make_unique<device::FaultInjectingDevice>(sound, faults);
}

}  // namespace

struct Apparatus::Implementation {
  Implementation(Parameters the_parameters, const experiments::Laboratory* laboratory)
      : parameters(std::move(the_parameters)),
        exchange(parameters.exchange != nullptr ? *parameters.exchange : own_exchange),
        bare_device(make_device(parameters, laboratory)),
        measured_device(as_measured(*bare_device, parameters)),
        faulty_device(with_faults(measured_device ? *measured_device : *bare_device,
                                  parameters.injected_faults)),
        device(faulty_device     ? faulty_device.get()
               : measured_device ? measured_device.get()
                                 : bare_device.get()),
        simulated_hand(device->simulated_hand()),
        samples(parameters.realtime ? kRealtimeQueueCapacity : kSimulatedQueueCapacity),
        max_total_force_n(std::min(
            loop_parameters(parameters, laboratory, device->capabilities()).limits.total_n,
            device->capabilities().max_total_force_n)),
        loop(loop_parameters(parameters, laboratory, device->capabilities()), *device,
             {.commands = commands,
              .telemetry = telemetry,
              .emergency_stop = exchange.emergency_stop,
              .samples = &samples,
              .heartbeat = parameters.realtime ? &exchange.heartbeat : nullptr,
              .watchdog = parameters.realtime ? &watchdog_state : nullptr,
              .session = parameters.realtime && parameters.exchange != nullptr
                             ? &session_heartbeat
                             : nullptr}) {
    if (parameters.recording) {
      recording.emplace(*parameters.recording, parameters.rate_hz, parameters.durability);
    }
    simulated_clock.advance_ns(parameters.first_time_ns);
    consumer = {.recording = recording ? &*recording : nullptr,
                .visit = [this](const core::Sample& sample) {
                  if (metering) feed_meter(sample);
                  if (parameters.on_sample) parameters.on_sample(sample);
                }};
    if (parameters.realtime) {
      awake.emplace();
      storage.emplace(samples, consumer);
      running.emplace(
          *device, loop, watchdog_state,
          device::WatchedLoop::Parameters{.allow_no_realtime = parameters.allow_no_realtime,
                                          .clear_cpu = true});
    } else if (!device->capabilities().simulated) {
      throw core::Error(parameters.device +
                        ": expected a simulated device, found a real one, which runs in real "
                        "time alone; add --realtime");
    } else {
      device->open();
    }
    require_own_profile();
  }

  ~Implementation() {
    // There is no force after the loop's last tick, because storage may take its time.
    if (running) {
      running->stop();
    } else {
      device->close();
    }
    storage.reset();
  }

  /// Checks that the profile belongs to the device, because some devices tell which one they
  /// are only when they are open. The device is still disarmed, or simulated.
  void require_own_profile() {
    if (parameters.profile == nullptr) return;
    const std::string problem =
        foreign_words(*parameters.profile, bare_device->identity(),
                      device_of_profile(parameters.device, *bare_device).says_simulated,
                      /*is_open=*/true);
    if (problem.empty()) return;
    if (running) {
      running->stop();
    } else {
      device->close();
    }
    throw core::Error(problem);
  }

  /// The sign of life of the thread that leads the session. A person talks to it, unless there
  /// is a window, which has one of its own.
  void beat() noexcept {
    (parameters.exchange == nullptr ? exchange.heartbeat : session_heartbeat).beat();
  }

  /// Whoever leads the session looks at what the loop tells all the time, unless it hangs.
  void beat_of_session() noexcept {
    if (parameters.exchange != nullptr) session_heartbeat.beat();
  }

  /// A slow disk is no hung program, but whoever waits for it takes no medium away, and without
  /// a window nobody can press the emergency stop: the heartbeat goes on for a second, then the
  /// force fades. With a window the loop itself has that second of patience.
  std::function<void()> beats_while_waiting() {
    beat();
    if (parameters.exchange != nullptr) return [] {};
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    return [this, patience] {
      if (std::chrono::steady_clock::now() < patience) beat();
    };
  }

  /// Does `work` once every sample up to now was taken.
  void after_samples(std::int64_t last_tick, const std::function<void()>& work) {
    if (storage) return storage->after(last_tick, work, beats_while_waiting());
    work();
  }

  void feed_meter(const core::Sample& sample) noexcept {
    meter.feed(sample, loop.period_s());
    num_metered_strokes.store(meter.num_strokes(), std::memory_order_relaxed);
  }

  void run_simulated(std::int64_t num_ticks) {
    for (std::int64_t done = 0; done < num_ticks;) {
      const auto batch =
          std::min<std::int64_t>(num_ticks - done, std::int64_t{kSimulatedQueueCapacity});
      for (std::int64_t i = 0; i < batch; ++i) loop.tick();
      samples.drain([this](const core::Sample& sample) { consumer.take(sample); });
      done += batch;
    }
    simulated_clock.advance_ns(
        std::llround(static_cast<double>(num_ticks) * 1e9 / parameters.rate_hz));
  }

  /// Arms the device as somebody beside it has asked for. A connection has to be good for a
  /// while before the device may be armed; any other problem needs a person. Throws
  /// `core::Error`.
  void arm() {
    constexpr auto kPatience = std::chrono::seconds(10);
    if (parameters.before_arming) parameters.before_arming();
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (true) {
      if (stop_requested()) {
        throw core::Error("device: expected to be armed, found that the program is to stop");
      }
      beat();
      telemetry.fetch();
      loop.rearm(telemetry.value().num_faults);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      telemetry.fetch();
      const core::Telemetry& now = telemetry.value();
      if (now.arming == core::Arming::kArming || now.arming == core::Arming::kArmed) return;
      const bool may_come =
          now.fault == core::Fault::kNotArmed || now.fault == core::Fault::kLinkLost;
      if (may_come && std::chrono::steady_clock::now() < end) continue;
      throw core::Error("device: expected to be armed, found: " +
                        std::string(words(now.fault)));
    }
  }

  void run_realtime(std::int64_t until_tick) {
    while (true) {
      beat();
      telemetry.fetch();
      const core::Telemetry& now = telemetry.value();
      if (now.fault != core::Fault::kNone || watchdog_state.has_bitten()) return;
      if (now.num_ticks > 0 && now.sample.tick + 1 >= until_tick) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  Parameters parameters;
  /// Only in real time.
  std::optional<SleepInhibitor> awake;
  OperatorExchange own_exchange;  ///< Used if there is no window.
  OperatorExchange& exchange;
  core::Heartbeat session_heartbeat;  ///< Where there is a window.
  std::unique_ptr<device::HapticDevice> bare_device;
  /// Exists if there is a profile of the device.
  std::unique_ptr<device::HapticDevice> measured_device;
  /// Exists if faults are injected into the device.
  std::unique_ptr<device::HapticDevice> faulty_device;
  device::HapticDevice* device;  ///< The outermost of these devices.
  /// nullptr unless a simulated arm moves the hand.
  device::SimulatedHand* simulated_hand;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::SpscQueue<core::Sample> samples;
  core::WatchdogState watchdog_state;
  core::Telemetry told_by_watchdog;
  core::SampleConsumer consumer;
  double max_total_force_n;
  device::HapticLoop loop;
  std::optional<core::RecordingWriter> recording;
  MovementMeter meter;
  bool metering = false;
  std::atomic<int> num_metered_strokes{0};
  std::optional<core::StorageThread> storage;
  std::optional<device::WatchedLoop> running;
  core::SimulatedClock simulated_clock;
  core::SystemClock system_clock;
  core::HapticCommand command;
  std::uint64_t stimulus = 0;  ///< Sequence of the command that began it.
};

Apparatus::Apparatus(const Parameters& parameters)
    : implementation_(std::make_unique<Implementation>(parameters, nullptr)) {
  if (parameters.arm && parameters.realtime && !is_simulated()) implementation_->arm();
}

Apparatus::Apparatus(const Parameters& parameters, const experiments::Laboratory& laboratory)
    : implementation_(std::make_unique<Implementation>(parameters, &laboratory)) {
  if (parameters.arm && parameters.realtime && !is_simulated()) implementation_->arm();
}

Apparatus::~Apparatus() = default;

void Apparatus::render(const core::MediumAmounts& medium, Stimulus stimulus) {
  Implementation& my = *implementation_;
  ++my.command.sequence;
  if (stimulus == Stimulus::kAnother) my.stimulus = my.command.sequence;
  my.command.stimulus = my.stimulus;
  my.command.medium = medium + my.parameters.surroundings;
  my.command.immersion = my.parameters.immersion;
  my.command.ramp_s = my.parameters.ramp_s;
  my.commands.publish(my.command);
}

void Apparatus::begin_strokes(const device::StrokePlan& plan,
                              const core::RandomStream& random) {
  Implementation& my = *implementation_;
  if (my.simulated_hand != nullptr) my.simulated_hand->begin_strokes(plan, random);
}

void Apparatus::put_fingers_back() {
  if (implementation_->simulated_hand != nullptr) {
    implementation_->simulated_hand->put_fingers_back();
  }
}

void Apparatus::go_home() {
  Implementation& my = *implementation_;
  if (my.simulated_hand != nullptr) my.simulated_hand->go_home();
}

std::int64_t Apparatus::strokes_finished() const noexcept {
  const Implementation& my = *implementation_;
  return my.simulated_hand != nullptr ? my.simulated_hand->strokes_finished()
                                      : num_metered_strokes();
}

void Apparatus::run_for(double duration_s) {
  Implementation& my = *implementation_;
  const auto num_ticks = std::llround(duration_s * my.parameters.rate_hz);
  if (my.parameters.realtime) {
    my.run_realtime(next_tick() + num_ticks);
  } else {
    my.run_simulated(num_ticks);
  }
  const core::Fault fault = telemetry().fault;
  if (fault != core::Fault::kNone) throw core::Error("haptic loop: " + fault_words(fault));
}

void Apparatus::rearm(std::uint64_t num_faults_seen) {
  implementation_->loop.rearm(num_faults_seen);
}

void Apparatus::disarm() { implementation_->loop.disarm(); }

bool Apparatus::shadows_guards() const noexcept {
  return implementation_->parameters.shadow_guards;
}

bool Apparatus::is_simulated() const noexcept {
  return implementation_->device->capabilities().simulated;
}

std::vector<core::Sample> Apparatus::flight_record() const {
  const core::FlightRecorder& recorder = implementation_->loop.flight_recorder();
  return recorder.is_frozen() ? recorder.contents() : std::vector<core::Sample>();
}

std::int64_t Apparatus::next_tick() const noexcept {
  Implementation& my = *implementation_;
  my.beat_of_session();
  my.telemetry.fetch();
  const core::Telemetry& now = my.telemetry.value();
  return now.num_ticks > 0 ? now.sample.tick + 1 : my.parameters.first_tick;
}

const core::Telemetry& Apparatus::telemetry() const noexcept {
  Implementation& my = *implementation_;
  my.beat_of_session();
  my.telemetry.fetch();
  const core::Telemetry& told = my.telemetry.value();
  if (told.fault != core::Fault::kNone || !my.watchdog_state.has_bitten()) return told;
  // The loop stands still and cannot tell.
  my.told_by_watchdog = told;
  my.told_by_watchdog.fault = core::Fault::kWatchdog;
  my.told_by_watchdog.num_faults = told.num_faults + 1;
  return my.told_by_watchdog;
}

bool Apparatus::is_laboratory_hand() const noexcept {
  return implementation_->parameters.device == kLumped;
}

std::string Apparatus::fault_words(core::Fault fault) const {
  const device::HapticDevice& device = *implementation_->device;
  return app::fault_words(fault, device.words_of_fault(), device.answers());
}

bool Apparatus::measures_force() const noexcept {
  return (implementation_->device->capabilities().channels & core::kMeasuredForce) != 0;
}

core::ShareRatios Apparatus::share_ratio() const noexcept {
  return implementation_->device->capabilities().share_ratio;
}

experiments::DeviceTold Apparatus::device_told() const {
  const device::DeviceIdentity identity = implementation_->bare_device->identity();
  const device::DeviceCapabilities can = implementation_->bare_device->capabilities();
  return {.model = identity.model,
          .serial = identity.serial,
          .firmware = identity.firmware,
          .share_ratio = {can.share_ratio.begin(), can.share_ratio.end()},
          .has = core::channel_names(can.channels),
          .own_mass_kg = can.own_mass_kg,
          .own_damping_n_s_per_m = can.own_damping_n_s_per_m,
          .closed_loop_delay_s = can.closed_loop_delay_s};
}

int Apparatus::num_contact_points() const noexcept {
  return implementation_->device->capabilities().num_contact_points();
}

double Apparatus::max_total_force_n() const noexcept {
  return implementation_->max_total_force_n;
}

void Apparatus::meter_strokes() {
  Implementation& my = *implementation_;
  my.after_samples(next_tick() - 1, [&my] {
    my.meter.start();
    my.num_metered_strokes = 0;
    my.metering = true;
  });
}

int Apparatus::num_metered_strokes() const noexcept {
  return implementation_->num_metered_strokes.load(std::memory_order_relaxed);
}

core::PresentationMeasures Apparatus::finish_strokes() {
  Implementation& my = *implementation_;
  core::PresentationMeasures measures;
  my.after_samples(next_tick() - 1, [&] {
    measures = my.meter.finish();
    my.num_metered_strokes = 0;
    my.metering = false;
  });
  return measures;
}

void Apparatus::commit(core::StudyStore& store, const core::Commit& commit) {
  Implementation& my = *implementation_;
  if (my.storage) return my.storage->commit(store, commit, my.beats_while_waiting());
  my.consumer.commit(store, commit);
}

const core::ContactSums& Apparatus::metered_sums() const noexcept {
  return implementation_->meter.sums();
}

const device::RealtimeThread* Apparatus::realtime_thread() const noexcept {
  return implementation_->running ? &implementation_->running->thread() : nullptr;
}

std::string Apparatus::realtime() const {
  if (!implementation_->running) return "simulated";
  const device::RealtimeReport& report = implementation_->running->thread().report();
  return report.scheduler + (report.memory_locked ? ", memory locked" : ", memory not locked");
}

const core::Clock& Apparatus::clock() const noexcept {
  if (implementation_->parameters.realtime) return implementation_->system_clock;
  return implementation_->simulated_clock;
}

}  // namespace jnd::app
