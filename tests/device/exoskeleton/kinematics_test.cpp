#include "device/exoskeleton/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random_stream.h"
#include "device/drawn_mass.h"
#include "device/exoskeleton/mujoco_fixture.h"

namespace jnd::device {
namespace kinematics_test {

using Eigen::Vector3d;

constexpr int kNumPoses = 200;

TEST(ExoskeletonKinematics, TheNeutralPoseHasTheTipsWhereTheLumpedHandHasThem) {
  const Vector3d home_m(0.1, -0.2, -0.3);
  const ExoskeletonKinematics kinematics(home_m);
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const Vector3d expected_m = home_m + lumped_hand_tips_m()[point];
    EXPECT_LT((kinematics.tip_position_m()[point] - expected_m).norm(), 1e-4) << point;
  }
  EXPECT_LT((kinematics.end_effector_position_m() - home_m - Vector3d(-0.135, 0, 0)).norm(),
            1e-12);
  EXPECT_LT((kinematics.workspace_from_platform() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(std::abs(core::hand_plane_normal(kinematics.tip_position_m()).x()), 1.0, 1e-9);
}

TEST(ExoskeletonKinematics, StraightUpItIsTheSumOfItsLengths) {
  ExoskeletonKinematics kinematics(Vector3d::Zero());
  kinematics.update(JointVector::Zero());
  const Vector3d base_m = kinematics.base_position_m();
  const Vector3d flange_m = base_m + Vector3d(0.0, 0.0, 0.3105 + 0.4 + 0.39 + 0.078);
  EXPECT_LT((kinematics.end_effector_position_m() - flange_m).norm(), 1e-12);
  // The platform's x axis now points up, and its y axis along +x. The index finger lies
  // stretched along its -y, 55 + 25 + 35 mm from where it is mounted.
  EXPECT_LT(
      (kinematics.tip_position_m()[3] - flange_m - Vector3d(0.1233 - 0.115, 0.007, 0.0527))
          .norm(),
      1e-12);
  // The index finger is raised by a quarter turn at its base, so it points up.
  JointVector pose_rad = JointVector::Zero();
  pose_rad[core::finger_joint(3, 1)] = 0.5 * std::numbers::pi;
  kinematics.update(pose_rad);
  EXPECT_LT(
      (kinematics.tip_position_m()[3] - flange_m - Vector3d(0.1233, 0.007, 0.0527 + 0.115))
          .norm(),
      1e-12);
  // Its proximal and its distal joint are bent by a quarter turn each, so it folds back on
  // itself.
  pose_rad.setZero();
  pose_rad[core::finger_joint(3, 2)] = 0.5 * std::numbers::pi;
  kinematics.update(pose_rad);
  EXPECT_LT((kinematics.tip_position_m()[3] - flange_m -
             Vector3d(0.1233 - 0.055 + 0.035, 0.007, 0.0527 + 0.025))
                .norm(),
            1e-12);
}

TEST(ExoskeletonKinematics, TipsAndJacobiansAreThoseOfTheSimulatedWorld) {
  ExoskeletonKinematics kinematics(Vector3d(0.05, 0.1, -0.2));
  Reference reference(kinematics.base_position_m());
  core::RandomStream random(1, "pose");
  for (int pose = 0; pose < kNumPoses; ++pose) {
    const JointVector pose_rad = random_pose_rad(random);
    kinematics.update(pose_rad);
    reference.pose(pose_rad);
    ASSERT_LT((kinematics.end_effector_position_m() - reference.body_m("platform")).norm(),
              1e-9);
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      ASSERT_LT((kinematics.tip_position_m()[point] - reference.tip_m(point)).norm(), 1e-9);
      Eigen::Matrix<double, 3, core::kNumJoints> ours;
      ours.setZero();
      ours.leftCols<core::kNumArmJoints>() = kinematics.arm_jacobian(point);
      ours.middleCols<3>(core::finger_joint(point, 0)) = kinematics.finger_jacobian(point);
      ASSERT_LT((ours - reference.tip_jacobian(point)).norm(), 1e-9) << "point " << point;
    }
  }
}

TEST(ExoskeletonKinematics, GravityIsThatOfTheSimulatedWorld) {
  ExoskeletonKinematics kinematics(Vector3d::Zero());
  Reference reference(kinematics.base_position_m());
  core::RandomStream random(2, "pose");
  for (int pose = 0; pose < kNumPoses; ++pose) {
    const JointVector pose_rad = random_pose_rad(random);
    kinematics.update(pose_rad);
    reference.pose(pose_rad);
    ASSERT_LT((kinematics.gravity_torque_n_m() - reference.gravity_torque_n_m()).norm(), 1e-9);
  }
}

TEST(ExoskeletonKinematics, JacobiansAreTheSlopesOfThePositions) {
  ExoskeletonKinematics kinematics(Vector3d::Zero());
  core::RandomStream random(3, "pose");
  constexpr double kStep_rad = 1e-6;
  const JointVector pose_rad = random_pose_rad(random);
  kinematics.update(pose_rad);
  const ExoskeletonKinematics at = kinematics;
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    JointVector velocity_rad_per_s = JointVector::Zero();
    velocity_rad_per_s[joint] = 1.0;
    const core::PointVectors slope = at.tip_velocity_m_per_s(velocity_rad_per_s);
    kinematics.update(pose_rad + kStep_rad * velocity_rad_per_s);
    core::PointVectors above = kinematics.tip_position_m();
    kinematics.update(pose_rad - kStep_rad * velocity_rad_per_s);
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      const Vector3d difference =
          (above[point] - kinematics.tip_position_m()[point]) / (2.0 * kStep_rad);
      EXPECT_LT((slope[point] - difference).norm(), 1e-8) << core::kJointNames[joint];
    }
  }
}

TEST(ExoskeletonKinematics, ThePlatformTurnsAsItsVelocitySays) {
  ExoskeletonKinematics kinematics(Vector3d::Zero());
  EXPECT_LT(kinematics.platform_turn_rad().norm(), 1e-12);
  constexpr double kStep_rad = 1e-4;
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    JointVector velocity_rad_per_s = JointVector::Zero();
    velocity_rad_per_s[joint] = 1.0;
    const Vector3d turning_rad_per_s =
        kinematics.platform_velocity_rad_per_s(velocity_rad_per_s);
    ExoskeletonKinematics later = kinematics;
    later.update(neutral_pose_rad() + kStep_rad * velocity_rad_per_s);
    EXPECT_LT((later.platform_turn_rad() / kStep_rad - turning_rad_per_s).norm(), 1e-6)
        << core::kJointNames[joint];
    // A moment does its work on this turn.
    const Vector3d moment_n_m(0.3, -0.2, 0.5);
    EXPECT_NEAR(kinematics.torque_of_moment_n_m(moment_n_m)[joint],
                moment_n_m.dot(turning_rad_per_s), 1e-12);
  }
}

TEST(ExoskeletonKinematics, TorquesDoTheWorkOfTheForces) {
  ExoskeletonKinematics kinematics(Vector3d::Zero());
  core::RandomStream random(4, "pose");
  for (int pose = 0; pose < 20; ++pose) {
    kinematics.update(random_pose_rad(random));
    core::PointVectors force_n;
    for (Vector3d& force : force_n) {
      force = {random.normal(), random.normal(), random.normal()};
    }
    JointVector velocity_rad_per_s;
    for (double& value : velocity_rad_per_s) value = random.normal();
    double power_w = 0.0;
    const core::PointVectors velocity = kinematics.tip_velocity_m_per_s(velocity_rad_per_s);
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      power_w += force_n[point].dot(velocity[point]);
    }
    EXPECT_NEAR(kinematics.torque_of_n_m(force_n).dot(velocity_rad_per_s), power_w, 1e-12);
  }
}

}  // namespace kinematics_test
}  // namespace jnd::device
