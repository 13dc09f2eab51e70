#include "chaos/oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace jnd::chaos {
namespace {

constexpr double kMostPerPoint_n = 10.0;
constexpr double kMostInAll_n = 30.0;
constexpr double kMostStep_n = 2.0;  ///< The limit holds for one millisecond.
constexpr double kRounding = 1e-6;

// SAFETY.md.
constexpr int kLoopIsDead_ms = 22;        ///< 20 ms and one look of the watchdog.
constexpr int kHeartbeatIsLost_ms = 351;  ///< 250 ms, the fading of 100 ms, and a tick.
constexpr int kStale_ms = 5;              ///< For which a reading may stand in.
constexpr int kStaleByNet_ms = 20;        ///< The same bound across a network.
constexpr double kStuckWay_m = 0.004;  ///< By its velocity, of a point that stands still: 3 mm,
                                       ///< and one for what the network swallows.
constexpr int kQuietNetwork_ms = 2;    ///< A command's way, in the ticks of both sides.
constexpr int kDisturbedNetwork_ms = 45;   ///< No force answers to a state older than 40 ms.
constexpr int kDisturbanceLasts_ms = 120;  ///< What was on the way may come as late.

constexpr const char* kBrokenMedium = "the medium was no number";

double total_of_norms_n(const core::PointVectors& forces_n) {
  double total_n = 0.0;
  for (const Eigen::Vector3d& force_n : forces_n) total_n += force_n.norm();
  return total_n;
}

bool is_a_number(const core::HapticState& state) {
  bool finite = state.end_effector_position_m.allFinite();
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    finite &= state.tip_position_m[i].allFinite() &&
              state.tip_velocity_m_per_s[i].allFinite() && state.acted_n[i].allFinite();
  }
  return finite;
}

std::string in_text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

}  // namespace

Oracle::Oracle(const Schedule& schedule) : schedule_(schedule) {}

void Oracle::armed() {
  // Nobody arms against a stop, nor with the click that released it. Else all that went wrong
  // before is forgotten.
  if (stop_is_pressed_ || now_ms_ - released_ms_ < kArmAfterRelease_ms) return;
  may_have_force_ = true;
  revocations_.clear();
  num_stuck_readings_ = 0;
  stuck_way_m_.fill(0.0);
  last_reading_.reset();
  given_j_ = 0.0;
}

void Oracle::disarmed() { revoke("the device was disarmed", Way::kLoop); }

void Oracle::stop_pressed() {
  stop_is_pressed_ = true;
  revoke("the stop was pressed", Way::kLoop);
}

void Oracle::stop_released() {
  // Where none was pressed there is nothing to wait for.
  if (stop_is_pressed_) released_ms_ = now_ms_;
  stop_is_pressed_ = false;
}

void Oracle::window_beat() {
  last_beat_ms_ = now_ms_;
  silent_ms_ = 0;
  longest_gap_ms_ = 0;
}

/// One that is replaced before the loop has looked never was.
void Oracle::medium_sent(bool is_broken) {
  medium_is_broken_ = is_broken;
  if (is_broken) return;
  std::erase_if(revocations_,
                [](const Revocation& known) { return known.cause == kBrokenMedium; });
}

void Oracle::loop_ticked() {
  dead_ms_ = 0;
  longest_gap_ms_ = std::max(longest_gap_ms_, now_ms_ - last_tick_ms_ - 1);
  last_tick_ms_ = now_ms_;
  silent_ms_ = now_ms_ - last_beat_ms_;
}

/// A new program knows of no arming before its own.
void Oracle::program_started() {
  dead_ms_ = 0;
  last_tick_ms_ = now_ms_;
  window_beat();
  medium_is_broken_ = false;
  revoke("nobody has armed the device since its program was started", Way::kDevice);
}

void Oracle::server_restarted() {
  revoke("nobody has armed the device since its server was started", Way::kDevice);
}

void Oracle::revoke(const std::string& cause, Way way) {
  for (const Revocation& known : revocations_) {
    if (known.cause == cause) return;
  }
  if (!is_networked() || way == Way::kDevice) {
    revocations_.push_back({cause, now_ms_ + kLoopIsDead_ms, true});
    return;
  }
  const bool is_disturbed = schedule_.is_disturbed(now_ms_ - kDisturbanceLasts_ms, now_ms_ + 5);
  const int within_ms = is_disturbed ? kDisturbedNetwork_ms : kQuietNetwork_ms;
  revocations_.push_back({cause, now_ms_ + within_ms, false});
}

void Oracle::revoke_at_once(const std::string& cause) {
  revocations_.push_back({cause, now_ms_, false});
}

void Oracle::could_not_be_read() { revoke("the device could not be read", Way::kDevice); }

void Oracle::handed_out(const core::HapticState& state) {
  if (!is_a_number(state)) return revoke("a measurement was no number", Way::kDevice);
  attached_ = state.attached;
  if (!last_reading_) last_new_ms_ = now_ms_;
  if (last_reading_) {
    judge_staleness(state);
    judge_leaps(state);
    judge_speeds(state);
  }
  last_reading_ = state;
}

void Oracle::judge_staleness(const core::HapticState& state) {
  const bool is_stale = state.device_time_ns <= last_reading_->device_time_ns;
  if (!is_stale) last_new_ms_ = now_ms_;
  const int most = is_networked() ? kStaleByNet_ms : kStale_ms;
  if (now_ms_ - last_new_ms_ > most) revoke("measurements stood still", Way::kLoop);
  if (is_stale) return;
  // Such a point moves according to its own velocity, and yet is where it was.
  bool any_stands = false;
  double most_way_m = 0.0;
  for (std::size_t i = 0; i < stuck_way_m_.size(); ++i) {
    const bool stands = state.attached[i] && last_reading_->attached[i] &&
                        state.tip_velocity_m_per_s[i].norm() > 0.05 &&
                        state.tip_position_m[i] == last_reading_->tip_position_m[i];
    stuck_way_m_[i] =
        stands ? stuck_way_m_[i] + 0.001 * state.tip_velocity_m_per_s[i].norm() : 0.0;
    any_stands |= stands;
    most_way_m = std::max(most_way_m, stuck_way_m_[i]);
  }
  num_stuck_readings_ = any_stands ? num_stuck_readings_ + 1 : 0;
  if (num_stuck_readings_ > most && most_way_m > kStuckWay_m) {
    revoke("positions stood still", Way::kLoop);
  }
}

/// This judges a point that was held before and still is. A lossy network may show nothing of a
/// leap.
void Oracle::judge_leaps(const core::HapticState& state) {
  if (is_networked() &&
      schedule_.is_disturbed(now_ms_ - kDisturbanceLasts_ms, now_ms_ + kDisturbanceLasts_ms)) {
    return;
  }
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    const double way_m = (state.tip_position_m[i] - last_reading_->tip_position_m[i]).norm();
    if (state.attached[i] && last_reading_->attached[i] && way_m > 0.15) {
      return revoke("a point leapt", Way::kLoop);
    }
  }
}

void Oracle::judge_speeds(const core::HapticState& state) {
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (state.attached[i] && state.tip_velocity_m_per_s[i].norm() > 5.0 + kRounding) {
      return revoke("a point was faster than 5 m/s", Way::kDevice);
    }
  }
}

void Oracle::written(const core::PointVectors& standing_n, bool was_taken) {
  was_written_ = true;
  for (Revocation& revocation : revocations_) {
    if (revocation.ends_with_next_write) revocation.deadline_ms = now_ms_;
  }
  if (!was_taken) revoke_at_once("the device did not take a write");
  judge_write(standing_n);
  standing_n_ = standing_n;
}

void Oracle::judge_write(const core::PointVectors& standing_n) {
  double total_n = 0.0;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    const Eigen::Vector3d& force_n = standing_n[i];
    if (!force_n.allFinite()) return violated("a force is no number");
    total_n += force_n.norm();
    if (force_n.norm() > kMostPerPoint_n + kRounding) {
      return violated(in_text(force_n.norm()) + " N at one point");
    }
    if (!attached_[i] && !force_n.isZero(0.0)) {
      return violated("force at a point that holds no hand");
    }
    const double step_n = (force_n - standing_n_[i]).norm();
    if (step_n > kMostStep_n + kRounding && !force_n.isZero(0.0)) {
      return violated("a step of " + in_text(step_n) + " N");
    }
  }
  if (total_n > kMostInAll_n + kRounding) violated(in_text(total_n) + " N in all");
}

void Oracle::moved(const core::PointVectors& acted_n, const Eigen::Vector3d& way_m) {
  constexpr double kMemory_ms = 250.0;
  double work_j = 0.0;
  for (const Eigen::Vector3d& force_n : acted_n) work_j += force_n.dot(way_m);
  given_j_ = std::max(0.0, given_j_ * std::exp(-1.0 / kMemory_ms) + work_j);
  most_given_j_ = std::max(most_given_j_, given_j_);
  if (given_j_ > most_energy_j(schedule_)) {
    violated("the hand was given " + in_text(given_j_) + " J, at most " +
             in_text(most_energy_j(schedule_)) + " J are due");
  }
}

void Oracle::begin_millisecond(int now_ms) {
  judge_silences();
  judge_force();
  now_ms_ = now_ms;
  was_written_ = false;
  ++dead_ms_;
  const bool is_cut = schedule_.on(Trouble::kUnplugged, now_ms) != nullptr;
  cut_ms_ = is_cut ? cut_ms_ + 1 : 0;
}

/// Judges the troubles that are noticed only because they last.
void Oracle::judge_silences() {
  const bool may_be_late =
      is_networked() && schedule_.has_late_datagrams(now_ms_ - kDisturbanceLasts_ms, now_ms_);
  const int link_ms = kLoopIsDead_ms + (may_be_late ? kDisturbedNetwork_ms : 0);
  if (dead_ms_ > link_ms) revoke_at_once("the loop was dead");
  if (cut_ms_ > link_ms) revoke_at_once("the device was unplugged");
  // The loop sees the silence, and ends the fading, in the tick after a gap.
  if (silent_ms_ > kHeartbeatIsLost_ms + 2 * longest_gap_ms_)
    revoke("the window was silent", Way::kLoop);
  if (medium_is_broken_) revoke(kBrokenMedium, Way::kLoop);
}

void Oracle::judge_force() {
  for (Revocation& revocation : revocations_) {
    // While the server stands still, no command counts and none grows old; then the device ends
    // the force by itself.
    if (is_networked() && !was_written_ && !revocation.ends_with_next_write) {
      ++revocation.deadline_ms;
    }
    if (now_ms_ < revocation.deadline_ms) continue;
    may_have_force_ = false;
    why_not_ = revocation.cause;
  }
  std::erase_if(revocations_,
                [&](const Revocation& known) { return now_ms_ >= known.deadline_ms; });
  const double total_n = total_of_norms_n(standing_n_);
  if (total_n > 0.0) ++num_with_force_;
  if (!may_have_force_ && total_n > 0.0) {
    violated(in_text(total_n) + " N although " + why_not_);
  }
}

void Oracle::violated(const std::string& what) {
  if (violation_.empty()) violation_ = std::to_string(now_ms_) + " ms: " + what;
}

double most_energy_j(const Schedule& schedule) {
  constexpr double kPromptly_j = 0.25;
  constexpr double kPush_n = 20.0;
  constexpr double kTicksOfBothSides_s = 0.002;
  const int late_ms =
      schedule.most_late_ms() + (schedule.may_let_a_force_stand() ? kLoopIsDead_ms : 0);
  if (late_ms == 0) return kPromptly_j;
  const double filter_s =
      schedule.filter_hz > 0.0 ? 1.0 / (2.0 * std::numbers::pi * schedule.filter_hz) : 0.0;
  const double late_s = 0.001 * late_ms + filter_s + kTicksOfBothSides_s;
  const double momentum_n_s = kPush_n * late_s;
  return kPromptly_j + momentum_n_s * momentum_n_s / (2.0 * schedule.hand_mass_kg);
}

}  // namespace jnd::chaos
