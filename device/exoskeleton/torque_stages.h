#pragma once

#include "device/exoskeleton/geometry.h"

namespace jnd::device {

/// Within its free range a joint feels nothing. Beyond it, a spring pushes it back, and a
/// damper acts that fades in with the depth:
///
///   torque = -stiffness depth - damping velocity min(1, depth / full_depth),
///
/// The torque never points towards the stop, so it can only keep the joint away from it
/// (thesis, A.3: forces before the physical limit is reached). It is never more than the hand
/// may feel, because no limiter comes after it.
struct LimitProtection {
  double low_rad, high_rad;      ///< Limits of the free range.
  double stiffness_n_m_per_rad;  ///< >= 0.
  double damping_n_m_s_per_rad;  ///< >= 0.
  double max_torque_n_m;         ///< >= 0.
  static constexpr double kFullDepth_rad = 0.05;

  /// Real time.
  [[nodiscard]] double torque_n_m(double position_rad,
                                  double velocity_rad_per_s) const noexcept;
};

/// Returns the default protection of a joint. For the arm it acts within 0.1 rad of the stops.
/// For a finger it acts around the neutral pose, so that the hand can also carry the platform
/// along with it. Not real time.
[[nodiscard]] LimitProtection default_protection(int joint);

/// Returns a share of the friction that opposes the motion,
///
///   torque = ratio friction v / sqrt(v^2 + v0^2),
///
/// which is smooth around rest. With a ratio < 1 it is always less than the friction itself, so
/// the joint stays passive (the aim of Le Tien et al. 2008; theirs observes the friction, ours
/// knows it). Real time.
[[nodiscard]] double friction_compensation_n_m(double friction_n_m, double ratio,
                                               double velocity_rad_per_s,
                                               double smooth_speed_rad_per_s) noexcept;

/// Returns what the person does to the joints, from the torque sensors: a resting joint holds
/// only the links' weight and the person. Inertia counts for the person. Real time.
[[nodiscard]] inline JointVector human_torque_n_m(const JointVector& measured_n_m,
                                                  const JointVector& gravity_n_m) noexcept {
  return gravity_n_m - measured_n_m;
}

/// Returns the largest torque of each joint: the arm's according to its maker, a finger's for
/// somewhat more than 10 N at the tip. Not real time.
[[nodiscard]] JointVector max_torque_n_m();

/// Limits each joint to its largest torque. Real time.
[[nodiscard]] inline JointVector clamped(const JointVector& torque_n_m,
                                         const JointVector& max_n_m) noexcept {
  return torque_n_m.cwiseMin(max_n_m).cwiseMax(-max_n_m);
}

}  // namespace jnd::device
