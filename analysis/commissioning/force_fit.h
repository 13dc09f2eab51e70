#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// What one way along a straight line came to.
struct GuidedWay {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< Of the motion, of length 1.
  double speed_m_per_s = 0.0;                            ///< Along it, > 0.
  double acceleration_m_per_s2 = 0.0;                    ///< Along it.
  double commanded_n = 0.0;  ///< Mean of the force that was sent, along it.
  double load_n = 0.0;       ///< That hung from the tool, downwards.
  int pose = 0;              ///< Which of the places where loads were hung.
  /// All that it went, to and fro, over how far it came, >= 1: it may have gone beyond and
  /// back.
  double path_ratio = 1.0;
};

/// A way as it was recorded, best from rest to rest: position along it [m], commanded force
/// along it [N], one each tick. Means over the way, for of these the balance is one of energy,
/// which holds however the speed changed; and cogging gives back what it took, but not as much
/// of the time as it took it. From rest to rest it holds also for a device whose links sway
/// behind its tool, for then no energy is left in them. Fewer than sixty ticks, or a motion
/// against the direction: throws `core::Error`.
[[nodiscard]] GuidedWay guided_way(const Eigen::Vector3d& direction,
                                   const std::vector<double>& position_m,
                                   const std::vector<double>& commanded_n, double period_s,
                                   double load_n, int pose);

/// What a device adds to the force that it was told, by itself.
struct ForceFit {
  Measured gain;      ///< Newtons given for a newton commanded.
  Measured weight_n;  ///< Downwards, of what its motors do not carry.
  Eigen::Vector3d offset_n =
      Eigen::Vector3d::Zero();  ///< The whole constant force, as `up` is.
  Measured damping_n_s_per_m;
  Measured friction_n;
  /// Of each line that was gone along without loads, in the order of their first ways. Where
  /// they differ by more than noise does (F test, 0.1 %), damping and friction are of the first
  /// line alone, along which the studies stroke.
  std::vector<Measured> damping_by_axis_n_s_per_m;
  bool damps_alike = true;
  /// Half of what must be commanded more to go one way than to come back, at no speed.
  Measured hysteresis_n;
  /// What opposes lifting and lowering loads, in newtons commanded; none in old records.
  std::optional<double> lifting_opposed_n;
  double residual_n = 0.0;         ///< Standard deviation of a way about the fit.
  double pose_spread_ratio = 0.0;  ///< Standard deviation of the gain between poses, over it.
  int num_ways = 0;
  std::vector<GuidedWay> ways;  ///< That it rests on.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double mass_per_gain_kg = 0.0;  ///< That it was computed with.
};

/// For unit directions e and `up` every way comes to
///
///     gain u = load (up . e + a / g) + mass a + damping v + friction p - offset . e,
///
/// p being the path over how far it came, 1 for a way that is not gone beyond.
/// Known loads, lifted and lowered at one slow speed, tell the gain and what acts up or down;
/// ways without loads at several speeds tell damping and friction, and the gain turns these
/// into newtons. The mass is not estimated here, for the little acceleration that there is has
/// as much noise: `mass_per_gain_kg` is from pushes. `load_uncertainty_ratio`: standard
/// uncertainty of all loads together, over them (scales, local gravity), >= 0. Throws
/// `core::Error` where the ways do not tell it all apart: two loads, two speeds, both ways
/// along three axes are wanted.
[[nodiscard]] ForceFit fit_force(const std::vector<GuidedWay>& ways, const Eigen::Vector3d& up,
                                 double mass_per_gain_kg, double load_uncertainty_ratio);

/// What must be commanded on this way by the fit, without what the mass takes [N].
[[nodiscard]] double fitted_n(const ForceFit& fit, const GuidedWay& way);
/// What was commanded on it, likewise [N].
[[nodiscard]] double commanded_without_mass_n(const ForceFit& fit, const GuidedWay& way);
/// What hung from the tool, along this way, with what it takes to speed it up [N].
[[nodiscard]] double load_along_n(const ForceFit& fit, const GuidedWay& way);

}  // namespace jnd::analysis
