#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/pointer.h"

namespace jnd::device {

/// The way of a pointer that tells where it is some 30 to 120 times a second, made smooth for a
/// loop at 1 kHz. Each position told is approached along a straight line over the usual time
/// between two of them, no faster than `max_speed_m_per_s`; what goes along that line is
/// followed by a critically damped second-order filter,
///
///     a = bandwidth^2 (line - position) - 2 bandwidth velocity.
///
/// Such a filter never overshoots, and its speed stays within that of the line. So position and
/// velocity never jump, whatever the pointer does; they come later by about the time between
/// two positions and 2 / bandwidth: 30 ms at 60 Hz. Single-threaded; real time except the
/// constructor.
class PointerGuide {
 public:
  struct Parameters {
    double bandwidth_rad_per_s = 150.0;  ///< > 0.
    double max_speed_m_per_s = 2.5;  ///< > 0; half of what the haptic loop takes for broken.
    double reach_m = 0.5;            ///< Farthest along x and along y, either way, > 0.
  };

  /// Throws `core::Error` naming the field; `period_s` > 0. At rest at (0, 0). Not real time.
  PointerGuide(const Parameters& parameters, double period_s);

  /// Moves on by one tick. A pointer whose sequence is that of the last tick has not moved; one
  /// that is not finite counts for nothing; one out of reach is held at its edge.
  void advance(const core::PointerPosition& pointer) noexcept;

  [[nodiscard]] const Eigen::Vector2d& position_m() const noexcept { return position_m_; }
  [[nodiscard]] const Eigen::Vector2d& velocity_m_per_s() const noexcept {
    return velocity_m_per_s_;
  }

 private:
  void take(const core::PointerPosition& pointer) noexcept;

  Parameters parameters_;
  double period_s_;
  double decay_ratio_;  ///< Of the filter over one period.
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
