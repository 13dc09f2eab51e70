#include "device/pointer_guide.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::device {
namespace {

constexpr double kUsualIntervalS = 1.0 / 60.0;
/// A pointer that was silent for longer has rested, so the gap tells nothing about its rhythm.
constexpr double kLongestIntervalS = 0.050;

}  // namespace

PointerGuide::PointerGuide(const Parameters& parameters, double period_s)
    : parameters_(parameters),
      period_s_(period_s),
      decay_ratio_(std::exp(-parameters.bandwidth_rad_per_s * period_s)),
      interval_ticks_(kUsualIntervalS / period_s) {
  core::require_positive(parameters.bandwidth_rad_per_s, "bandwidth_rad_per_s");
  core::require_positive(parameters.max_speed_m_per_s, "max_speed_m_per_s");
  core::require_positive(parameters.reach_m, "reach_m");
  core::require_positive(period_s, "period_s");
}

void PointerGuide::take(const core::PointerPosition& pointer) noexcept {
  last_sequence_ = pointer.sequence;
  if (!std::isfinite(pointer.x_m + pointer.y_m)) return;
  const double reach_m = parameters_.reach_m;
  goal_m_ = {std::clamp(pointer.x_m, -reach_m, reach_m),
             std::clamp(pointer.y_m, -reach_m, reach_m)};
  const auto since_last = static_cast<double>(ticks_since_last_);
  if (since_last * period_s_ <= kLongestIntervalS) {
    // The interval is smoothed, because a window reads events in bursts between two frames.
    interval_ticks_ += 0.25 * (since_last - interval_ticks_);
  }
  ticks_since_last_ = 0;
  line_step_m_ = std::min((goal_m_ - line_m_).norm() / std::max(1.0, interval_ticks_),
                          parameters_.max_speed_m_per_s * period_s_);
}

void PointerGuide::advance(const core::PointerPosition& pointer) noexcept {
  ++ticks_since_last_;
  if (pointer.sequence != last_sequence_) take(pointer);
  const Eigen::Vector2d way_m = goal_m_ - line_m_;
  const double left_m = way_m.norm();
  if (left_m <= line_step_m_) {
    line_m_ = goal_m_;
  } else {
    line_m_ += (line_step_m_ / left_m) * way_m;
  }
  // This is the exact solution of the filter over one period in which the line stands still.
  const double bandwidth = parameters_.bandwidth_rad_per_s;
  const Eigen::Vector2d away_m = position_m_ - line_m_;
  const Eigen::Vector2d slope_m_per_s = velocity_m_per_s_ + bandwidth * away_m;
  position_m_ = line_m_ + decay_ratio_ * (away_m + period_s_ * slope_m_per_s);
  velocity_m_per_s_ =
      decay_ratio_ * (velocity_m_per_s_ - (bandwidth * period_s_) * slope_m_per_s);
}

}  // namespace jnd::device
