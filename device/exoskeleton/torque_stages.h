#pragma once

#include "device/exoskeleton/geometry.h"

namespace jnd::device {

/// Within its free range a joint feels nothing; beyond, a spring pushes it back and a damper
/// works that comes in with the depth:
///
///     torque = -stiffness depth - damping velocity min(1, depth / full_depth),
///
/// never towards the stop, so that it can only keep the joint away from it (thesis, A.3: forces
/// before the physical limit is reached), and never more than the hand may feel of it: no
/// limiter comes after.
struct LimitProtection {
  double low_rad, high_rad;      ///< Free in between.
  double stiffness_n_m_per_rad;  ///< >= 0.
  double damping_n_m_s_per_rad;  ///< >= 0.
  double max_torque_n_m;         ///< >= 0.
  static constexpr double kFullDepth_rad = 0.05;

  /// Real time.
  [[nodiscard]] double torque_n_m(double position_rad,
                                  double velocity_rad_per_s) const noexcept;
};

/// The protection of a joint as it is set by default: of the arm, within 0.1 rad of its stops;
/// of a finger, around its neutral pose, where it is also what lets the hand carry the platform
/// along. Not real time.
[[nodiscard]] LimitProtection default_protection(int joint);

/// A share of the friction that is known to oppose the motion,
///
///     torque = ratio friction v / sqrt(v^2 + v0^2),
///
/// smooth around rest and with a ratio < 1 always less than the friction itself, so that the
/// joint stays passive (the aim of Le Tien et al. 2008; theirs observes the friction, ours
/// knows it). Real time.
[[nodiscard]] double friction_compensation_n_m(double friction_n_m, double ratio,
                                               double velocity_rad_per_s,
                                               double smooth_speed_rad_per_s) noexcept;

/// What the person does to the joints, from the torque sensors: the links' weight and the
/// person are all that a resting joint holds. Inertia counts for the person. Real time.
[[nodiscard]] inline JointVector human_torque_n_m(const JointVector& measured_n_m,
                                                  const JointVector& gravity_n_m) noexcept {
  return gravity_n_m - measured_n_m;
}

/// The largest torque of each joint: the arm's as its maker says, a finger's for somewhat more
/// than 10 N at the tip. Not real time.
[[nodiscard]] JointVector max_torque_n_m();

/// Each joint within its largest torque. Real time.
[[nodiscard]] inline JointVector clamped(const JointVector& torque_n_m,
                                         const JointVector& max_n_m) noexcept {
  return torque_n_m.cwiseMin(max_n_m).cwiseMax(-max_n_m);
}

}  // namespace jnd::device
