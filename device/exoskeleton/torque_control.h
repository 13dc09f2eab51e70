#pragma once

#include <array>

#include "core/hand.h"
#include "core/safety/fault.h"
#include "device/exoskeleton/geometry.h"
#include "device/exoskeleton/kinematics.h"
#include "device/exoskeleton/torque_stages.h"

namespace jnd::device {

/// Turns the forces that the hand shall feel into joint torques, after every limiter:
///
///   J^T force -> + joint-limit protection -> + K human torque -> + friction compensation
///   -> + platform held upright -> + gravity -> clamp
///
/// The forces of all tips act on the arm as well, as their sum and moment (thesis, C.3 and
/// C.4). Feed-forward divides what the hand feels of the device, and of the rendered force, by
/// 1 + K (Gil and Sanchez); the rendered force can be compensated for that. Each stage that the
/// limiter cannot see is bounded here. A value that is not finite latches a fault. Until
/// `rearm` only the links' weight is held, or nothing at all if the pose is not finite either.
/// Real time except the constructor.
class TorqueControl {
 public:
  struct Parameters {
    /// K, >= 0. With w, the filter's weight of a tick, w (1 + K) <= 1 must hold, or the loop of
    /// sensor and motor would oscillate. The thesis uses feed-forward and gives no number.
    double feed_forward_gain_ratio = 0.0;
    bool compensates_feed_forward = false;  ///< Multiplies the rendered force by 1 + K.
    /// Cutoff of the filter for the measured torque, > 0.
    double feed_forward_cutoff_hz = 10.0;
    /// Share of a moving finger joint's friction, [0, 1).
    double friction_compensation_ratio = 0.5;
    double friction_speed_rad_per_s = 0.2;  ///< Compensation fades below this speed, > 0.
    /// The arm keeps the platform from turning. Its wrist hangs free between hand and arm, and
    /// would otherwise turn further and further over many strokes. The position of the platform
    /// is left to the hand. >= 0.
    double platform_stiffness_n_m_per_rad = 15.0;
    double platform_damping_n_m_s_per_rad = 1.0;
    /// Limit of both together, because the hand feels them, >= 0.
    double max_platform_moment_n_m = 3.0;
    /// Scales spring and damper before a finger's stops; 1 is the default, >= 0.
    double limit_protection_ratio = 1.0;
  };

  /// Readings of the joints' sensors.
  struct Measured {
    JointVector position_rad = JointVector::Zero();
    JointVector velocity_rad_per_s = JointVector::Zero();
    JointVector torque_n_m = JointVector::Zero();
  };

  /// Throws `core::Error` naming the field; `period_s` > 0. Not real time.
  TorqueControl(const Parameters& parameters, double period_s);

  /// Forgets the measured torque and the fault.
  void reset() noexcept;

  /// Computes one tick. `kinematics` must be those of the measured position.
  [[nodiscard]] JointVector torque_n_m(const ExoskeletonKinematics& kinematics,
                                       const Measured& measured,
                                       const core::PointVectors& force_on_hand_n) noexcept;

  [[nodiscard]] core::Fault fault() const noexcept { return fault_; }
  void rearm() noexcept { fault_ = core::Fault::kNone; }

 private:
  [[nodiscard]] JointVector faulted(const JointVector& gravity_n_m) const noexcept;

  Parameters parameters_;
  double feed_forward_weight_ratio_;
  std::array<LimitProtection, core::kNumJoints> protection_;
  JointVector max_torque_n_m_;
  JointVector human_torque_n_m_ = JointVector::Zero();  ///< Filtered.
  core::Fault fault_ = core::Fault::kNone;
};

}  // namespace jnd::device
