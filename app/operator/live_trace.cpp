#include "app/operator/live_trace.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/require.h"

namespace jnd::app {
namespace {

core::PlainVector sum_of(const std::array<core::PlainVector, core::kNumContactPoints>& tips) {
  core::PlainVector sum{};
  for (const core::PlainVector& tip : tips) {
    for (std::size_t axis = 0; axis < sum.size(); ++axis) sum[axis] += tip[axis];
  }
  return sum;
}

double length_of(const core::PlainVector& vector) {
  return std::hypot(vector[0], vector[1], vector[2]);
}

}  // namespace

LiveTrace::LiveTrace(const Parameters& parameters) : parameters_(parameters) {
  core::require_positive(parameters.rate_hz, "rate_hz");
  core::require_positive(parameters.duration_s, "duration_s");
  core::require_positive(parameters.points_per_s, "points_per_s");
  ticks_per_point_ =
      std::max<std::int64_t>(1, std::llround(parameters.rate_hz / parameters.points_per_s));
  const double point_s = static_cast<double>(ticks_per_point_) / parameters.rate_hz;
  capacity_ = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(parameters.duration_s / point_s)));
  ring_.reserve(capacity_);
}

void LiveTrace::take(const core::Sample& sample) {
  const double num_points = core::num_measured_points(sample);
  const core::PlainVector position_m = sum_of(sample.tip_position_m);
  const double speed_m_per_s = length_of(sum_of(sample.tip_velocity_m_per_s)) / num_points;
  const double force_n = length_of(sum_of(sample.tip_force_n));
  if (!std::isfinite(length_of(position_m) + speed_m_per_s + force_n)) return;

  const std::lock_guard guard(mutex_);
  const std::int64_t interval = sample.tick / ticks_per_point_;
  if (has_current_ && interval < interval_) start_anew();
  if (has_current_ && interval != interval_) finish_interval();
  if (!has_current_) {
    has_current_ = true;
    interval_ = interval;
    current_ = {.time_s =
                    static_cast<double>(interval * ticks_per_point_) / parameters_.rate_hz};
  }
  current_.x_m = position_m[0] / num_points;
  current_.y_m = position_m[1] / num_points;
  current_.z_m = position_m[2] / num_points;
  current_.speed_m_per_s = std::max(current_.speed_m_per_s, speed_m_per_s);
  current_.force_n = std::max(current_.force_n, force_n);
}

void LiveTrace::finish_interval() {
  if (ring_.size() < capacity_) {
    ring_.push_back(current_);
  } else {
    ring_[next_] = current_;
    next_ = (next_ + 1) % capacity_;
  }
  has_current_ = false;
}

void LiveTrace::start_anew() {
  ring_.clear();
  next_ = 0;
  has_current_ = false;
}

void LiveTrace::clear() {
  const std::lock_guard guard(mutex_);
  start_anew();
}

std::vector<TracePoint> LiveTrace::snapshot() const {
  std::vector<TracePoint> points;
  points.reserve(capacity_);
  const std::lock_guard guard(mutex_);
  const double oldest_s = (ring_.empty() ? 0.0 : newest().time_s) - parameters_.duration_s;
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const TracePoint& point = ring_[(next_ + i) % ring_.size()];
    if (point.time_s > oldest_s) points.push_back(point);
  }
  return points;
}

const TracePoint& LiveTrace::newest() const {
  return ring_[(next_ + ring_.size() - 1) % ring_.size()];
}

}  // namespace jnd::app
