#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/pointer.h"

namespace jnd::device {

/// Smooths the path of a pointer that reports its position some 30 to 120 times a second, for a
/// loop at 1 kHz. It approaches each reported position along a straight line over the usual
/// time between two of them, at most at `max_speed_m_per_s`. A critically damped second-order
/// filter follows the point on that line,
///
///   a = bandwidth^2 (line - position) - 2 bandwidth velocity.
///
/// Such a filter never overshoots, and its speed never exceeds that of the line. So position
/// and velocity never jump, whatever the pointer does. They are late by about the time between
/// two positions plus 2 / bandwidth: 30 ms at 60 Hz. Single-threaded; real time except the
/// constructor.
class PointerGuide {
 public:
  struct Parameters {
    double bandwidth_rad_per_s = 150.0;  ///< > 0.
    /// > 0; half of the speed that the haptic loop regards as a fault.
    double max_speed_m_per_s = 2.5;
    double reach_m = 0.5;  ///< Largest |x| and |y|, > 0.
  };

  /// Throws `core::Error` naming the field; `period_s` > 0. Starts at rest at (0, 0). Not real
  /// time.
  PointerGuide(const Parameters& parameters, double period_s);

  /// Advances by one tick. A pointer with the sequence number of the last tick has not moved.
  /// One that is not finite is ignored, and one out of reach is held at the edge.
  void advance(const core::PointerPosition& pointer) noexcept;

  [[nodiscard]] const Eigen::Vector2d& position_m() const noexcept { return position_m_; }
  [[nodiscard]] const Eigen::Vector2d& velocity_m_per_s() const noexcept {
    return velocity_m_per_s_;
  }

 private:
  void take(const core::PointerPosition& pointer) noexcept;

  Parameters parameters_;
  double period_s_;
  double decay_ratio_;  ///< Decay of the filter over one period.
  double interval_ticks_;
  std::int64_t ticks_since_last_ = 0;
  std::uint64_t last_sequence_ = 0;
  Eigen::Vector2d goal_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d line_m_ = Eigen::Vector2d::Zero();
  double line_step_m_ = 0.0;
  Eigen::Vector2d position_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_m_per_s_ = Eigen::Vector2d::Zero();
};

}  // namespace jnd::device
