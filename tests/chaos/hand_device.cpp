#include "chaos/hand_device.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace jnd::chaos {
namespace {

constexpr double kStep_s = 0.001;
constexpr double kDepth_m = 0.15;
constexpr double kMostOfPerson_n = 25.0;
constexpr int kZeroesAfter_ms = 20;

/// Returns the places of the points of a hand at the origin.
core::PointVectors points_m() {
  return {Eigen::Vector3d(0.0, -0.061, 0.03), Eigen::Vector3d(0.0, -0.061, -0.03),
          Eigen::Vector3d(0.0, 0.0, 0.05), Eigen::Vector3d(0.0, 0.059, 0.03),
          Eigen::Vector3d(0.0, 0.064, 0.01)};
}

std::size_t slot(int at_ms, int num_slots) {
  return static_cast<std::size_t>(std::max(0, at_ms) % num_slots);
}

Eigen::Vector3d total_n(const core::PointVectors& forces_n) {
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& force_n : forces_n) total += force_n;
  return total;
}

/// Returns a field of the measurement. Fields 0 to 11 are the axes of the position, the
/// velocity, the end effector and the acting force.
double& field_of(core::HapticState& state, int field, int point) {
  const int axis = field % 3;
  switch (field / 3) {
    case 0:
      return state.tip_position_m[point][axis];
    case 1:
      return state.tip_velocity_m_per_s[point][axis];
    case 2:
      return state.end_effector_position_m[axis];
    default:
      return state.acted_n[point][axis];
  }
}

}  // namespace

HandDevice::HandDevice(const Schedule& schedule, Oracle& oracle)
    : schedule_(schedule), oracle_(oracle), position_m_(0.0, 0.0, -kDepth_m) {
  sent_n_.fill(core::zero_vectors());
  remember(core::zero_vectors());
  measured_.fill(measured_[0]);
  frozen_ = measured_[0];
}

int HandDevice::lateness_ms(int always_ms, Trouble what) const {
  const Event* event = schedule_.on(what, now_ms_);
  return std::min(kHistory_ms - 1,
                  always_ms + (event == nullptr ? 0 : static_cast<int>(event->size)));
}

/// Returns the force of a spring and a damper that pull the hand to where the person wants it.
/// It is no stronger than an arm.
Eigen::Vector3d HandDevice::force_of_person_n() const {
  constexpr double kStiffness_n_per_m = 100.0;
  const double damping_n_s_per_m = 1.4 * std::sqrt(kStiffness_n_per_m * schedule_.hand_mass_kg);
  const double turn_hz = 2.0 * std::numbers::pi * schedule_.stroke_hz;
  const double phase = turn_hz * kStep_s * now_ms_;
  const Eigen::Vector3d wanted_m(schedule_.stroke_m * std::sin(phase),
                                 0.3 * schedule_.stroke_m * std::cos(phase), -kDepth_m);
  const Eigen::Vector3d wanted_m_per_s =
      turn_hz * Eigen::Vector3d(schedule_.stroke_m * std::cos(phase),
                                -0.3 * schedule_.stroke_m * std::sin(phase), 0.0);
  const Eigen::Vector3d force_n = kStiffness_n_per_m * (wanted_m - position_m_) +
                                  damping_n_s_per_m * (wanted_m_per_s - velocity_m_per_s_);
  return force_n.norm() > kMostOfPerson_n ? (kMostOfPerson_n / force_n.norm() * force_n).eval()
                                          : force_n;
}

void HandDevice::pass_millisecond(int now_ms) {
  now_ms_ = now_ms;
  zero_by_itself();
  sent_n_[slot(now_ms_, kHistory_ms)] = standing_n_;
  const int late_ms = lateness_ms(schedule_.force_late_ms, Trouble::kForceLate);
  const core::PointVectors& acted_n = sent_n_[slot(now_ms_ - late_ms, kHistory_ms)];
  // This step is exact for a force that stays constant for a millisecond.
  const Eigen::Vector3d before_m_per_s = velocity_m_per_s_;
  velocity_m_per_s_ +=
      kStep_s / schedule_.hand_mass_kg * (total_n(acted_n) + force_of_person_n());
  const Eigen::Vector3d way_m = 0.5 * kStep_s * (before_m_per_s + velocity_m_per_s_);
  position_m_ += way_m;
  oracle_.moved(acted_n, way_m);
  remember(acted_n);
}

/// Does what SAFETY.md requires of a real device's own controller. It ends the force by its own
/// clock, and the force comes back only after zeros.
void HandDevice::zero_by_itself() {
  if (schedule_.zeroes_by_itself && now_ms_ - last_write_ms_ >= kZeroesAfter_ms) {
    take_force_away();
  }
}

void HandDevice::take_force_away() {
  is_halted_ = true;
  standing_n_ = core::zero_vectors();
  oracle_.zeroed();
}

void HandDevice::remember(const core::PointVectors& acted_n) {
  const double ratio =
      schedule_.filter_hz > 0.0
          ? 1.0 - std::exp(-2.0 * std::numbers::pi * schedule_.filter_hz * kStep_s)
          : 1.0;
  filtered_m_per_s_ += ratio * (velocity_m_per_s_ - filtered_m_per_s_);
  core::HapticState& state = measured_[slot(now_ms_, kHistory_ms)];
  state = {};
  state.tip_position_m = points_m();
  for (Eigen::Vector3d& point_m : state.tip_position_m) point_m += position_m_;
  state.tip_velocity_m_per_s.fill(filtered_m_per_s_);
  state.acted_n = acted_n;
  state.end_effector_position_m = position_m_;
}

bool HandDevice::read(core::HapticState& state) noexcept {
  if (is_unplugged() || is_on(Trouble::kReadsFail)) {
    oracle_.could_not_be_read();
    if (after_read) after_read();
    return false;
  }
  const int late_ms = lateness_ms(schedule_.reading_late_ms, Trouble::kReadingLate);
  state = measured_[slot(now_ms_ - late_ms, kHistory_ms)];
  // If a reading comes late, its device time nevertheless goes on, which hides the lateness.
  state.device_time_ns = std::int64_t{1'000'000} * now_ms_;
  spoil(state);
  oracle_.handed_out(state);
  frozen_ = state;
  if (after_read) after_read();
  return true;
}

/// A frozen reading repeats what was handed out last, whether that was spoilt or not.
void HandDevice::spoil(core::HapticState& state) const {
  if (is_on(Trouble::kReadingFreezes)) {
    state = frozen_;
    return;
  }
  if (is_on(Trouble::kPositionsFreeze)) state.tip_position_m = frozen_.tip_position_m;
  if (is_on(Trouble::kVelocitySign)) {
    for (Eigen::Vector3d& velocity : state.tip_velocity_m_per_s) velocity = -velocity;
  }
  if (const Event* event = schedule_.on(Trouble::kPointComesOff, now_ms_)) {
    state.attached[static_cast<std::size_t>(event->point)] = false;
  }
  if (const Event* event = schedule_.on(Trouble::kLeap, now_ms_)) {
    state.tip_position_m[static_cast<std::size_t>(event->point)].x() += event->size;
  }
  if (const Event* event = schedule_.on(Trouble::kTooFast, now_ms_)) {
    state.tip_velocity_m_per_s[static_cast<std::size_t>(event->point)].y() += event->size;
  }
  if (const Event* event = schedule_.on(Trouble::kNoNumber, now_ms_)) {
    field_of(state, event->field, event->point) = std::nan("");
  }
  if (const Event* event = schedule_.on(Trouble::kInfinity, now_ms_)) {
    field_of(state, event->field, event->point) = std::numeric_limits<double>::infinity();
  }
}

bool HandDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  if (is_unplugged()) return false;
  if (is_on(Trouble::kWritesFail)) {
    oracle_.written(standing_n_, false);
    return false;
  }
  last_write_ms_ = now_ms_;
  const bool is_zero = std::ranges::all_of(
      force_on_hand_n, [](const Eigen::Vector3d& force_n) { return force_n.isZero(0.0); });
  if (is_zero) is_halted_ = false;
  standing_n_ = is_halted_ ? core::zero_vectors() : force_on_hand_n;
  oracle_.written(standing_n_, true);
  return true;
}

void HandDevice::halt() noexcept {
  if (!is_unplugged()) take_force_away();
}

}  // namespace jnd::chaos
