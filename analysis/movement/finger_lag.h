#pragma once

#include <Eigen/Core>
#include <optional>

namespace jnd::analysis {

/// Measures whether the palm or the fingers lead. If the fingers follow the palm's path with a
/// delay tau, their displacement from the palm is -tau times the palm's velocity plus a
/// constant, the posture. The lag is minus the slope of that line by least squares, in the
/// horizontal plane. It needs no turning points, and pauses do not disturb it. Only sums are
/// kept. Real time.
class FingerLag {
 public:
  /// Adds one tick. It takes the mean of the points of thumb, index and middle finger and the
  /// mean of the palm's points, in one frame with z up. A tick that is not finite is left out.
  void feed(const Eigen::Vector3d& fingers_m, const Eigen::Vector3d& palm_m,
            const Eigen::Vector3d& palm_velocity_m_per_s) noexcept;

  /// Returns the lag in s and starts anew. It is > 0 if the fingers trail behind the palm, and
  /// < 0 if they lead. It is absent for a hand that rests (below 1 mm/s) or whose points move
  /// together to within 1 um, as those of a rigid hand.
  std::optional<double> finish() noexcept;

 private:
  struct Sums {
    double num_ticks = 0.0;
    /// Displacements are measured from this one.
    Eigen::Vector2d first_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d displacement_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity_m_per_s = Eigen::Vector2d::Zero();
    double displacement_squared_m2 = 0.0;
    double velocity_squared_m2_per_s2 = 0.0;
    double product_m2_per_s = 0.0;
  };

  Sums sums_;
};

}  // namespace jnd::analysis
