#include "device/haptic_loop.h"

#include <algorithm>
#include <cmath>

#include "core/media/fluid_force.h"
#include "core/require.h"

namespace jnd::device {
namespace {

using core::Fault;
using core::kNumContactPoints;

core::ForceLimiter::Parameters within(core::ForceLimiter::Parameters limits,
                                      const DeviceCapabilities& device) {
  limits.per_point_n = std::min(limits.per_point_n, device.max_force_per_point_n);
  limits.total_n = std::min(limits.total_n, device.max_total_force_n);
  limits.slew_n_per_s = std::min(limits.slew_n_per_s, device.max_slew_n_per_s);
  limits.max_speed_m_per_s = std::min(limits.max_speed_m_per_s, device.max_speed_m_per_s);
  return limits;
}

core::Workspace within(const core::Workspace& loop, const core::Workspace& device) {
  return {.half_width_x_m = std::min(loop.half_width_x_m, device.half_width_x_m),
          .half_width_y_m = std::min(loop.half_width_y_m, device.half_width_y_m),
          .half_width_z_m = std::min(loop.half_width_z_m, device.half_width_z_m)};
}

std::int64_t ticks(double duration_s, double rate_hz) {
  return static_cast<std::int64_t>(std::lround(duration_s * rate_hz));
}

core::PlainVector plain(const Eigen::Vector3d& vector) noexcept {
  return {vector.x(), vector.y(), vector.z()};
}

bool is_finite(const core::HapticState& state, bool has_joints, bool tells_force) noexcept {
  // A sum is finite only if every term is. It could overflow only for coordinates of 1e307.
  Eigen::Vector3d sum = state.end_effector_position_m;
  for (int i = 0; i < kNumContactPoints; ++i) {
    sum += state.tip_position_m[i] + state.tip_velocity_m_per_s[i];
  }
  for (int i = 0; tells_force && i < kNumContactPoints; ++i) sum += state.acted_n[i];
  double joints = 0.0;
  for (int i = 0; has_joints && i < core::kNumJoints; ++i) {
    joints += std::abs(state.joint_position_rad[i]) + std::abs(state.joint_torque_n_m[i]);
  }
  // Joints are recorded as `float`, which overflows only far above this.
  return std::isfinite(sum.x() + sum.y() + sum.z()) && joints < 1e30 &&
         (state.channels.bits == 0 || core::is_sound(state.channels));
}

constexpr std::uint32_t bit_of(Fault fault) noexcept {
  return std::uint32_t{1} << static_cast<unsigned>(fault);
}
static_assert(static_cast<unsigned>(core::kLastFault) < 32);

bool spans_hand_plane(const DeviceCapabilities& device) noexcept {
  std::array<bool, kNumContactPoints> has{};
  for (int i = 0; i < kNumContactPoints; ++i) has[i] = device.has_point(i);
  return core::tip_of_hand_plane(has).has_value();
}

}  // namespace

HapticLoop::HapticLoop(const Parameters& parameters, HapticDevice& device,
                       const Exchange& exchange)
    : parameters_(parameters),
      device_(device),
      exchange_(exchange),
      period_s_(core::period_s_at(parameters.rate_hz)),
      is_paced_(device.capabilities().paces_loop),
      has_joints_(device.capabilities().num_joints > 0),
      channels_(device.capabilities().channels),
      staleness_(ticks(std::max(parameters.max_stale_s, device.capabilities().max_stale_s),
                       parameters.rate_hz),
                 period_s_),
      heartbeat_(exchange.heartbeat, ticks(parameters.heartbeat_timeout_s, parameters.rate_hz)),
      session_(exchange.session, ticks(parameters.session_timeout_s, parameters.rate_hz),
               core::HeartbeatMonitor::Since::kFirstBeat),
      passivity_(parameters.passivity, period_s_),
      limiter_(within(parameters.limits, device.capabilities()), period_s_),
      shares_(device.capabilities().share_ratio),
      num_points_(device.capabilities().num_contact_points()),
      has_hand_plane_(spans_hand_plane(device.capabilities())),
      watches_port_(
          device.capabilities().simulated
              ? parameters.shadows_guards ||
                    (parameters.watches_port && device.capabilities().tells_acting_force)
              : device.capabilities().tells_acting_force),
      acts_at_once_(watches_port_ && !device.capabilities().tells_acting_force),
      may_be_armed_(device.capabilities().simulated || watches_port_),
      tells_acted_(device.capabilities().tells_acting_force),
      unseen_force_(device.capabilities().max_force_per_point_n),
      guards_({.port_energy = parameters.port_energy,
               .oscillation = parameters.oscillation,
               .velocity_check = parameters.velocity_check,
               .stillness = {.max_still_s = device.capabilities().max_still_s},
               .workspace = within(parameters.workspace, device.capabilities().workspace),
               .warn_margin_m = parameters.warn_margin_m,
               .watches_port = watches_port_,
               .watches_stillness = !device.capabilities().simulated,
               .shadows = parameters.shadows_guards,
               .shadows_energy = device.capabilities().simulated,
               .longest_s = staleness_.longest_s()},
              period_s_),
      flight_recorder_(static_cast<std::size_t>(
          std::max<std::int64_t>(1, ticks(parameters.flight_recorder_s, parameters.rate_hz)))) {
  core::require_positive(parameters.fade_speed_m_per_s, "fade_speed_m_per_s");
  core::require_positive(parameters.heartbeat_timeout_s, "heartbeat_timeout_s");
  core::require_positive(parameters.session_timeout_s, "session_timeout_s");
  core::require_positive(parameters.fade_out_s, "fade_out_s");
  core::require_positive(parameters.guard_fade_s, "guard_fade_s");
  core::require_positive(parameters.rearm_s, "rearm_s");
  core::require_positive(parameters.reattach_s, "reattach_s");
  core::require_not_negative(parameters.max_stale_s, "max_stale_s");
  core::require_positive(parameters.max_jump_m, "max_jump_m");
  core::require_positive(parameters.flight_recorder_s, "flight_recorder_s");
  if (num_points_ == 0) {
    throw core::Error("share_ratio: expected a device with at least one point, found none");
  }
  point_authority_ratio_.fill(1.0);
  known_stop_presses_ = exchange.emergency_stop.num_presses();
  // It may have been released just before there was this loop.
  if (known_stop_presses_ > 0) {
    since_release_s_ = 0.0;
    waits_after_release_ = true;
  }
  if (!parameters.starts_armed) {
    fault_ = Fault::kNotArmed;
    authority_ratio_ = 0.0;
  }
  telemetry_.sample.tick = parameters.first_tick - 1;
}

void HapticLoop::render() noexcept {
  // The emergency stop comes first, before anything that could go wrong.
  obey_emergency_stop();
  wait_after_release();
  rearm_if_requested();
  // This comes after rearming, so that a request for both gives no force.
  disarm_if_requested();
  obey_watchdog();
  watch_heartbeats();
  advance_authority();

  const Fault found = read_device();
  if (found != Fault::kNone) latch_found(found);
  take_command();
  compute_force();
  // If the tick was held up after the read, the computed force is too old to be sent.
  obey_watchdog();
  obey_emergency_stop();
  if (authority_ratio_ == 0.0) force_on_hand_n_ = core::zero_vectors();
  write_device();
  if (exchange_.watchdog != nullptr) exchange_.watchdog->beat();
}

void HapticLoop::write_device() noexcept {
  if (device_.write(force_on_hand_n_)) {
    num_failed_writes_ = 0;
    return;
  }
  latch(device_.fault() != Fault::kNone ? device_.fault() : Fault::kDeviceWriteFailed);
  // Later zeros may get lost as well, and the last force would persist. The halt is repeated,
  // because a single one may get lost, too. It is not repeated for ever, because the device may
  // be about to recover.
  constexpr int kNumHalts = 10;
  if (num_failed_writes_ < kNumHalts) device_.halt();
  num_failed_writes_ = std::min(num_failed_writes_ + 1, kNumHalts);
}

/// This also obeys a press that was released before the loop saw it.
void HapticLoop::obey_emergency_stop() noexcept {
  const std::uint64_t num_presses = exchange_.emergency_stop.num_presses();
  // Every press is another one to be told of: whoever asked before it has to ask again, also
  // where it is released already.
  if (num_presses != known_stop_presses_) latched_bits_ &= ~bit_of(Fault::kEmergencyStop);
  if (num_presses != known_stop_presses_ || exchange_.emergency_stop.is_pressed()) {
    latch(Fault::kEmergencyStop);
    saw_stop_ = true;
  }
  known_stop_presses_ = num_presses;
}

/// From the first tick on that sees it released.
void HapticLoop::wait_after_release() noexcept {
  if (exchange_.emergency_stop.is_pressed() || saw_stop_) {
    saw_stop_ = exchange_.emergency_stop.is_pressed();
    since_release_s_ = 0.0;
  } else {
    since_release_s_ += elapsed_s();
  }
  waits_after_release_.store(since_release_s_ < core::kArmAfterRelease_s,
                             std::memory_order_release);
}

/// Whoever could press the stop, and whoever takes the medium away.
void HapticLoop::watch_heartbeats() noexcept {
  const double fading_s = parameters_.fade_out_s;
  if (heartbeat_.is_silent(1 + num_missed_)) latch(Fault::kHeartbeatLost, fading_s);
  if (session_.is_silent(1 + num_missed_)) latch(Fault::kHeartbeatLost, fading_s);
}

/// It has halted the device, or whoever ticks lost time: whatever was latched before, there is
/// no force since.
void HapticLoop::obey_watchdog() noexcept {
  stalled_ |= exchange_.watchdog != nullptr && exchange_.watchdog->has_bitten();
  if (suspended_) latch(Fault::kSuspended);
  if (stalled_) latch(Fault::kWatchdog);
  stall_is_told_ = stalled_ || suspended_;
}

bool HapticLoop::stands_still() const noexcept {
  return stalled_ || suspended_ ||
         (exchange_.watchdog != nullptr && exchange_.watchdog->has_bitten());
}

/// While a hand is being put in, the device moves about, and its enabling switch is open. This
/// is no fault while there is no force.
static bool is_of_no_matter_yet(Fault fault) noexcept {
  return fault == Fault::kNotEnabled || fault == Fault::kPositionFrozen ||
         fault == Fault::kPositionJump || fault == Fault::kOverVelocity ||
         fault == Fault::kVelocityContradicts || fault == Fault::kEnergyGiven ||
         fault == Fault::kOutsideWorkspace || fault == Fault::kStaleSample;
}

void HapticLoop::latch(Fault fault, double fading_s) noexcept {
  // The first fault is the one to report, but the fading after a lost heartbeat must not soften
  // a later fault.
  if (fault_ == Fault::kNotArmed && is_of_no_matter_yet(fault)) return;
  // A stop is told whatever came before it, for only who knows of it asks for its release.
  const bool gives_way = fault_ == Fault::kHeartbeatLost || fault_ == Fault::kNotArmed ||
                         fault == Fault::kEmergencyStop;
  const bool is_told = fault_ == Fault::kNone || gives_way;
  if (is_told) fault_ = fault;
  // The others are counted, so that whoever arms acknowledges no fault that nobody has seen.
  // But not what would be found again once there is force.
  if (is_told || authority_ratio_ > 0.0 || !is_of_no_matter_yet(fault)) {
    if ((latched_bits_ & bit_of(fault)) == 0) ++telemetry_.num_faults;
    latched_bits_ |= bit_of(fault);
  }
  fading_s_ = std::min(fading_s_, fading_s);
  if (fading_s_ == 0.0) authority_ratio_ = 0.0;
}

/// Latches a fault that the loop itself found in this tick.
void HapticLoop::latch_found(Fault fault) noexcept {
  latch(fault, core::fades(fault) ? parameters_.guard_fade_s : 0.0);
}

void HapticLoop::disarm_if_requested() noexcept {
  if (!disarm_requested_.load(std::memory_order_relaxed)) return;
  disarm_requested_.store(false, std::memory_order_relaxed);
  if (fault_ == Fault::kNone || fault_ == Fault::kHeartbeatLost) {
    fault_ = Fault::kNotArmed;
    latched_bits_ = 0;
  }
  authority_ratio_ = 0.0;
}

core::Arming HapticLoop::arming() const noexcept {
  if (fault_ == Fault::kNotArmed) return core::Arming::kDisarmed;
  if (fault_ != Fault::kNone) return core::Arming::kFaulted;
  return authority_ratio_ < 1.0 ? core::Arming::kArming : core::Arming::kArmed;
}

void HapticLoop::rearm_if_requested() noexcept {
  if (rearm_requested_.load(std::memory_order_relaxed) == 0) return;
  const std::uint64_t requested = rearm_requested_.exchange(0, std::memory_order_relaxed);
  if (exchange_.emergency_stop.is_pressed() || fault_ == Fault::kNone) return;
  // A fault has come since, and whoever asked did not know of it.
  if (requested != telemetry_.num_faults + 1) return;
  // Asked for before anybody knew that the loop had stood still: refused.
  if (stands_still() && !stall_is_told_) return;
  fault_ = Fault::kNone;
  latched_bits_ = 0;
  fading_s_ = std::numeric_limits<double>::infinity();
  authority_ratio_ = 0.0;
  if (!may_be_armed_) return latch(Fault::kActingForceUnknown);
  if (!device_.may_arm()) {
    return latch(device_.fault() != Fault::kNone ? device_.fault() : Fault::kLinkLost);
  }
  limiter_.rearm();
  passivity_.reset();
  guards_.reset();
  // The credit is gone with the rest, so a step of the stimulus before begins another one.
  stimulus_ = 0;
  granted_bits_ = 0;
  solids_.release();
  unseen_force_.reset();
  since_new_s_ = 0.0;
  has_last_state_ = false;
  staleness_.reset();
  stalled_ = false;
  suspended_ = false;
  stall_is_told_ = false;
  is_first_armed_tick_ = true;
  if (exchange_.watchdog != nullptr) exchange_.watchdog->forgive();
  flight_recorder_.thaw();
}

void HapticLoop::advance_authority() noexcept {
  if (is_first_armed_tick_) {
    // Zeros are written once more, because a halted device waits for them.
    is_first_armed_tick_ = false;
    return;
  }
  // It goes in the time that has passed, and comes back in ticks that ran: never faster.
  if (fault_ == Fault::kNone) {
    authority_ratio_ = std::min(1.0, authority_ratio_ + period_s_ / parameters_.rearm_s);
  } else {
    authority_ratio_ = std::max(0.0, authority_ratio_ - elapsed_s() / fading_s_);
  }
}

Fault HapticLoop::read_device() noexcept {
  last_state_ = state_;
  if (!device_.read(state_)) {
    state_ = last_state_;
    // Whatever fault the device reports, no force is left to fade.
    latch(device_.fault() != Fault::kNone ? device_.fault() : Fault::kDeviceReadFailed);
    return Fault::kNone;
  }
  // What a device reports about points that it does not have is ignored.
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (shares_[i] > 0.0) continue;
    state_.attached[i] = false;
    state_.tip_position_m[i].setZero();
    state_.tip_velocity_m_per_s[i].setZero();
    state_.acted_n[i].setZero();
  }
  if (acts_at_once_) state_.acted_n = force_on_hand_n_;
  state_.channels.bits = channels_;
  if (!is_finite(state_, has_joints_, watches_port_)) {
    // Recordings and telemetry get the last valid state.
    state_ = last_state_;
    return Fault::kNonFiniteState;
  }
  if (watches_port_ && !acts_at_once_ &&
      unseen_force_.observe(force_on_hand_n_, state_.acted_n, elapsed_s())) {
    return Fault::kActingForceUnknown;
  }
  Fault found = has_last_state_ ? check_against_last() : Fault::kNone;
  has_last_state_ = true;
  // A reused measurement says nothing about the hand.
  const bool is_new = state_.device_time_ns != last_state_.device_time_ns;
  // In simulated time there is only one clock.
  if (is_new && monotonic_ns_ != 0) {
    device_clock_.observe(state_.arrived_ns != 0 ? state_.arrived_ns : monotonic_ns_,
                          state_.device_time_ns);
  }
  since_new_s_ += elapsed_s();
  if (found == Fault::kNone && is_new) {
    found = guards_.observe_stillness(state_, contact_, since_new_s_);
  }
  if (is_new) since_new_s_ = 0.0;
  if (!state_.enabled) found = Fault::kNotEnabled;
  watch_attachment();
  attached_bits_ = 0;
  for (int i = 0; i < kNumContactPoints; ++i) {
    const int held = state_.attached[i] ? 1 : 0;
    attached_bits_ = static_cast<std::uint8_t>(attached_bits_ | held << i);
  }
  const Fault place = guards_.observe_place(state_);
  return found != Fault::kNone ? found : place;
}

/// A magnet that chatters must not knock, so a point that is attached again gets its force
/// slowly.
void HapticLoop::watch_attachment() noexcept {
  for (int i = 0; i < kNumContactPoints; ++i) {
    double& ratio = point_authority_ratio_[i];
    if (state_.attached[i]) {
      ratio = std::min(1.0, ratio + period_s_ / parameters_.reattach_s);
      continue;
    }
    if (ratio > 0.0) ++telemetry_.num_detachments[i];
    ratio = 0.0;
  }
}

/// More elapsed time allows a hand to have moved farther, but only up to the time for which a
/// measurement may be reused. So a leap of the device's clock does not excuse a leap of the
/// hand.
double HapticLoop::max_distance_m(double elapsed_s) const noexcept {
  return parameters_.max_jump_m + parameters_.limits.max_speed_m_per_s *
                                      std::clamp(elapsed_s, period_s_, staleness_.longest_s());
}

Fault HapticLoop::check_against_last() noexcept {
  // The subtraction is unsigned, because a device may report any time and a signed one could
  // overflow.
  const auto elapsed_ns =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(state_.device_time_ns) -
                                static_cast<std::uint64_t>(last_state_.device_time_ns));
  const double elapsed_s = 1e-9 * static_cast<double>(elapsed_ns);
  const double max_m = max_distance_m(elapsed_s);
  bool jumped = false;
  for (int i = 0; i < kNumContactPoints; ++i) {
    const double squared_m2 =
        (state_.tip_position_m[i] - last_state_.tip_position_m[i]).squaredNorm();
    if (!state_.attached[i]) continue;
    jumped |= last_state_.attached[i] && squared_m2 > max_m * max_m;
  }
  if (jumped) return Fault::kPositionJump;
  const Fault port =
      elapsed_s > 0.0 ? guards_.observe_port(state_, contact_, elapsed_s) : Fault::kNone;
  staleness_.observe(state_, last_state_, elapsed_s, num_missed_);
  // A fault that ends the force at once must not be hidden by one that lets it fade.
  if (port != Fault::kNone && !core::fades(port)) return port;
  if (!staleness_.is_stale()) return port;
  return staleness_.may_be_the_loops() ? Fault::kHostTooSlow : Fault::kStaleSample;
}

/// Returns the points around which this command puts a medium that stores energy. They did not
/// enter it, and were not in such a medium before. (A medium that only becomes stiffer gives
/// back no more than it got.)
std::uint8_t HapticLoop::surrounded_bits(const core::HapticCommand& command) const noexcept {
  std::uint8_t bits = 0;
  if (!command_is_finite_) return bits;
  if (command.medium.buoyancy_n == 0.0 && !command.medium.plane().is_there()) return bits;
  for (int i = 0; i < kNumContactPoints; ++i) {
    const bool inside = state_.attached[i] && (contact_.storing_bits >> i & 1) == 0 &&
                        command.immersion.contains(state_.tip_position_m[i]);
    bits = static_cast<std::uint8_t>(bits | (inside ? 1 : 0) << i);
  }
  return bits;
}

void HapticLoop::take_command() noexcept {
  ramp_step_s_ = elapsed_s();
  if (exchange_.commands.fetch()) {
    const core::HapticCommand& command = exchange_.commands.value();
    command_is_finite_ = command.medium.is_finite() && command.immersion.is_sound();
    // A ramp that took a value that is not a number would keep it for ever.
    if (command_is_finite_) {
      // Of the ticks that were missed, nobody knows which came before the command. A medium
      // must not begin with time from before it, but one that is taken away must not take
      // longer.
      if (!command.medium.is_nowhere_more_than(ramp_.current())) ramp_step_s_ = period_s_;
      ramp_.start(command.medium, command.ramp_s);
    }
    const bool goes_on = command.stimulus != 0 && command.stimulus == stimulus_;
    stimulus_ = command.stimulus != 0 ? command.stimulus : command.sequence;
    // A step of the same stimulus pays for nothing anew, nor does it make swings forgotten.
    if (!goes_on) {
      guards_.medium_changed();
      granted_bits_ = 0;
    }
    const auto newly_bits =
        static_cast<std::uint8_t>(surrounded_bits(command) & ~unsigned{granted_bits_});
    passivity_.grant_credit(newly_bits);
    granted_bits_ = static_cast<std::uint8_t>(granted_bits_ | newly_bits);
  }
  if (!command_is_finite_) latch(Fault::kNonFiniteForce);
}

void HapticLoop::compute_force() noexcept {
  const core::HapticCommand& command = exchange_.commands.value();
  const core::MediumAmounts& medium = ramp_.advance(ramp_step_s_);
  motion_ =
      core::hand_motion(state_.tip_position_m, state_.tip_velocity_m_per_s, state_.attached);
  // If a device has no hand plane, the hand counts as head on.
  if (!has_hand_plane_ && motion_.speed_m_per_s > 0.0) motion_.sin_angle_of_attack = 1.0;
  const bool is_solid = core::SolidSurfaces::are_there(medium);
  if (is_solid) {
    solids_.render(medium, command.immersion, shares_, state_, period_s_, solid_force_n_);
  } else {
    solids_.release();
  }
  immersed_bits_ = is_solid ? solids_.held_bits() : std::uint8_t{0};
  for (int i = 0; i < kNumContactPoints; ++i) {
    const int inside = command.immersion.contains(state_.tip_position_m[i]) ? 1 : 0;
    immersed_bits_ = static_cast<std::uint8_t>(immersed_bits_ | inside << i);
  }
  contact_.storing_bits = medium.buoyancy_n != 0.0 ? immersed_bits_ : std::uint8_t{0};
  for (int i = 0; is_solid && i < kNumContactPoints; ++i) {
    const int touches = solid_force_n_[i].isZero(0.0) ? 0 : 1;
    contact_.storing_bits = static_cast<std::uint8_t>(contact_.storing_bits | touches << i);
  }
  limited_ = false;
  contact_.pushed_bits = 0;
  if (authority_ratio_ == 0.0) {
    // Limiter and passivity start from this force when the loop is armed again.
    force_on_hand_n_ = core::zero_vectors();
    return;
  }
  core::add_up_fluid_force(medium, parameters_.force_map, motion_, shares_, state_,
                           immersed_bits_, command.immersion.origin_z_m,
                           parameters_.fade_speed_m_per_s, force_on_hand_n_);
  if (is_solid) {
    for (int i = 0; i < kNumContactPoints; ++i) force_on_hand_n_[i] += solid_force_n_[i];
  }
  for (int i = 0; i < kNumContactPoints; ++i) {
    // Friction can hold a hand against a smaller force.
    constexpr double kPushN = 1.0;
    const bool is_pushed = (contact_.storing_bits >> i & 1) != 0 &&
                           force_on_hand_n_[i].squaredNorm() >= kPushN * kPushN;
    contact_.pushed_bits =
        static_cast<std::uint8_t>(contact_.pushed_bits | (is_pushed ? 1 : 0) << i);
    const double ratio =
        authority_ratio_ * point_authority_ratio_[i] * guards_.authority_ratio(i);
    if (ratio < 1.0) force_on_hand_n_[i] *= ratio;
  }
  passivity_.control(state_.tip_position_m, state_.tip_velocity_m_per_s, force_on_hand_n_);
  if (parameters_.guide != nullptr) add_guide_force();
  limited_ = limiter_.limit(state_.attached, state_.tip_velocity_m_per_s, force_on_hand_n_) ||
             guards_.asks_to_move();
  passivity_.sent(force_of_medium());
  const Fault swings = guards_.observe_force(force_on_hand_n_);
  if (swings != Fault::kNone) latch_found(swings);
  if (limiter_.fault() != Fault::kNone) latch(limiter_.fault());
}

/// Scales the guide's force by authority and attachment, like every force.
void HapticLoop::add_guide_force() noexcept {
  guide_n_ = parameters_.guide->force_n(state_, period_s_);
  for (int i = 0; i < kNumContactPoints; ++i) {
    guide_n_[i] *= shares_[i] > 0.0 ? authority_ratio_ * point_authority_ratio_[i] : 0.0;
    force_on_hand_n_[i] += guide_n_[i];
  }
}

/// Returns the force without the guide's part, which is no energy of the medium. If the limiter
/// reduced both, the result is wrong by what it took away.
core::PointVectors HapticLoop::force_of_medium() const noexcept {
  core::PointVectors medium_n = force_on_hand_n_;
  for (int i = 0; parameters_.guide != nullptr && i < kNumContactPoints; ++i) {
    medium_n[i] -= guide_n_[i];
  }
  return medium_n;
}

void HapticLoop::warm() const noexcept {
  constexpr std::size_t kCacheLine = 64;
  // The part of the device that is likely to be its state.
  constexpr std::size_t kOfTheDevice = 4096;
  const auto fetch = [](const void* from, std::size_t size) {
    for (std::size_t i = 0; i < size; i += kCacheLine) {
      __builtin_prefetch(static_cast<const unsigned char*>(from) + i, 1);
    }
  };
  fetch(this, sizeof *this);
  fetch(&device_, kOfTheDevice);
  fetch(&exchange_.telemetry, sizeof exchange_.telemetry);
  core::PointVectors force_on_hand_n = core::zero_vectors();
  const core::HandMotion motion =
      core::hand_motion(state_.tip_position_m, state_.tip_velocity_m_per_s, state_.attached);
  core::add_up_fluid_force(ramp_.current(), parameters_.force_map, motion, shares_, state_,
                           immersed_bits_, 0.0, parameters_.fade_speed_m_per_s,
                           force_on_hand_n);
  core::PassivityController passivity = passivity_;
  passivity.control(state_.tip_position_m, state_.tip_velocity_m_per_s, force_on_hand_n);
  core::ForceLimiter limiter = limiter_;
  limiter.limit(state_.attached, state_.tip_velocity_m_per_s, force_on_hand_n);
}

/// The force persists while ticks are missed.
void HapticLoop::add_exposure() noexcept {
  constexpr double kFeltN = 0.1;
  double whole_n = 0.0;
  for (const Eigen::Vector3d& force_n : force_on_hand_n_) whole_n += force_n.norm();
  if (whole_n == 0.0) return;
  const double duration_s = elapsed_s();
  telemetry_.exposure.force_time_n_s += duration_s * whole_n;
  if (whole_n >= kFeltN) telemetry_.exposure.under_force_s += duration_s;
}

/// What a device tells may be late by some ticks, and so may be counted in what comes next.
void HapticLoop::count_forces() noexcept {
  bool is_moved = false, is_sent = false, acted = false, is_measured = false;
  for (int i = 0; i < kNumContactPoints; ++i) {
    is_moved |= state_.attached[i] && !state_.tip_velocity_m_per_s[i].isZero(0.0);
    is_sent |= !force_on_hand_n_[i].isZero(0.0);
    acted |= !state_.acted_n[i].isZero(0.0);
    is_measured |= state_.channels.force_n[i] != core::PlainVector{};
  }
  if (!tells_acted_) acted = is_sent;
  if (state_.channels.has(core::kMeasuredForce)) acted = acted && is_measured;
  core::ForceCounts& counts = telemetry_.force_counts;
  counts.num_held += attached_bits_ != 0 ? 1 : 0;
  counts.num_immersed += (attached_bits_ & immersed_bits_) != 0 ? 1 : 0;
  counts.num_moved += is_moved ? 1 : 0;
  counts.num_sent += is_sent ? 1 : 0;
  counts.num_acted += acted ? 1 : 0;
}

void HapticLoop::report() noexcept {
  const core::HapticCommand& command = exchange_.commands.value();
  core::Sample& sample = telemetry_.sample;
  sample.tick += 1 + num_missed_;
  sample.num_missed_before = num_missed_;
  sample.monotonic_ns = monotonic_ns_;
  sample.device_time_ns = state_.device_time_ns;
  sample.command_sequence = static_cast<std::uint32_t>(command.sequence);
  sample.attached_bits = attached_bits_;
  sample.immersed_bits = immersed_bits_;
  sample.limited = limited_ ? 1 : 0;
  sample.fault = static_cast<std::uint8_t>(fault_);
  Eigen::Vector3d position_sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < kNumContactPoints; ++i) {
    sample.tip_position_m[i] = plain(state_.tip_position_m[i]);
    sample.tip_velocity_m_per_s[i] = plain(state_.tip_velocity_m_per_s[i]);
    sample.tip_force_n[i] = plain(force_on_hand_n_[i]);
    if (shares_[i] > 0.0) position_sum += state_.tip_position_m[i];
    force_sum += force_on_hand_n_[i];
  }
  sample.end_effector_position_m = plain(state_.end_effector_position_m);
  if (has_joints_) {
    for (int i = 0; i < core::kNumJoints; ++i) {
      sample.joint_position_rad[i] = static_cast<float>(state_.joint_position_rad[i]);
      sample.joint_torque_n_m[i] = static_cast<float>(state_.joint_torque_n_m[i]);
    }
  }
  if (channels_ != 0) sample.channels = state_.channels;

  add_exposure();
  count_forces();
  guards_.end_tick(fault_ == Fault::kNone);
  flight_recorder_.record(sample);
  if (core::is_failure(fault_)) flight_recorder_.freeze();
  if (exchange_.samples != nullptr && !exchange_.samples->try_push(sample)) {
    telemetry_.num_dropped_samples = exchange_.samples->num_dropped();
  }

  ++telemetry_.num_ticks;
  telemetry_.num_missed_ticks += num_missed_;
  num_missed_ = 0;
  telemetry_.command_sequence = command.sequence;
  telemetry_.fault = fault_;
  telemetry_.arming = arming();
  telemetry_.enabled = state_.enabled;
  telemetry_.limited = limited_;
  telemetry_.warning = guards_.warning();
  telemetry_.guards = guards_.counts();
  telemetry_.ramp_finished = ramp_.finished();
  telemetry_.authority_ratio = authority_ratio_;
  telemetry_.hand_position_m = plain(position_sum / num_points_);
  telemetry_.hand_velocity_m_per_s = plain(motion_.velocity_m_per_s);
  telemetry_.total_force_n = plain(force_sum);
  if (limited_) ++telemetry_.num_limited_ticks;
  telemetry_.contact_sums = device_.contact_sums();
  telemetry_.device_clock = device_clock_.drift();
  telemetry_.arming_wait_s = std::max(0.0, core::kArmAfterRelease_s - since_release_s_);
  exchange_.telemetry.publish(telemetry_);
}

}  // namespace jnd::device
