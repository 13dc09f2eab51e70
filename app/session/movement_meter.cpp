#include "app/session/movement_meter.h"

#include <Eigen/Core>
#include <bit>

namespace jnd::app {

void MovementMeter::start() noexcept {
  (void)strokes_.finish();
  (void)lag_.finish();
  sums_ = {};
}

core::PresentationMeasures MovementMeter::finish() noexcept {
  const analysis::StrokeSummary strokes = strokes_.finish();
  return {.num_strokes = strokes.num_strokes,
          .stroke_width_m = strokes.stroke_width_m,
          .max_speed_m_per_s = strokes.max_speed_m_per_s,
          .mean_height_m = strokes.mean_height_m,
          .finger_lag_s = lag_.finish()};
}

/// Uses the points that the device has.
void MovementMeter::feed_lag(const core::Sample& sample) noexcept {
  constexpr int kNumPalmPoints = 2;
  constexpr unsigned kPalmBits = 0b00011;
  const unsigned bits = core::measured_bits(sample);
  const int num_palm = std::popcount(bits & kPalmBits);
  const int num_fingers = std::popcount(bits & ~kPalmBits);
  if (num_palm == 0 || num_fingers == 0) return;
  Eigen::Vector3d palm_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d palm_velocity_m_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d fingers_m = Eigen::Vector3d::Zero();
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      const double position_m = sample.tip_position_m[point][axis];
      if (point < kNumPalmPoints) {
        palm_m[axis] += position_m / num_palm;
        palm_velocity_m_per_s[axis] += sample.tip_velocity_m_per_s[point][axis] / num_palm;
      } else {
        fingers_m[axis] += position_m / num_fingers;
      }
    }
  }
  lag_.feed(fingers_m, palm_m, palm_velocity_m_per_s);
}

void MovementMeter::feed(const core::Sample& sample, double period_s) noexcept {
  const int num_points = core::num_measured_points(sample);
  feed_lag(sample);
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      position_m[axis] += sample.tip_position_m[point][axis];
      velocity_m_per_s[axis] += sample.tip_velocity_m_per_s[point][axis];
      force_n[axis] += core::delivered_force_n(sample)[point][axis];
    }
  }
  velocity_m_per_s /= num_points;
  const double num_periods = static_cast<double>(1 + sample.num_missed_before);
  strokes_.feed(position_m / num_points, velocity_m_per_s, num_periods * period_s);
  const double speed_m_per_s = velocity_m_per_s.norm();
  ++sums_.num_ticks;
  sums_.speed_m_per_s += speed_m_per_s;
  if (speed_m_per_s > 0.0) {
    sums_.rendered_opposing_n -= force_n.dot(velocity_m_per_s) / speed_m_per_s;
    sums_.opposing_n = sums_.rendered_opposing_n;
  }
}

}  // namespace jnd::app
