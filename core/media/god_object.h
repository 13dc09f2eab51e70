#pragma once

#include <Eigen/Core>

namespace jnd::core {

struct SolidParameters {
  double stiffness_n_per_m;        ///< For the whole hand, finite, >= 0.
  double damping_n_s_per_m = 0.0;  ///< Acts while the solid is touched, finite, >= 0.
  /// Coulomb's ratio, the same for sticking and sliding, finite, >= 0.
  double friction_ratio = 0.0;
};

/// The same as amounts. The force is linear in each of them.
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

/// One point on one stiff surface, by the god-object method (Zilles and Salisbury 1995). The
/// god-object is where the point would be if the surface could not be entered, and a spring
/// pulls the point towards it. The force follows from the depth below the surface, the
/// god-object's offset o along the surface, and a damping that fades in over the first
/// millimetre, d = damping min(1, depth / 1 mm):
///
///   normal force     = max(0, stiffness depth - d velocity_n)
///   tangential force = stiffness o - d velocity_t, at most friction x normal force
///
/// The god-object sticks to its place until the spring would exceed the friction. Then it
/// slides behind the point. One friction ratio serves both, because a smaller one for sliding
/// would make the force step. Touching the surface makes no step either, and the surface never
/// pulls the point in.
///
/// A point may be inside without having entered: it began inside, or the surface was moved or
/// switched on over it. To avoid a step, the surface then begins at the depth of this point,
/// and rises to its place by `kRiseMPerS`.
///
/// At a loop period T the surface can only be passive with damping > stiffness T / 2 (Colgate
/// and Schenkel 1997); the hand's own damping counts. Real time.
class GodObject {
 public:
  static constexpr double kRiseMPerS = 0.05;
  static constexpr double kFullDampingDepthM = 0.001;

  /// Returns the force on the point, in the workspace frame, for its share of the hand's
  /// amounts. `normal` is a unit vector out of the solid. `depth_m` > 0 is inside.
  [[nodiscard]] Eigen::Vector3d force_n(const SolidAmounts& amounts,
                                        const Eigen::Vector3d& normal, double depth_m,
                                        const Eigen::Vector3d& position_m,
                                        const Eigen::Vector3d& velocity_m_per_s,
                                        double period_s) noexcept;

  /// Tells that the surface moved by this much over the point; below 0 it moved away.
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
  /// Place of the god-object along the surface.
  Eigen::Vector3d god_object_m_ = Eigen::Vector3d::Zero();
};

}  // namespace jnd::core
