#include "device/twin/twin_device.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/require.h"
#include "device/drawn_mass.h"

namespace jnd::device {
namespace {

using core::kNumContactPoints;

/// Distance between two places where the motors hold best.
constexpr double kCoggingPitch_m = 0.02;

double at_resolution(double value_m, double resolution_m) noexcept {
  return resolution_m > 0.0 ? resolution_m * std::round(value_m / resolution_m) : value_m;
}

}  // namespace

TwinDevice::TwinDevice(const Parameters& parameters)
    : parameters_(parameters),
      period_s_(core::period_s_at(parameters.rate_hz)),
      period_ns_(std::llround(1e9 / parameters.rate_hz)),
      num_steps_(std::max(1, static_cast<int>(std::lround(period_s_ / kStep_s)))),
      arm_(parameters.arm, period_s_),
      noise_(parameters.noise_seed, "twin") {
  using core::require_not_negative;
  using core::require_positive;
  core::require(parameters.mass_kg >= 0.1, "mass_kg", "a number >= 0.1", parameters.mass_kg);
  require_not_negative(parameters.hand_mass_kg, "hand_mass_kg");
  require_not_negative(parameters.damping_n_s_per_m, "damping_n_s_per_m");
  require_not_negative(parameters.friction_n, "friction_n");
  core::require(std::isfinite(parameters.weight_n), "weight_n", "a finite number",
                parameters.weight_n);
  require_positive(parameters.gain, "gain");
  require_not_negative(parameters.cogging_n, "cogging_n");
  core::require(parameters.delay_s >= 0.0 && parameters.delay_s <= 0.02, "delay_s",
                "a number from 0 to 0.02", parameters.delay_s);
  require_not_negative(parameters.position_sd_m, "position_sd_m");
  require_not_negative(parameters.position_resolution_m, "position_resolution_m");
  require_not_negative(parameters.velocity_sd_m_per_s, "velocity_sd_m_per_s");
  require_not_negative(parameters.touch_sd_m, "touch_sd_m");
  require_not_negative(parameters.homing_sd_m, "homing_sd_m");
  require_positive(parameters.max_force_per_point_n, "max_force_per_point_n");
  require_positive(parameters.max_total_force_n, "max_total_force_n");
  // The delay is rounded to the steps of the simulation.
  parameters_.delay_s = kStep_s * std::round(parameters.delay_s / kStep_s);
}

DeviceCapabilities TwinDevice::capabilities() const noexcept {
  return {.rate_hz = parameters_.rate_hz,
          .max_force_per_point_n = parameters_.max_force_per_point_n,
          .max_total_force_n = parameters_.max_total_force_n,
          .watchdog_timeout_s = 0.250,
          .simulated = true,
          .tells_acting_force = true,
          .moves_by_itself = true};
}

void TwinDevice::open() {
  arm_.reset();
  halt_.reset();
  bench_.reset();
  num_writes_ = 0;
  written_n_.fill(core::zero_vectors());
  acted_n_ = core::zero_vectors();
  position_m_ = arm_.arm().reference_m();
  velocity_m_per_s_.setZero();
  sums_ = {};
  last_hold_ = 0;
}

Eigen::Vector3d TwinDevice::noise(double sd) noexcept {
  if (sd == 0.0) return Eigen::Vector3d::Zero();
  const double x = noise_.normal(0.0, sd), y = noise_.normal(0.0, sd);
  return {x, y, noise_.normal(0.0, sd)};
}

bool TwinDevice::read(core::HapticState& state) noexcept {
  const Eigen::Matrix3d to_own = parameters_.rotation.transpose();
  const auto own = [&](const Eigen::Vector3d& place_m) -> Eigen::Vector3d {
    return to_own * (place_m - parameters_.offset_m);
  };
  // The error of the encoders is the same at every point of a stiff hand.
  const Eigen::Vector3d place_noise_m = noise(parameters_.position_sd_m);
  const Eigen::Vector3d told_m_per_s =
      to_own * velocity_m_per_s_ + noise(parameters_.velocity_sd_m_per_s);
  const core::PointVectors& tips_m = lumped_hand_tips_m();
  state.device_time_ns = num_writes_ * period_ns_;
  for (int i = 0; i < kNumContactPoints; ++i) {
    const Eigen::Vector3d place_m = own(position_m_ + tips_m[i]) + homed_m_ + place_noise_m;
    for (int axis = 0; axis < 3; ++axis) {
      state.tip_position_m[i][axis] =
          at_resolution(place_m[axis], parameters_.position_resolution_m);
    }
    state.tip_velocity_m_per_s[i] = told_m_per_s;
    state.acted_n[i] = to_own * acted_n_[i];
    state.attached[i] = true;
  }
  state.end_effector_position_m = own(position_m_ - Eigen::Vector3d(0.0, 0.12, 0.0));
  return true;
}

const core::PointVectors& TwinDevice::acting_n(double time_s) const noexcept {
  static const core::PointVectors kNothing = core::zero_vectors();
  // Write i came at the time of i periods, and the last one is `num_writes_`.
  const double told_s = time_s - parameters_.delay_s;
  const auto write = static_cast<std::int64_t>(std::floor(told_s / period_s_ + 1e-6));
  if (write < 0) return kNothing;
  return written_n_[static_cast<std::size_t>(write) % kNumWrites];
}

Eigen::Vector3d TwinDevice::cogging_n() const noexcept {
  if (parameters_.cogging_n == 0.0) return Eigen::Vector3d::Zero();
  Eigen::Vector3d force_n;
  for (int axis = 0; axis < 3; ++axis) {
    force_n[axis] = parameters_.cogging_n *
                    std::sin(2.0 * std::numbers::pi * position_m_[axis] / kCoggingPitch_m);
  }
  return force_n;
}

bool TwinDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  arm_.follow_orders();
  const BenchState& done = bench_.newest();
  if (done.num_homings != last_homing_) {
    last_homing_ = done.num_homings;
    homed_m_ = noise(parameters_.homing_sd_m);
  }
  core::PointVectors& written_n =
      written_n_[static_cast<std::size_t>(num_writes_) % kNumWrites];
  const bool is_withheld = halt_.withholds(force_on_hand_n);
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (is_withheld) {
      written_n[i].setZero();
    } else {
      written_n[i].noalias() = parameters_.rotation * force_on_hand_n[i];
    }
  }
  arm_.advance();
  acted_n_ = core::zero_vectors();
  Eigen::Vector3d rendered_n = Eigen::Vector3d::Zero();
  for (int step = 0; step < num_steps_; ++step) {
    const double time_s = static_cast<double>(num_writes_) * period_s_ + step * kStep_s;
    const core::PointVectors& acting = acting_n(time_s);
    const Eigen::Vector3d given_n = parameters_.gain * total_of(acting);
    move(done, given_n);
    rendered_n += given_n / num_steps_;
    for (int i = 0; i < kNumContactPoints; ++i) acted_n_[i] += acting[i] / num_steps_;
  }
  feel(rendered_n);
  ++num_writes_;
  return true;
}

void TwinDevice::move(const BenchState& done, const Eigen::Vector3d& force_n) noexcept {
  if (done.is_clamped || done.is_touching) {
    velocity_m_per_s_.setZero();
    if (!done.is_touching) return;
    if (done.num_holds != last_hold_) {
      last_hold_ = done.num_holds;
      touched_m_ = Eigen::Vector3d(done.mark_m[0], done.mark_m[1], done.mark_m[2]) +
                   noise(parameters_.touch_sd_m) - lumped_hand_tips_m().front();
    }
    // The hand is carried to the mark at a pace that does not look like a jump.
    constexpr double kCarrying_m_per_s = 0.3;
    const Eigen::Vector3d way_m = touched_m_ - position_m_;
    const double way_now_m = std::min(way_m.norm(), kCarrying_m_per_s * kStep_s);
    if (way_now_m > 0.0) {
      velocity_m_per_s_ = way_m.normalized() * (way_now_m / kStep_s);
      position_m_ += velocity_m_per_s_ * kStep_s;
    }
    return;
  }
  const double in_it_kg = done.has_hand ? parameters_.hand_mass_kg : 0.0;
  const double mass_kg = parameters_.mass_kg + in_it_kg + done.load_kg;
  constexpr double kGravity_m_per_s2 = 9.80665;
  Eigen::Vector3d whole_n = force_n + cogging_n();
  whole_n.z() -= parameters_.weight_n + kGravity_m_per_s2 * done.load_kg;
  // A hand carries its own weight.
  if (done.has_hand) whole_n += arm_.arm().force_n(position_m_, velocity_m_per_s_);

  // Damping follows the trapezoidal rule, which does not change the mass. Then friction is
  // subtracted, at most until the mass stands still.
  const double damped = 0.5 * kStep_s * parameters_.damping_n_s_per_m / mass_kg;
  Eigen::Vector3d next_m_per_s =
      ((1.0 - damped) * velocity_m_per_s_ + (kStep_s / mass_kg) * whole_n) / (1.0 + damped);
  const double stopped_m_per_s = kStep_s * parameters_.friction_n / mass_kg;
  const double speed_m_per_s = next_m_per_s.norm();
  next_m_per_s = speed_m_per_s > stopped_m_per_s
                     ? Eigen::Vector3d(next_m_per_s * (1.0 - stopped_m_per_s / speed_m_per_s))
                     : Eigen::Vector3d::Zero();
  position_m_ += 0.5 * kStep_s * (velocity_m_per_s_ + next_m_per_s);
  velocity_m_per_s_ = next_m_per_s;
}

/// Adds up what a hand feels: the rendered force, and everything by which the device itself
/// opposes it.
void TwinDevice::feel(const Eigen::Vector3d& rendered_n) noexcept {
  const double speed_m_per_s = velocity_m_per_s_.norm();
  const double opposing_n =
      speed_m_per_s > 0.0 ? -rendered_n.dot(velocity_m_per_s_) / speed_m_per_s : 0.0;
  const double own_n = speed_m_per_s > 0.0 ? parameters_.damping_n_s_per_m * speed_m_per_s +
                                                 parameters_.friction_n
                                           : 0.0;
  ++sums_.num_ticks;
  sums_.rendered_opposing_n += opposing_n;
  sums_.opposing_n += opposing_n + own_n;
  sums_.speed_m_per_s += speed_m_per_s;
}

}  // namespace jnd::device
