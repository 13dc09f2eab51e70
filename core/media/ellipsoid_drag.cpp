#include "core/media/ellipsoid_drag.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/media/carlson.h"
#include "core/require.h"

namespace jnd::core {

EllipsoidDrag::EllipsoidDrag(const Parameters& parameters) {
  std::array<double, 3> squared_m2{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double axis_m = parameters.semi_axes_m[i];
    // The squares of lengths beyond these limits, which no hand has, would exceed the range of
    // the integrals.
    require(axis_m > 1e-9 && axis_m < 1e9, "semi_axes_m", "three numbers > 1e-9 and < 1e9",
            axis_m);
    squared_m2[i] = axis_m * axis_m;
  }
  const double chi = 2.0 * carlson_rf(squared_m2[0], squared_m2[1], squared_m2[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const double alpha =
        2.0 / 3.0 * carlson_rd(squared_m2[(i + 1) % 3], squared_m2[(i + 2) % 3], squared_m2[i]);
    damping_n_s_per_m_[i] =
        16.0 * std::numbers::pi * parameters.viscosity_pa_s / (chi + alpha * squared_m2[i]);
    require(parameters.viscosity_pa_s >= 0.0 && std::isfinite(damping_n_s_per_m_[i]),
            "viscosity_pa_s", "a finite number >= 0", parameters.viscosity_pa_s);
  }
}

Eigen::Matrix3d hand_axes(const PointVectors& tip_position_m,
                          const std::array<bool, kNumContactPoints>& attached) noexcept {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  const std::optional<ContactPoint> tip = tip_of_hand_plane(attached);
  const Eigen::Vector3d normal = hand_plane_normal(tip_position_m, attached);
  if (!tip || normal.squaredNorm() == 0.0) return axes;
  // Both points lie in the plane and apart from each other, because otherwise there is no
  // plane.
  const Eigen::Vector3d fingers = (tip_position_m[static_cast<int>(*tip)] -
                                   tip_position_m[static_cast<int>(ContactPoint::kPalmInner)])
                                      .normalized();
  axes.col(0) = fingers;
  axes.col(1) = normal.cross(fingers);
  axes.col(2) = normal;
  return axes;
}

}  // namespace jnd::core
