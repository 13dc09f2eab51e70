#pragma once

#include <Eigen/Core>
#include <array>

#include "core/hand.h"

namespace jnd::core {

/// Drag of a very viscous fluid on an ellipsoid with any three semi-axes. Each axis has its own
/// resistance (Oberbeck 1876; Perrin 1934; Happel and Brenner 1965, sec. 5-11):
///
///   force_i = -k_i velocity_i,  k_i = 16 pi viscosity / (chi + alpha_i a_i^2)
///   chi     = int_0^inf dt / D,  alpha_i = int_0^inf dt / ((a_i^2 + t) D)
///   D       = sqrt((a_1^2 + t)(a_2^2 + t)(a_3^2 + t))
///
/// chi = 2 R_F(a_1^2, a_2^2, a_3^2) and alpha_i = 2/3 R_D(a_j^2, a_k^2, a_i^2) are computed
/// once. A sphere gives 6 pi viscosity radius.
class EllipsoidDrag {
 public:
  struct Parameters {
    double viscosity_pa_s;  ///< >= 0.
    /// Semi-axes, > 0: along the fingers, across them, and along the hand plane's normal. The
    /// first two are those of the thesis's spheroid. The third, half the thickness of a flat
    /// hand, is an assumption.
    std::array<double, 3> semi_axes_m = {0.10, 0.05, 0.014};
  };

  /// Throws `Error` naming the field. Not real time.
  explicit EllipsoidDrag(const Parameters& parameters);

  /// Returns the damping along each of the three axes.
  [[nodiscard]] const std::array<double, 3>& damping_n_s_per_m() const noexcept {
    return damping_n_s_per_m_;
  }

 private:
  std::array<double, 3> damping_n_s_per_m_;
};

/// Returns the hand's axes as columns, in the frame of the tips: along the fingers (from the
/// inner half of the palm to the tip that spans the hand plane), across them, and the normal of
/// the hand plane. Zero if the hand plane is not defined. Real time.
[[nodiscard]] Eigen::Matrix3d hand_axes(
    const PointVectors& tip_position_m,
    const std::array<bool, kNumContactPoints>& attached = kAllAttached) noexcept;

}  // namespace jnd::core
