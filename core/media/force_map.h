#pragma once

#include <cstddef>
#include <vector>

#include "core/hand.h"

namespace jnd::core {

/// Coefficients of drag and lift of the hand over angle of attack and speed, measured or
/// computed: C_D and C_L of the drag equation force = 1/2 density speed^2 area C.
///
/// Between the rows the map is a monotone cubic in the angle (Fritsch and Butland 1984), so it
/// is smooth and stays within the range of neighbouring values, and it is linear in speed.
/// Beyond the first and the last row of either, it keeps their values. Drag is even about 0 and
/// pi/2, so its slope is 0 there.
class ForceMap {
 public:
  struct Row {
    double angle_of_attack_rad = 0.0;  ///< Angle between hand plane and motion, in [0, pi/2].
    double speed_m_per_s = 0.0;        ///< >= 0.
    double drag_coefficient = 0.0;     ///< In [0, 100], because drag never pushes.
    double lift_coefficient = 0.0;     ///< In [-100, 100].
    int line = 0;                      ///< Line of the row in its file, or 0 if it has none.
  };
  struct Coefficients {
    double drag = 0.0;
    double lift = 0.0;
  };

  /// The rows may come in any order. They need every combination of at least two angles and at
  /// least one speed. If any lift is not 0, the angles reach from 0 to pi/2 and lift is 0 at
  /// both, because it has no side to point to there. Throws `Error` naming the row's line. Not
  /// real time.
  explicit ForceMap(std::vector<Row> rows);

  /// Returns NaN for NaN. Real time.
  [[nodiscard]] Coefficients at(double angle_of_attack_rad,
                                double speed_m_per_s) const noexcept;

  [[nodiscard]] bool has_lift() const noexcept { return has_lift_; }

 private:
  struct Node {
    Coefficients value;
    Coefficients slope_per_rad;
  };
  [[nodiscard]] Coefficients along_angle(std::size_t speed, std::size_t angle,
                                         double part) const noexcept;

  std::vector<double> angle_of_attack_rad_;
  std::vector<double> speed_m_per_s_;
  std::vector<Node> nodes_;  ///< All angles of the first speed, then of the next.
  bool has_lift_ = false;
};

/// Returns the map's C_D for this motion, or the thesis's C_D without a map. Real time.
[[nodiscard]] double mapped_drag_coefficient(const HandMotion& motion,
                                             const ForceMap* map) noexcept;

}  // namespace jnd::core
