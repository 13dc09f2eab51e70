#include "device/exoskeleton/torque_control.h"

#include <cmath>
#include <numbers>

#include "core/require.h"

namespace jnd::device {
namespace {

using core::require;
using core::require_not_negative;
using core::require_positive;

/// One comparison serves all, because a sum with any term that is not finite is not finite
/// itself.
bool are_finite(const core::PointVectors& force_n) noexcept {
  double sum = 0.0;
  for (const Eigen::Vector3d& force : force_n) sum += force.sum();
  return std::isfinite(sum);
}

}  // namespace

TorqueControl::TorqueControl(const Parameters& parameters, double period_s)
    : parameters_(parameters), max_torque_n_m_(jnd::device::max_torque_n_m()) {
  require_positive(period_s, "period_s");
  require_not_negative(parameters.feed_forward_gain_ratio, "feed_forward_gain_ratio");
  require_positive(parameters.feed_forward_cutoff_hz, "feed_forward_cutoff_hz");
  require(parameters.friction_compensation_ratio >= 0.0 &&
              parameters.friction_compensation_ratio < 1.0,
          "friction_compensation_ratio", "a number in [0, 1)",
          parameters.friction_compensation_ratio);
  require_positive(parameters.friction_speed_rad_per_s, "friction_speed_rad_per_s");
  require_not_negative(parameters.platform_stiffness_n_m_per_rad,
                       "platform_stiffness_n_m_per_rad");
  require_not_negative(parameters.platform_damping_n_m_s_per_rad,
                       "platform_damping_n_m_s_per_rad");
  require_not_negative(parameters.limit_protection_ratio, "limit_protection_ratio");
  feed_forward_weight_ratio_ =
      1.0 - std::exp(-2.0 * std::numbers::pi * parameters.feed_forward_cutoff_hz * period_s);
  require(feed_forward_weight_ratio_ * (1.0 + parameters.feed_forward_gain_ratio) <= 1.0,
          "feed_forward_gain_ratio", "a number that this rate and cutoff keep stable",
          parameters.feed_forward_gain_ratio);
  require_not_negative(parameters.max_platform_moment_n_m, "max_platform_moment_n_m");
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    protection_[joint] = default_protection(joint);
    if (joint < core::kNumArmJoints) continue;
    protection_[joint].stiffness_n_m_per_rad *= parameters.limit_protection_ratio;
    protection_[joint].damping_n_m_s_per_rad *= parameters.limit_protection_ratio;
  }
}

void TorqueControl::reset() noexcept {
  human_torque_n_m_.setZero();
  rearm();
}

JointVector TorqueControl::torque_n_m(const ExoskeletonKinematics& kinematics,
                                      const Measured& measured,
                                      const core::PointVectors& force_on_hand_n) noexcept {
  const JointVector gravity_n_m = kinematics.gravity_torque_n_m();
  if (!are_finite(force_on_hand_n)) fault_ = core::Fault::kNonFiniteForce;
  if (fault_ != core::Fault::kNone) return faulted(gravity_n_m);

  const double gain = parameters_.feed_forward_gain_ratio;
  JointVector torque_n_m = kinematics.torque_of_n_m(force_on_hand_n);
  if (parameters_.compensates_feed_forward) torque_n_m *= 1.0 + gain;
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    torque_n_m[joint] += protection_[joint].torque_n_m(measured.position_rad[joint],
                                                       measured.velocity_rad_per_s[joint]);
  }
  if (gain > 0.0) {
    human_torque_n_m_ +=
        feed_forward_weight_ratio_ *
        (device::human_torque_n_m(measured.torque_n_m, gravity_n_m) - human_torque_n_m_);
    // Nobody exerts more on a joint than its motor could, so a sensor that says so is broken. A
    // value that is not a number must stay one, to be detected below.
    if (std::isfinite(human_torque_n_m_.sum())) {
      human_torque_n_m_ = clamped(human_torque_n_m_, max_torque_n_m_);
    }
    torque_n_m += gain * human_torque_n_m_;
  }
  for (int joint = core::kNumArmJoints; joint < core::kNumJoints; ++joint) {
    torque_n_m[joint] += friction_compensation_n_m(
        kFingerFriction_n_m[(joint - core::kNumArmJoints) % core::kNumJointsPerFinger],
        parameters_.friction_compensation_ratio, measured.velocity_rad_per_s[joint],
        parameters_.friction_speed_rad_per_s);
  }
  Eigen::Vector3d moment_n_m =
      -parameters_.platform_stiffness_n_m_per_rad * kinematics.platform_turn_rad() -
      parameters_.platform_damping_n_m_s_per_rad *
          kinematics.platform_velocity_rad_per_s(measured.velocity_rad_per_s);
  const double most_n_m = parameters_.max_platform_moment_n_m;
  if (moment_n_m.norm() > most_n_m) moment_n_m *= most_n_m / moment_n_m.norm();
  torque_n_m += kinematics.torque_of_moment_n_m(moment_n_m);
  torque_n_m += gravity_n_m;
  // A clamp would turn a value that is not a number into the largest torque.
  if (!std::isfinite(torque_n_m.sum())) {
    reset();
    fault_ = core::Fault::kNonFiniteState;
    return faulted(gravity_n_m);
  }
  return clamped(torque_n_m, max_torque_n_m_);
}

/// A robot that falls pulls at the hand more than any requested force, so its weight is held.
JointVector TorqueControl::faulted(const JointVector& gravity_n_m) const noexcept {
  if (!std::isfinite(gravity_n_m.sum())) return JointVector::Zero();
  return clamped(gravity_n_m, max_torque_n_m_);
}

}  // namespace jnd::device
