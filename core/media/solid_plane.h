#pragma once

#include <algorithm>

namespace jnd::core {

/// A flat, frictionless, stiff surface by the god-object method (Zilles and Salisbury 1995): on
/// a plane without friction the god-object is the point's projection, so
///
///     force_z = max(0, stiffness depth - damping v_z min(1, depth / 1 mm)),  depth = -z > 0
///
/// for the whole hand, split over the points by their area shares. It never pulls; the damping
/// fades in over the first millimetre, so that touching the plane is no force step. At a loop
/// period T it can only be passive with damping > stiffness T / 2 (Colgate and Schenkel 1997);
/// the hand's own damping counts.
class SolidPlane {
 public:
  struct Parameters {
    double stiffness_n_per_m;        ///< Of the whole hand on the plane, finite, >= 0.
    double damping_n_s_per_m = 0.0;  ///< While in contact, finite, >= 0.
  };

  /// Throws `Error` naming the field. Not real time.
  explicit SolidPlane(const Parameters& parameters);

  [[nodiscard]] double stiffness_n_per_m() const noexcept {
    return parameters_.stiffness_n_per_m;
  }
  [[nodiscard]] double damping_n_s_per_m() const noexcept {
    return parameters_.damping_n_s_per_m;
  }

  /// Along +z, >= 0, for the whole hand at `depth_m` below the surface. Real time.
  [[nodiscard]] static double force_n(double stiffness_n_per_m, double damping_n_s_per_m,
                                      double depth_m, double velocity_z_m_per_s) noexcept {
    constexpr double kFullDampingDepthM = 0.001;
    if (!(depth_m > 0.0)) return 0.0;
    const double faded_damping =
        damping_n_s_per_m * std::min(1.0, depth_m / kFullDampingDepthM);
    const double force = stiffness_n_per_m * depth_m - faded_damping * velocity_z_m_per_s;
    // Not std::max: a force that is not a number has to reach the limiter.
    return force < 0.0 ? 0.0 : force;
  }

 private:
  Parameters parameters_;
};

}  // namespace jnd::core
