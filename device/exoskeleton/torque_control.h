#pragma once

#include <array>

#include "core/hand.h"
#include "core/safety/fault.h"
#include "device/exoskeleton/geometry.h"
#include "device/exoskeleton/kinematics.h"
#include "device/exoskeleton/torque_stages.h"

namespace jnd::device {

/// From the forces that the hand shall feel to the torques of the joints, after every limiter:
///
///     J^T force -> + joint-limit protection -> + K human torque -> + friction compensation
///     -> + platform held upright -> + gravity -> clamp
///
/// The forces of all tips act on the arm as their sum and moment, too (thesis, C.3 and C.4).
/// Feed-forward divides what the hand feels of the device, and of the rendered force, by 1 + K
/// (Gil and Sanchez); the rendered force can be made up for that. Each stage that the limiter
/// cannot see is bounded here. Anything not finite latches a fault: until `rearm` the links'
/// weight is held and nothing else, or nothing at all where the pose is not finite either. Real
/// time except the constructor.
class TorqueControl {
 public:
  struct Parameters {
    /// K, >= 0, and with the filter's weight of a tick w: w (1 + K) <= 1, or the loop of sensor
    /// and motor would swing up. The thesis uses feed-forward and gives no number.
    double feed_forward_gain_ratio = 0.0;
    bool compensates_feed_forward = false;     ///< Rendered force times 1 + K.
    double feed_forward_cutoff_hz = 10.0;      ///< Of the measured torque, > 0.
    double friction_compensation_ratio = 0.5;  ///< Of a moving finger joint's, [0, 1).
    double friction_speed_rad_per_s = 0.2;     ///< Below it compensation fades, > 0.
    /// The arm keeps the platform from turning, for its wrist hangs free between hand and arm
    /// and would wind itself up over many strokes; where the platform is, it leaves to the
    /// hand. >= 0.
    double platform_stiffness_n_m_per_rad = 15.0;
    double platform_damping_n_m_s_per_rad = 1.0;
    double max_platform_moment_n_m =
        3.0;  ///< Of the two together, for the hand feels it, >= 0.
    /// Spring and damper before a finger's stops: 1 is the default, >= 0.
    double limit_protection_ratio = 1.0;
  };

  /// What the joints' sensors say.
  struct Measured {
    JointVector position_rad = JointVector::Zero();
    JointVector velocity_rad_per_s = JointVector::Zero();
    JointVector torque_n_m = JointVector::Zero();
  };

  /// Throws `core::Error` naming the field; `period_s` > 0. Not real time.
  TorqueControl(const Parameters& parameters, double period_s);

  /// Forgets the measured torque and the fault.
  void reset() noexcept;

  /// One tick. `kinematics` belongs to the measured position.
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
