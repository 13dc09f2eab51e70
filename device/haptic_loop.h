#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>

#include "core/exchange/flight_recorder.h"
#include "core/exchange/haptic_command.h"
#include "core/exchange/latest_value.h"
#include "core/exchange/spsc_queue.h"
#include "core/exchange/telemetry.h"
#include "core/media/force_map.h"
#include "core/media/solid_surfaces.h"
#include "core/safety/emergency_stop.h"
#include "core/safety/force_limiter.h"
#include "core/safety/guards.h"
#include "core/safety/heartbeat.h"
#include "core/safety/passivity.h"
#include "core/safety/staleness.h"
#include "core/safety/unseen_force.h"
#include "core/safety/watchdog_state.h"
#include "core/safety/workspace.h"
#include "device/guide.h"
#include "device/haptic_device.h"

namespace jnd::device {

/// One tick of haptics over a device and a command:
///
///   emergency stop -> read -> command, ramp -> kinematics -> solids, immersion -> fluid
///   -> distribution -> passivity -> limiter -> write -> sample, telemetry
///
/// It uses no wall clock. A real-time thread drives it by absolute time, a simulation or a test
/// as fast as it likes. Any problem of the device, the force or the rest of the program becomes
/// a latched fault and zero force at once. Only after a lost heartbeat and some guards' faults
/// does the force fade out (`core::fades`). After a fault the loop continues to read and to
/// write zeros, so that everything is recorded.
class HapticLoop {
 public:
  struct Parameters {
    /// Starts with full force in the first tick; only for a simulated device. Otherwise there
    /// is no force before `rearm`, and the fault is `kNotArmed` until then.
    bool starts_armed = false;
    double rate_hz = 1000.0;                ///< > 0.
    double fade_speed_m_per_s = 0.005;      ///< As in `distribute_drag`, > 0.
    core::ForceLimiter::Parameters limits;  ///< The device's own limits apply as well.
    core::PassivityController::Parameters passivity;
    core::PortEnergy::Parameters port_energy;
    core::ForceOscillation::Parameters oscillation;
    core::VelocityCheck::Parameters velocity_check;
    double heartbeat_timeout_s = 0.250;  ///< > 0.
    /// Of whoever leads the session, > 0: a disk may hold it up for so long. Within a second a
    /// disk that is well commits whatever was being written.
    double session_timeout_s = 1.0;
    double fade_out_s = 0.100;     ///< Force to zero after a lost heartbeat, > 0.
    double guard_fade_s = 0.030;   ///< Force to zero after a guard's fault, > 0.
    double warn_margin_m = 0.020;  ///< To the edge of the workspace, >= 0.
    double rearm_s = 0.500;        ///< Force from zero back to full after a fault, > 0.
    double reattach_s = 0.200;     ///< Force back on a point that is held again, > 0.
    /// For how long the last measurement may stand in, >= 0; the device may ask for longer.
    double max_stale_s = 0.005;
    /// If an attached point leaves it, there is no force until the loop is armed again inside
    /// of it.
    core::Workspace workspace;
    /// For media that need one; borrowed. nullptr means the thesis's C_D and no lift.
    const core::ForceMap* force_map = nullptr;
    /// Moves the device while it is measured without a hand in it; borrowed. nullptr, as in
    /// every session, means that nobody does.
    Guide* guide = nullptr;
    /// For a simulated device that reports its force: whether energy, oscillation and velocity
    /// are watched. A real device is always watched. A measurement of the loop itself switches
    /// this off.
    bool watches_port = true;
    /// Guards (`core::kGuards`) only count what they would have done, to see their effect on a
    /// study. Only energy that a real device gives remains a fault. The guards then also watch
    /// a simulated device that does not report its force, which is assumed to act at once.
    bool shadows_guards = false;
    /// Largest displacement of a point between ticks beyond that of its top speed, > 0.
    double max_jump_m = 0.005;
    double flight_recorder_s = 1.0;  ///< > 0.
    /// Number of the first sample, from which a resumed recording continues.
    std::int64_t first_tick = 0;
  };

  /// The connections out of the haptic thread. The caller keeps all of them alive.
  struct Exchange {
    core::LatestValue<core::HapticCommand>& commands;
    core::LatestValue<core::Telemetry>& telemetry;
    core::EmergencyStop& emergency_stop;
    core::SpscQueue<core::Sample>* samples = nullptr;  ///< nullptr: nothing is recorded.
    const core::Heartbeat* heartbeat = nullptr;        ///< nullptr: a simulation needs none.
    core::WatchdogState* watchdog = nullptr;           ///< nullptr: nobody watches.
    /// Of whoever leads the session, where that is another thread than the one that a person
    /// talks to: if it hangs, nobody takes the medium away. Its silence counts from its first
    /// beat, because a long session takes its time to be read. nullptr: there is none.
    const core::Heartbeat* session = nullptr;
  };

  /// Throws `core::Error` naming the field. The caller opens and closes the device. Not real
  /// time.
  HapticLoop(const Parameters& parameters, HapticDevice& device, const Exchange& exchange);
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;

  /// Runs one whole tick. Real time.
  void tick() noexcept {
    render();
    report();
  }

  /// The part of a tick up to the device's write, and the rest, for a caller that measures
  /// lateness. Always call them in this order. Real time.
  void render() noexcept;
  void report() noexcept;

  /// Computes in vain what the next tick will compute, so that its code and data return to the
  /// cache if others have displaced them. It changes nothing. Real time.
  void warm() const noexcept;

  /// Asks for the force, faded in from zero, for the first time or after a fault. Takes effect
  /// in the next tick, unless the emergency stop is still pressed. If the device may not be
  /// armed now, that is a fault anew: the request is refused, not kept, for nobody expects the
  /// force minutes later. So it is while the emergency stop is pressed, within
  /// `core::kArmAfterRelease_s` after its release, and where it is pressed before the tick.
  ///
  /// `num_faults_seen`: `Telemetry::num_faults` as whoever asks has seen it. Of a fault that
  /// has come since nobody knows yet, so it stays. Any thread. Real time.
  void rearm(std::uint64_t num_faults_seen) noexcept {
    if (exchange_.emergency_stop.is_pressed()) return;
    if (waits_after_release_.load(std::memory_order_acquire)) return;
    rearm_requested_.store(num_faults_seen + 1, std::memory_order_release);
  }

  /// Tells the loop before a tick, if it is driven in real time, the time by the monotonic
  /// clock, and how many ticks were due since the last one and never ran. The tick's number
  /// counts those as well, so a number is a time. Not used in simulated time. Real time.
  void due(std::int64_t monotonic_ns, std::int64_t num_missed) noexcept {
    monotonic_ns_ = monotonic_ns;
    num_missed_ += num_missed;
  }

  /// Ends the force from the next tick on, until `rearm`. This is no fault. Any thread. Real
  /// time.
  void disarm() noexcept { disarm_requested_.store(true, std::memory_order_release); }

  /// Tells that the machine slept between two ticks, so that the next tick latches a fault.
  /// Call it like `stalled`. Real time.
  void suspended() noexcept {
    suspended_ = true;
    stall_is_told_ = false;
  }

  /// Tells that more time was lost between two ticks than a hand should be left to itself, so
  /// that the next tick latches a fault. For the thread that calls `tick`. Real time.
  void stalled() noexcept {
    stalled_ = true;
    stall_is_told_ = false;
  }

  [[nodiscard]] double period_s() const noexcept { return period_s_; }

  /// Whether a tick is due when the device has measured, and not by our clock.
  [[nodiscard]] bool is_paced() const noexcept { return is_paced_; }
  /// See `HapticDevice::wait_for_sample`. For the thread that calls `tick`.
  bool wait_for_sample(std::int64_t deadline_ns) noexcept {
    return device_.wait_for_sample(deadline_ns);
  }

  /// Whether the loop gets a heartbeat and beats for this watchdog.
  [[nodiscard]] bool is_watched_by(const core::WatchdogState& watched) const noexcept {
    return exchange_.heartbeat != nullptr && exchange_.watchdog == &watched;
  }

  /// Returns the last second before a fault. Read it before `rearm`.
  [[nodiscard]] const core::FlightRecorder& flight_recorder() const noexcept {
    return flight_recorder_;
  }

 private:
  void latch(core::Fault fault, double fading_s = 0.0) noexcept;
  void latch_found(core::Fault fault) noexcept;
  void obey_emergency_stop() noexcept;
  void wait_after_release() noexcept;
  void watch_heartbeats() noexcept;
  void obey_watchdog() noexcept;
  [[nodiscard]] bool stands_still() const noexcept;
  void rearm_if_requested() noexcept;
  void disarm_if_requested() noexcept;
  [[nodiscard]] core::Arming arming() const noexcept;
  void advance_authority() noexcept;
  void watch_attachment() noexcept;
  [[nodiscard]] core::Fault read_device() noexcept;
  [[nodiscard]] core::Fault check_against_last() noexcept;
  [[nodiscard]] double max_distance_m(double elapsed_s) const noexcept;
  /// Since the tick before: ticks that were missed took their time, too.
  [[nodiscard]] double elapsed_s() const noexcept {
    return period_s_ * static_cast<double>(1 + num_missed_);
  }
  [[nodiscard]] std::uint8_t surrounded_bits(const core::HapticCommand& command) const noexcept;
  void take_command() noexcept;
  void compute_force() noexcept;
  void add_guide_force() noexcept;
  [[nodiscard]] core::PointVectors force_of_medium() const noexcept;
  void write_device() noexcept;
  void add_exposure() noexcept;
  void count_forces() noexcept;

  Parameters parameters_;
  HapticDevice& device_;
  Exchange exchange_;
  double period_s_;
  bool is_paced_;
  bool has_joints_;
  core::ChannelBits channels_;  ///< Channels that the device has.
  bool stalled_ = false;
  bool suspended_ = false;
  bool stall_is_told_ = false;  ///< One of the two was latched, and neither has occurred since.
  bool is_first_armed_tick_ = false;
  std::int64_t monotonic_ns_ = 0;
  std::int64_t num_missed_ = 0;  ///< Since the last tick.
  core::Staleness staleness_;
  core::HeartbeatMonitor heartbeat_;
  core::HeartbeatMonitor session_;
  core::PassivityController passivity_;
  core::ForceLimiter limiter_;
  core::ShareRatios shares_;  ///< Shares of the points that the device has; 0 at the others.
  int num_points_;
  bool has_hand_plane_;  ///< If all its points are attached.
  bool watches_port_;
  bool acts_at_once_;  ///< The force that was sent last counts as the force that acted.
  bool may_be_armed_;
  bool tells_acted_;  ///< The device does.
  core::UnseenForce unseen_force_;
  core::Guards guards_;
  core::FlightRecorder flight_recorder_;
  std::atomic<std::uint64_t> rearm_requested_{0};  ///< Faults seen, and one; 0: nobody asks.
  std::atomic<bool> waits_after_release_{false};
  std::atomic<bool> disarm_requested_{false};
  std::uint64_t known_stop_presses_ = 0;
  bool saw_stop_ = false;  ///< Since it was seen to be released.
  double since_release_s_ = std::numeric_limits<double>::infinity();

  core::Fault fault_ = core::Fault::kNone;
  std::uint32_t latched_bits_ = 0;  ///< A bit a fault, since it was armed.
  /// Of the force, the shortest of all faults since it was armed.
  double fading_s_ = std::numeric_limits<double>::infinity();
  double authority_ratio_ = 1.0;
  /// 0 for a detached point.
  std::array<double, core::kNumContactPoints> point_authority_ratio_;
  core::MediumRamp ramp_;
  double ramp_step_s_ = 0.0;  ///< By which the ramp moves on in this tick.
  bool command_is_finite_ = true;
  std::uint64_t stimulus_ = 0;     ///< That the last command began, or went on with.
  std::uint8_t granted_bits_ = 0;  ///< Points that got their credit in it.
  core::SolidSurfaces solids_;
  core::PointVectors solid_force_n_ = core::zero_vectors();
  core::HapticState state_;
  core::HapticState last_state_;
  bool has_last_state_ = false;
  double since_new_s_ = 0.0;  ///< Since a measurement came that was new.
  std::uint8_t attached_bits_ = 0;
  std::uint8_t immersed_bits_ = 0;
  core::Guards::Contact contact_;
  core::HandMotion motion_;
  core::PointVectors force_on_hand_n_ = core::zero_vectors();
  /// Part of the force that comes from the guide, if there is one.
  core::PointVectors guide_n_ = core::zero_vectors();
  int num_failed_writes_ = 0;
  bool limited_ = false;
  core::ClockComparison device_clock_;
  core::Telemetry telemetry_;
};

}  // namespace jnd::device
