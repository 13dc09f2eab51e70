#pragma once

#include <Eigen/Core>
#include <array>

#include "core/hand.h"
#include "core/haptic_state.h"
#include "device/exoskeleton/geometry.h"

namespace jnd::device {

/// Everything that follows from joint angles: the positions of the tips, how they move with the
/// joints, and the gravity torque of each joint. All are in the workspace frame. It does not
/// matter whether the joints are real. Real time except the constructor.
class ExoskeletonKinematics {
 public:
  using ArmJacobian = Eigen::Matrix<double, 3, core::kNumArmJoints>;

  /// Places the arm's foot so that the neutral pose has the middle of the hand at `home_m`.
  explicit ExoskeletonKinematics(const Eigen::Vector3d& home_m) noexcept;

  /// Updates everything below. Joint angles are in rad.
  void update(const JointVector& position_rad) noexcept;

  [[nodiscard]] const Eigen::Vector3d& base_position_m() const noexcept { return base_m_; }
  [[nodiscard]] const core::PointVectors& tip_position_m() const noexcept { return tip_m_; }
  [[nodiscard]] const Eigen::Vector3d& end_effector_position_m() const noexcept {
    return end_effector_m_;
  }
  /// Returns the axes of the platform, which in the neutral pose are those of the workspace.
  [[nodiscard]] const Eigen::Matrix3d& workspace_from_platform() const noexcept {
    return workspace_from_platform_;
  }

  /// Returns d tip / d joint of the finger at this point: abduction, extension, proximal,
  /// m/rad.
  [[nodiscard]] const Eigen::Matrix3d& finger_jacobian(int point) const noexcept {
    return finger_jacobian_[point];
  }
  /// Returns d tip / d joint of the arm, m/rad.
  [[nodiscard]] const ArmJacobian& arm_jacobian(int point) const noexcept {
    return arm_jacobian_[point];
  }

  /// Returns the velocities of the tips for joint velocities in rad/s.
  [[nodiscard]] core::PointVectors tip_velocity_m_per_s(
      const JointVector& velocity_rad_per_s) const noexcept;

  /// J^T: returns the joint torques that exert these forces at the tips. The arm's joints get
  /// the sum of the forces and their moments (thesis, C.4), so that the platform is not pushed
  /// back by its own fingers.
  [[nodiscard]] JointVector torque_of_n_m(const core::PointVectors& force_n) const noexcept;

  /// Returns the axis by which the platform is turned away from the workspace's axes, times the
  /// sine of the angle.
  [[nodiscard]] Eigen::Vector3d platform_turn_rad() const noexcept;
  [[nodiscard]] Eigen::Vector3d platform_velocity_rad_per_s(
      const JointVector& velocity_rad_per_s) const noexcept;
  /// Returns the torques of the arm that turn the platform with this moment.
  [[nodiscard]] JointVector torque_of_moment_n_m(
      const Eigen::Vector3d& moment_n_m) const noexcept;

  /// Returns the torques that hold everything against gravity.
  [[nodiscard]] JointVector gravity_torque_n_m() const noexcept;

 private:
  void update_arm(const JointVector& position_rad) noexcept;
  void update_finger(int point, const JointVector& position_rad) noexcept;

  std::array<Eigen::Matrix3d, core::kNumContactPoints> platform_from_finger_;
  Eigen::Vector3d base_m_ = Eigen::Vector3d::Zero();

  std::array<Eigen::Vector3d, core::kNumArmJoints> joint_m_;
  std::array<Eigen::Vector3d, core::kNumArmJoints> axis_;
  std::array<Eigen::Vector3d, core::kNumArmJoints> link_center_m_;
  Eigen::Vector3d end_effector_m_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d workspace_from_platform_ = Eigen::Matrix3d::Identity();
  core::PointVectors tip_m_ = core::zero_vectors();
  std::array<Eigen::Matrix3d, core::kNumContactPoints> finger_jacobian_;
  std::array<ArmJacobian, core::kNumContactPoints> arm_jacobian_;
  /// Sum of mass times position of a finger's links, and its derivative by the finger's joints.
  core::PointVectors finger_moment_kg_m_ = core::zero_vectors();
  std::array<Eigen::Matrix3d, core::kNumContactPoints> finger_moment_slope_kg_m_;
};

}  // namespace jnd::device
