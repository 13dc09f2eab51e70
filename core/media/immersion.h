#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <type_traits>

namespace jnd::core {

/// Says which points are in the fluid (thesis, C.2): those below the surface z = 0, less deep
/// than `depth_m`, and no further than `radius_m` from the axis x = y = 0. If both are
/// infinite, this is the "infinite surface" of the studies. The container's frame is the
/// workspace frame moved to `origin_m`.
struct Immersion {
  double radius_m = std::numeric_limits<double>::infinity();  ///< > 0.
  double depth_m = std::numeric_limits<double>::infinity();   ///< > 0.
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double origin_z_m = 0.0;  ///< Height of the surface in the workspace frame.

  /// Whether all numbers are valid. A NaN or an infinite place would take the medium away
  /// silently. Real time.
  [[nodiscard]] bool is_sound() const noexcept {
    return std::isfinite(origin_x_m) && std::isfinite(origin_y_m) &&
           std::isfinite(origin_z_m) && radius_m > 0.0 && depth_m > 0.0;
  }

  /// A NaN coordinate is outside. Real time.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_m) const noexcept {
    const double x = point_m.x() - origin_x_m;
    const double y = point_m.y() - origin_y_m;
    const double z = point_m.z() - origin_z_m;
    return z < 0.0 && z > -depth_m && x * x + y * y < radius_m * radius_m;
  }
};

static_assert(std::is_trivially_copyable_v<Immersion>);

}  // namespace jnd::core
