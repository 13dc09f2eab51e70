#include "device/exoskeleton/kinematics.h"

#include <Eigen/Geometry>
#include <cmath>

namespace jnd::device {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGravity_m_per_s2 = 9.81;

double finger_mass_kg() noexcept {
  return kFingerLinks[0].mass_kg + kFingerLinks[1].mass_kg + kFingerLinks[2].mass_kg;
}

/// Returns the frame turned about one of its own axes.
Matrix3d turned(const Matrix3d& frame, Axis axis, double angle_rad) noexcept {
  const double c = std::cos(angle_rad);
  const double s = axis == Axis::kMinusY ? -std::sin(angle_rad) : std::sin(angle_rad);
  Matrix3d result;
  if (axis == Axis::kZ) {
    result.col(0) = c * frame.col(0) + s * frame.col(1);
    result.col(1) = c * frame.col(1) - s * frame.col(0);
    result.col(2) = frame.col(2);
  } else {
    result.col(0) = c * frame.col(0) - s * frame.col(2);
    result.col(1) = frame.col(1);
    result.col(2) = c * frame.col(2) + s * frame.col(0);
  }
  return result;
}

/// How far a chain of links reaches in the finger's plane, along the finger and up towards the
/// hand, and how that changes with the proximal angle.
struct Reach {
  double along_m = 0.0, up_m = 0.0;
  double along_by_proximal_m = 0.0, up_by_proximal_m = 0.0;

  [[nodiscard]] Vector3d at(double cos_abduction, double sin_abduction) const noexcept {
    return {along_m * cos_abduction, along_m * sin_abduction, up_m};
  }
  /// The columns are the derivatives by abduction, extension (which turns the whole chain) and
  /// proximal angle.
  [[nodiscard]] Matrix3d slope(double cos_abduction, double sin_abduction) const noexcept {
    Matrix3d slope;
    slope << -along_m * sin_abduction, -up_m * cos_abduction,
        along_by_proximal_m * cos_abduction,  //
        along_m * cos_abduction, -up_m * sin_abduction,
        along_by_proximal_m * sin_abduction,  //
        0.0, along_m, up_by_proximal_m;
    return slope;
  }
};

/// The distal joint turns as far as the proximal one, so the links are inclined by the
/// extension plus 0, 1 and 2 times that angle.
struct FingerAngles {
  FingerAngles(double extension_rad, double proximal_rad) noexcept {
    for (int link = 0; link < 3; ++link) {
      cosine[link] = std::cos(extension_rad + link * proximal_rad);
      sine[link] = std::sin(extension_rad + link * proximal_rad);
    }
  }
  /// Returns the reach of a chain that goes this far along each link.
  [[nodiscard]] Reach reach(double proximal_m, double medial_m,
                            double distal_m) const noexcept {
    return {.along_m = proximal_m * cosine[0] + medial_m * cosine[1] + distal_m * cosine[2],
            .up_m = proximal_m * sine[0] + medial_m * sine[1] + distal_m * sine[2],
            .along_by_proximal_m = -medial_m * sine[1] - 2.0 * distal_m * sine[2],
            .up_by_proximal_m = medial_m * cosine[1] + 2.0 * distal_m * cosine[2]};
  }
  double cosine[3], sine[3];
};

}  // namespace

ExoskeletonKinematics::ExoskeletonKinematics(const Vector3d& home_m) noexcept {
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const FingerMount& mount = kFingerMounts[point];
    Matrix3d& axes = platform_from_finger_[point];
    axes.col(0) = vector_of(mount.stretched);
    axes.col(2) = vector_of(mount.towards_hand);
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
  update(neutral_pose_rad());
  base_m_ = home_m + vector_of(kNeutralEndEffector_m) - end_effector_m_;
  update(neutral_pose_rad());
}

void ExoskeletonKinematics::update(const JointVector& position_rad) noexcept {
  update_arm(position_rad);
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    update_finger(point, position_rad);
  }
}

void ExoskeletonKinematics::update_arm(const JointVector& position_rad) noexcept {
  Matrix3d frame = Matrix3d::Identity();
  Vector3d origin_m = base_m_;
  for (int joint = 0; joint < core::kNumArmJoints; ++joint) {
    origin_m += kArmOffsets_m[joint] * frame.col(2);
    joint_m_[joint] = origin_m;
    axis_[joint] = kArmAxes[joint] == Axis::kZ   ? Vector3d(frame.col(2))
                   : kArmAxes[joint] == Axis::kY ? Vector3d(frame.col(1))
                                                 : Vector3d(-frame.col(1));
    frame = turned(frame, kArmAxes[joint], position_rad[joint]);
    link_center_m_[joint] = origin_m + frame * vector_of(kArmLinks[joint].center_m);
  }
  end_effector_m_ = origin_m;
  // The platform is mounted so that its x is the flange's z and its y the flange's x.
  workspace_from_platform_.col(0) = frame.col(2);
  workspace_from_platform_.col(1) = frame.col(0);
  workspace_from_platform_.col(2) = frame.col(1);
}

void ExoskeletonKinematics::update_finger(int point, const JointVector& position_rad) noexcept {
  const double abduction_rad = position_rad[core::finger_joint(point, 0)];
  const double cosine = std::cos(abduction_rad), sine = std::sin(abduction_rad);
  const FingerAngles angles(position_rad[core::finger_joint(point, 1)],
                            position_rad[core::finger_joint(point, 2)]);
  const Matrix3d workspace_from_finger =
      workspace_from_platform_ * platform_from_finger_[point];
  const Vector3d base_m =
      end_effector_m_ + workspace_from_platform_ * vector_of(kFingerMounts[point].base_m);

  const Reach tip = angles.reach(kProximalLink_m, kMedialLink_m, kDistalLink_m);
  tip_m_[point] = base_m + workspace_from_finger * tip.at(cosine, sine);
  finger_jacobian_[point] = workspace_from_finger * tip.slope(cosine, sine);
  for (int joint = 0; joint < core::kNumArmJoints; ++joint) {
    arm_jacobian_[point].col(joint) = axis_[joint].cross(tip_m_[point] - joint_m_[joint]);
  }

  // All links count as one chain whose lengths are weighted by the masses beyond.
  const auto& [proximal, medial, distal] = kFingerLinks;
  const Reach moment =
      angles.reach(proximal.mass_kg * proximal.center_m[0] +
                       (medial.mass_kg + distal.mass_kg) * kProximalLink_m,
                   medial.mass_kg * medial.center_m[0] + distal.mass_kg * kMedialLink_m,
                   distal.mass_kg * distal.center_m[0]);
  finger_moment_kg_m_[point] =
      finger_mass_kg() * base_m + workspace_from_finger * moment.at(cosine, sine);
  finger_moment_slope_kg_m_[point] = workspace_from_finger * moment.slope(cosine, sine);
}

core::PointVectors ExoskeletonKinematics::tip_velocity_m_per_s(
    const JointVector& velocity_rad_per_s) const noexcept {
  core::PointVectors velocity;
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    velocity[point] =
        arm_jacobian_[point] * velocity_rad_per_s.head<core::kNumArmJoints>() +
        finger_jacobian_[point] *
            velocity_rad_per_s.segment<core::kNumJointsPerFinger>(core::finger_joint(point, 0));
  }
  return velocity;
}

JointVector ExoskeletonKinematics::torque_of_n_m(
    const core::PointVectors& force_n) const noexcept {
  JointVector torque_n_m = JointVector::Zero();
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    torque_n_m.head<core::kNumArmJoints>() += arm_jacobian_[point].transpose() * force_n[point];
    torque_n_m.segment<core::kNumJointsPerFinger>(core::finger_joint(point, 0)) =
        finger_jacobian_[point].transpose() * force_n[point];
  }
  return torque_n_m;
}

Vector3d ExoskeletonKinematics::platform_turn_rad() const noexcept {
  Vector3d turn_rad = Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    turn_rad += 0.5 * Vector3d::Unit(axis).cross(workspace_from_platform_.col(axis));
  }
  return turn_rad;
}

Vector3d ExoskeletonKinematics::platform_velocity_rad_per_s(
    const JointVector& velocity_rad_per_s) const noexcept {
  Vector3d turning_rad_per_s = Vector3d::Zero();
  for (int joint = 0; joint < core::kNumArmJoints; ++joint) {
    turning_rad_per_s += velocity_rad_per_s[joint] * axis_[joint];
  }
  return turning_rad_per_s;
}

JointVector ExoskeletonKinematics::torque_of_moment_n_m(
    const Vector3d& moment_n_m) const noexcept {
  JointVector torque_n_m = JointVector::Zero();
  for (int joint = 0; joint < core::kNumArmJoints; ++joint) {
    torque_n_m[joint] = axis_[joint].dot(moment_n_m);
  }
  return torque_n_m;
}

JointVector ExoskeletonKinematics::gravity_torque_n_m() const noexcept {
  JointVector torque_n_m;
  double mass_kg = kPlatform.mass_kg;
  Vector3d moment_kg_m =
      mass_kg * (end_effector_m_ + workspace_from_platform_ * vector_of(kPlatform.center_m));
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    mass_kg += finger_mass_kg();
    moment_kg_m += finger_moment_kg_m_[point];
    torque_n_m.segment<core::kNumJointsPerFinger>(core::finger_joint(point, 0)) =
        kGravity_m_per_s2 * finger_moment_slope_kg_m_[point].row(2).transpose();
  }
  // From the flange to the foot, each joint carries everything beyond it.
  for (int joint = core::kNumArmJoints - 1; joint >= 0; --joint) {
    mass_kg += kArmLinks[joint].mass_kg;
    moment_kg_m += kArmLinks[joint].mass_kg * link_center_m_[joint];
    const Vector3d lever_kg_m = moment_kg_m - mass_kg * joint_m_[joint];
    torque_n_m[joint] = kGravity_m_per_s2 * axis_[joint].cross(lever_kg_m).z();
  }
  return torque_n_m;
}

}  // namespace jnd::device
