#pragma once

#include <Eigen/Core>
#include <optional>

namespace jnd::analysis {

/// Who leads, the palm or the fingers? If the fingers follow the palm's path by a delay tau,
/// their displacement from the palm is -tau times its velocity and a constant, the posture.
/// The lag is minus the slope of that line by least squares, in the horizontal plane. It needs
/// no turning points, and pauses do not disturb it. Sums alone are kept. Real time.
class FingerLag {
 public:
  /// One tick: the mean of the fingers' points (thumb, index, middle) and that of the palm's,
  /// in one frame with z up. A tick that is not finite is left out.
  void feed(const Eigen::Vector3d& fingers_m, const Eigen::Vector3d& palm_m,
            const Eigen::Vector3d& palm_velocity_m_per_s) noexcept;

  /// > 0: the fingers trail behind the palm by so much; < 0: they lead. Nothing of a hand that
  /// rests (below 1 mm/s) or that is as stiff as a board (its points move together to 1 um).
  /// Starts anew.
  std::optional<double> finish() noexcept;

 private:
  struct Sums {
    double num_ticks = 0.0;
    Eigen::Vector2d first_m = Eigen::Vector2d::Zero();  ///< Displacements count from it.
    Eigen::Vector2d displacement_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity_m_per_s = Eigen::Vector2d::Zero();
    double displacement_squared_m2 = 0.0;
    double velocity_squared_m2_per_s2 = 0.0;
    double product_m2_per_s = 0.0;
  };

  Sums sums_;
};

}  // namespace jnd::analysis
