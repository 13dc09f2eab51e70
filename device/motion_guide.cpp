#include "device/motion_guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jnd::device {
namespace {

Eigen::Vector3d vector_of(const std::array<double, 3>& numbers) noexcept {
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

double sweep_at(std::int64_t tick, int num_ticks) noexcept {
  const auto k = static_cast<double>(tick % num_ticks);
  return std::cos(0.5 * std::numbers::pi * k * k / static_cast<double>(num_ticks));
}

Eigen::Vector3d MotionGuide::mean_m(const core::HapticState& state) const noexcept {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  int num_points = 0;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    if (shares_[i] <= 0.0) continue;
    sum_m += state.tip_position_m[i];
    ++num_points;
  }
  return num_points > 0 ? Eigen::Vector3d(sum_m / num_points) : sum_m;
}

void MotionGuide::take_order(const core::HapticState& state) noexcept {
  const bool was_held = orders_.value().is_on && orders_.value().stiffness_n_per_m > 0.0;
  if (!orders_.fetch()) return;
  num_ticks_ = 0;
  if (!was_held || !has_reference_) {
    // The reference starts where the device is, so that nothing jumps.
    reference_m_ = mean_m(state);
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      from_mean_m_[i] = state.tip_position_m[i] - reference_m_;
    }
    has_reference_ = true;
  }
  begun_m_ = reference_m_;
}

Eigen::Vector3d MotionGuide::move_reference(double period_s) noexcept {
  const Order& order = orders_.value();
  Eigen::Vector3d speed_m_per_s = Eigen::Vector3d::Zero();
  if (!(order.stiffness_n_per_m > 0.0)) return speed_m_per_s;
  const Eigen::Vector3d to_m = vector_of(order.to_m);
  if (order.is_smooth) {
    const Eigen::Vector3d whole_m = to_m - begun_m_;
    const double duration_s = whole_m.norm() / order.speed_m_per_s;
    if (!(duration_s > period_s)) {
      if (duration_s <= period_s) reference_m_ = to_m;
      return speed_m_per_s;
    }
    const double s = std::min(1.0, static_cast<double>(num_ticks_ + 1) * period_s / duration_s);
    reference_m_ = begun_m_ + s * s * s * (10.0 + s * (6.0 * s - 15.0)) * whole_m;
    speed_m_per_s = 30.0 * s * s * (1.0 - s) * (1.0 - s) / duration_s * whole_m;
    return speed_m_per_s;
  }
  const Eigen::Vector3d way_m = to_m - reference_m_;
  const double way_left_m = way_m.norm();
  const double step_m = std::min(way_left_m, order.speed_m_per_s * period_s);
  if (step_m > 0.0) {
    reference_m_ += way_m * (step_m / way_left_m);
    speed_m_per_s = way_m * (step_m / (way_left_m * period_s));
  }
  return speed_m_per_s;
}

core::PointVectors MotionGuide::force_n(const core::HapticState& state,
                                        double period_s) noexcept {
  take_order(state);
  core::PointVectors force_n = core::zero_vectors();
  const Order& order = orders_.value();
  if (!order.is_on || !has_reference_) return force_n;

  const Eigen::Vector3d speed_m_per_s = move_reference(period_s);
  Eigen::Vector3d pulse_n = Eigen::Vector3d::Zero();
  if (order.pulse_period_s > 0.0) {
    const double phase = static_cast<double>(num_ticks_) * period_s / order.pulse_period_s;
    pulse_n = (phase - std::floor(phase) < 0.5 ? 1.0 : -1.0) * vector_of(order.pulse_n);
  }
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    if (shares_[i] <= 0.0) continue;
    const Eigen::Vector3d off_m = reference_m_ + from_mean_m_[i] - state.tip_position_m[i];
    force_n[i] =
        shares_[i] *
        (order.stiffness_n_per_m * off_m +
         order.damping_n_s_per_m * (speed_m_per_s - state.tip_velocity_m_per_s[i]) + pulse_n);
  }
  const auto swept = static_cast<std::size_t>(order.sweep_point);
  if (order.sweep_n != 0.0 && order.sweep_ticks > 0 && swept < shares_.size() &&
      shares_[swept] > 0.0) {
    force_n[swept][std::clamp(order.sweep_axis, 0, 2)] +=
        order.sweep_n * sweep_at(num_ticks_, order.sweep_ticks);
  }
  ++num_ticks_;
  return force_n;
}

}  // namespace jnd::device
