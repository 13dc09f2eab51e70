#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// The means over one way along a straight line.
struct GuidedWay {
  /// The direction of the motion, of length 1.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  /// The speed along the direction, > 0.
  double speed_m_per_s = 0.0;
  /// The acceleration along the direction.
  double acceleration_m_per_s2 = 0.0;
  double commanded_n = 0.0;  ///< The mean force that was sent, along the direction.
  double load_n = 0.0;       ///< The load that hung from the tool, downwards.
  int pose = 0;              ///< The index of the place at which loads were hung.
  /// The length of the path, including back and forth, divided by the distance covered, >= 1.
  /// The device may have overshot and returned.
  double path_ratio = 1.0;
};

/// Computes the means of a recorded way, which is best recorded from rest to rest. It has one
/// position [m] and one commanded force [N] along the direction for each tick. The means are
/// over the distance, because their balance is one of energy, which holds however the speed
/// changed. Cogging returns the energy that it took, but it does not cancel in a mean over
/// time. From rest to rest the balance also holds for a device whose links sway behind its
/// tool, because no energy is left in them. Throws `core::Error` for fewer than sixty ticks, or
/// for a motion against the direction.
[[nodiscard]] GuidedWay guided_way(const Eigen::Vector3d& direction,
                                   const std::vector<double>& position_m,
                                   const std::vector<double>& commanded_n, double period_s,
                                   double load_n, int pose);

/// The forces that a device itself adds to the commanded force.
struct ForceFit {
  Measured gain;      ///< Newtons delivered for each newton commanded.
  Measured weight_n;  ///< The downward weight that the motors do not carry.
  Eigen::Vector3d offset_n =
      Eigen::Vector3d::Zero();  ///< The whole constant force, in the same frame as `up`.
  Measured damping_n_s_per_m;
  Measured friction_n;
  /// The damping along each line that was followed without loads, in the order of their first
  /// ways. If the lines differ by more than noise (F test, 0.1 %), damping and friction are
  /// those of the first line alone, along which participants stroke.
  std::vector<Measured> damping_by_axis_n_s_per_m;
  bool damps_alike = true;
  /// Half the difference between the forces that must be commanded to go one way and to come
  /// back, at zero speed.
  Measured hysteresis_n;
  /// The force that opposes lifting and lowering loads, in commanded newtons. Old records do
  /// not have it.
  std::optional<double> lifting_opposed_n;
  double residual_n = 0.0;  ///< The standard deviation of single ways about the fit.
  /// The standard deviation of the gain between poses, divided by the gain.
  double pose_spread_ratio = 0.0;
  int num_ways = 0;
  std::vector<GuidedWay> ways;  ///< The ways on which the fit rests.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double mass_per_gain_kg = 0.0;  ///< The mass per gain that was used.
};

/// For unit directions e and `up`, every way satisfies
///
///     gain u = load (up . e + a / g) + mass a + damping v + friction p - offset . e,
///
/// where p is the path length divided by the distance, which is 1 for a way without overshoot.
/// Known loads that are lifted and lowered at one slow speed determine the gain and what acts
/// up or down. Ways without loads at several speeds determine damping and friction, which the
/// gain converts into newtons. The mass is not estimated here, because the small accelerations
/// are as noisy as they are large; `mass_per_gain_kg` comes from pushes.
/// `load_uncertainty_ratio` is the standard uncertainty of all loads together (scales, local
/// gravity) divided by the loads, >= 0. Throws `core::Error` if the ways do not determine all
/// of it: two loads, two speeds, and both directions along three axes are needed.
[[nodiscard]] ForceFit fit_force(const std::vector<GuidedWay>& ways, const Eigen::Vector3d& up,
                                 double mass_per_gain_kg, double load_uncertainty_ratio);

/// The force that the fit expects to be commanded on this way, without that for the mass [N].
[[nodiscard]] double fitted_n(const ForceFit& fit, const GuidedWay& way);
/// The force that was commanded on this way, without that for the mass [N].
[[nodiscard]] double commanded_without_mass_n(const ForceFit& fit, const GuidedWay& way);
/// The load along this way, including the force that accelerates it [N].
[[nodiscard]] double load_along_n(const ForceFit& fit, const GuidedWay& way);

}  // namespace jnd::analysis
