#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/require.h"

namespace jnd::core {

/// The box in which force is allowed, in the workspace frame. The default is wider than any arm
/// can reach, but limits a device whose sensors lost their zero, because its points may then be
/// anywhere.
struct Workspace {
  double half_width_x_m = 1.5;  ///< > 0, finite, like the other two.
  double half_width_y_m = 1.5;
  double half_width_z_m = 1.5;

  /// A NaN coordinate is outside. Real time.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_m) const noexcept {
    return std::abs(point_m.x()) <= half_width_x_m && std::abs(point_m.y()) <= half_width_y_m &&
           std::abs(point_m.z()) <= half_width_z_m;
  }
  /// Whether the point is inside and at least this far from the edge; false for NaN. Real time.
  [[nodiscard]] bool contains_well(const Eigen::Vector3d& point_m,
                                   double margin_m) const noexcept {
    return std::abs(point_m.x()) <= half_width_x_m - margin_m &&
           std::abs(point_m.y()) <= half_width_y_m - margin_m &&
           std::abs(point_m.z()) <= half_width_z_m - margin_m;
  }
};

/// Throws `Error` naming the field. Not real time.
inline void require_bounded(const Workspace& workspace) {
  require_positive(workspace.half_width_x_m, "half_width_x_m");
  require_positive(workspace.half_width_y_m, "half_width_y_m");
  require_positive(workspace.half_width_z_m, "half_width_z_m");
}

}  // namespace jnd::core
