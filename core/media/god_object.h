#pragma once

#include <Eigen/Core>

namespace jnd::core {

struct SolidParameters {
  double stiffness_n_per_m;        ///< Of the whole hand on it, finite, >= 0.
  double damping_n_s_per_m = 0.0;  ///< While it is touched, finite, >= 0.
  double friction_ratio = 0.0;     ///< Coulomb's, sticking and sliding alike, finite, >= 0.
};

/// The same as amounts, in each of which the force is linear.
struct SolidAmounts {
  double stiffness_n_per_m = 0.0;
  double damping_n_s_per_m = 0.0;
  double friction_n_per_m = 0.0;  ///< Friction ratio times stiffness.

  [[nodiscard]] bool is_there() const noexcept {
    return stiffness_n_per_m != 0.0 || damping_n_s_per_m != 0.0;
  }
};

/// Throws `Error` naming the field. Not real time.
[[nodiscard]] SolidAmounts solid_amounts(const SolidParameters& parameters);

/// One point on one stiff surface by the god-object method (Zilles and Salisbury 1995): the
/// god-object is where the point would be if the surface could not be entered, and pulls it
/// there by a spring. With the depth below the surface, the god-object's offset o along it and
/// damping that fades in over the first millimetre, d = damping min(1, depth / 1 mm):
///
///     normal force     = max(0, stiffness depth - d velocity_n)
///     tangential force = stiffness o - d velocity_t, at most friction x normal force
///
/// The god-object sticks to its place until the spring would exceed the friction, then slides
/// behind the point. One friction ratio serves both: a smaller one for sliding would be a step
/// of the force. Touching the surface is no step either, and it never pulls the point in.
///
/// A surface that a point did not enter itself (it began inside, the surface was moved or was
/// switched on over it) is no step: for this point it lies as deep as the point then is, and
/// rises to its place by `kRiseMPerS`.
///
/// At a loop period T it can only be passive with damping > stiffness T / 2 (Colgate and
/// Schenkel 1997); the hand's own damping counts. Real time.
class GodObject {
 public:
  static constexpr double kRiseMPerS = 0.05;
  static constexpr double kFullDampingDepthM = 0.001;

  /// Force on the point, workspace frame, for amounts of its own: its share of the hand's.
  /// `normal` is a unit vector out of the solid, `depth_m` > 0 inside of it.
  [[nodiscard]] Eigen::Vector3d force_n(const SolidAmounts& amounts,
                                        const Eigen::Vector3d& normal, double depth_m,
                                        const Eigen::Vector3d& position_m,
                                        const Eigen::Vector3d& velocity_m_per_s,
                                        double period_s) noexcept;

  /// The surface was moved by that much over the point; less than 0 is away from it.
  void surface_rose(double way_m) noexcept {
    if (way_m > 0.0) sunk_m_ += way_m;
  }

  /// Forgets the point, as before the first call.
  void release() noexcept { *this = GodObject(); }

 private:
  [[nodiscard]] Eigen::Vector3d friction_n(const SolidAmounts& amounts,
                                           const Eigen::Vector3d& normal, double felt_depth_m,
                                           double normal_n, const Eigen::Vector3d& position_m,
                                           const Eigen::Vector3d& velocity_m_per_s) noexcept;

  bool is_known_ = false;
  double sunk_m_ = 0.0;  ///< How far below its place the surface is for this point, >= 0.
  Eigen::Vector3d god_object_m_ = Eigen::Vector3d::Zero();  ///< Its place along the surface.
};

}  // namespace jnd::core
