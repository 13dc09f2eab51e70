#include "device/exoskeleton/mujoco_world.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "device/exoskeleton/kinematics.h"
#include "device/exoskeleton/mujoco_fixture.h"
#include "support/allocation_counter.h"

namespace jnd::device {
namespace mujoco_world_test {

using Eigen::Vector3d;

/// A world, and the control that holds its weight.
struct Apparatus {
  explicit Apparatus(MujocoWorld::Parameters parameters = {})
      : kinematics(parameters.home_m), world([&] {
          parameters.base_m = kinematics.base_position_m();
          return parameters;
        }()) {}

  /// Holds the weight for one step, and adds these torques and this pull.
  bool step(const JointVector& torque_n_m = JointVector::Zero(),
            const Vector3d& pull_n = Vector3d::Zero()) {
    kinematics.update(world.encoder_position_rad());
    return world.step(kinematics.gravity_torque_n_m() + torque_n_m, pull_n);
  }
  bool pull(const Vector3d& force_n) { return step(JointVector::Zero(), force_n); }
  void rest(int num_steps) {
    for (int i = 0; i < num_steps; ++i) ASSERT_TRUE(step());
  }

  ExoskeletonKinematics kinematics;
  MujocoWorld world;
};

constexpr std::array<bool, core::kNumContactPoints> kNoneAttached{};
constexpr std::array<bool, core::kNumArmJoints> kAllLocked = {true, true, true, true,
                                                              true, true, true};

TEST(MujocoWorld, StandsStillWhenItsWeightIsHeld) {
  Apparatus apparatus;
  apparatus.rest(2000);
  EXPECT_LT((apparatus.world.encoder_position_rad() - neutral_pose_rad()).cwiseAbs().maxCoeff(),
            1e-3);
  EXPECT_LT((apparatus.world.hand_position_m() - Vector3d(0.0, 0.0, -0.15)).norm(), 1e-4);
  EXPECT_LT(apparatus.world.hand_velocity_m_per_s().norm(), 1e-4);
}

TEST(MujocoWorld, EncodersTellStepsOfTheirResolution) {
  Apparatus apparatus;
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(apparatus.pull({5.0, 2.0, 1.0}));
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    const double steps = apparatus.world.encoder_position_rad()[joint] /
                         (joint < core::kNumArmJoints ? 1e-5 : 5e-5);
    EXPECT_NEAR(steps, std::round(steps), 1e-6) << core::kJointNames[joint];
  }
}

TEST(MujocoWorld, TheDistalJointFollowsTheProximalOne) {
  Apparatus apparatus({.attached = kNoneAttached});
  JointVector torque_n_m = JointVector::Zero();
  torque_n_m[core::finger_joint(3, 2)] = 0.06;
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(apparatus.step(torque_n_m));
  const mjModel_& model = apparatus.world.model();
  const auto at = [&](const char* name) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, name);
    return apparatus.world.data().qpos[model.jnt_qposadr[joint]];
  };
  EXPECT_GT(at("index_proximal"), kNeutralProximal_rad + 0.05);
  EXPECT_NEAR(at("index_distal"), at("index_proximal"), 0.002);
}

/// The force at which the loaded joint starts to turn, in a direction that loads only this one
/// of the finger's joints.
double break_away_n(int point, int joint) {
  Apparatus apparatus({.arm_joint_locked = kAllLocked, .attached = kNoneAttached});
  apparatus.rest(200);
  const Eigen::Matrix3d jacobian = apparatus.kinematics.finger_jacobian(point);
  const Vector3d direction = jacobian.transpose().inverse().col(joint);
  const double lever_m = jacobian.col(joint).norm();
  const int index = core::finger_joint(point, joint);
  const double start_rad = apparatus.world.encoder_position_rad()[index];
  for (double torque_n_m = 0.0; torque_n_m < 0.2; torque_n_m += 2e-5) {
    apparatus.world.load_tip(point, torque_n_m * direction);
    EXPECT_TRUE(apparatus.step());
    if (std::abs(apparatus.world.encoder_position_rad()[index] - start_rad) > 0.002) {
      return torque_n_m / lever_m;
    }
  }
  return 0.0;
}

TEST(MujocoWorld, AFingerStartsToMoveAtTheForcesOfTheThesis) {
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    EXPECT_NEAR(break_away_n(point, 0), 0.83, 0.02) << "abduction " << point;
    EXPECT_NEAR(break_away_n(point, 1), 0.40, 0.015) << "extension " << point;
  }
}

TEST(MujocoWorld, TorqueSensorsErrByTheirGains) {
  // All motors hold the pose, and a load hangs on the tip. The torques that the sensors measure
  // beyond the weight are the load's, but for the gain.
  Apparatus apparatus({.arm_joint_locked = kAllLocked, .attached = kNoneAttached});
  constexpr int kPoint = 3;
  const Vector3d load_n(0.2, 0.15, -0.1);
  apparatus.rest(100);
  core::PointVectors opposing_n = core::zero_vectors();
  opposing_n[kPoint] = -load_n;
  apparatus.world.load_tip(kPoint, load_n);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(apparatus.step(apparatus.kinematics.torque_of_n_m(opposing_n)));
  }
  const JointVector expected_n_m = apparatus.kinematics.torque_of_n_m(opposing_n) +
                                   apparatus.kinematics.gravity_torque_n_m();
  const double errors[] = {0.0356, 0.0889, 0.0083};
  for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
    const int index = core::finger_joint(kPoint, joint);
    const double gain = apparatus.world.sensor_torque_n_m()[index] / expected_n_m[index];
    EXPECT_NEAR(std::abs(gain - 1.0), errors[joint], 0.002) << joint;
  }
}

TEST(MujocoWorld, TorqueSensorsSitBehindTheFrictionOfTheGear) {
  // A motor that does not overcome the friction moves nothing: no torque arrives at the link.
  Apparatus apparatus({.arm_joint_locked = kAllLocked, .attached = kNoneAttached});
  const int joint = core::finger_joint(2, 1);
  apparatus.rest(100);
  const double before_n_m = apparatus.world.sensor_torque_n_m()[joint];
  JointVector torque_n_m = JointVector::Zero();
  torque_n_m[joint] = 0.03;
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(apparatus.step(torque_n_m));
  EXPECT_NEAR(apparatus.world.sensor_torque_n_m()[joint], before_n_m, 0.002);
}

TEST(MujocoWorld, ArmJointsCanBeLocked) {
  for (const bool locked : {true, false}) {
    Apparatus apparatus({.arm_joint_locked = {locked}});
    for (int i = 0; i < 500; ++i) ASSERT_TRUE(apparatus.pull({10.0, 0.0, 0.0}));
    const double turned_rad =
        std::abs(apparatus.world.encoder_position_rad()[0] - neutral_pose_rad()[0]);
    if (locked) {
      EXPECT_LT(turned_rad, 0.003);
    } else {
      EXPECT_GT(turned_rad, 0.02);
    }
  }
}

TEST(MujocoWorld, AMagnetLetsGoAboveItsForceAndNotBelow) {
  for (const double push_n : {4.0, 8.0}) {
    Apparatus apparatus({.arm_joint_locked = kAllLocked, .break_away_n = 6.0});
    apparatus.rest(100);
    core::PointVectors force_n = core::zero_vectors();
    // The index finger pushes away from the hand, and the person holds.
    for (int i = 0; i < 300; ++i) {
      force_n[3] = {-push_n * std::min(1.0, i / 200.0), 0.0, 0.0};
      ASSERT_TRUE(apparatus.step(apparatus.kinematics.torque_of_n_m(force_n), -force_n[3]));
    }
    EXPECT_EQ(apparatus.world.attached()[3], push_n < 6.0);
    EXPECT_TRUE(apparatus.world.attached()[2]);
    EXPECT_EQ(apparatus.world.magnet_force_on_hand_n()[3].norm() > 0.0, push_n < 6.0);
  }
}

TEST(MujocoWorld, AMagnetHoldsAFingerThatIsPressedOntoTheHand) {
  Apparatus apparatus({.arm_joint_locked = kAllLocked, .break_away_n = 6.0});
  apparatus.rest(100);
  core::PointVectors force_n = core::zero_vectors();
  for (int i = 0; i < 300; ++i) {
    force_n[3] = {8.0 * std::min(1.0, i / 200.0), 0.0, 0.0};
    ASSERT_TRUE(apparatus.step(apparatus.kinematics.torque_of_n_m(force_n), -force_n[3]));
  }
  EXPECT_TRUE(apparatus.world.attached()[3]);
}

TEST(MujocoWorld, NoWorldBeginsWithATug) {
  for (const double break_away_n : {0.2, 1.0}) {
    Apparatus apparatus({.break_away_n = break_away_n});
    EXPECT_EQ(apparatus.world.attached(), core::kAllAttached) << break_away_n;
    for (const Eigen::Vector3d& force_n : apparatus.world.magnet_force_on_hand_n()) {
      EXPECT_LT(force_n.norm(), 0.05);
    }
  }
}

TEST(MujocoWorld, WhatAFingerPushesArrivesAtTheHand) {
  Apparatus apparatus({.arm_joint_locked = kAllLocked});
  core::PointVectors force_n = core::zero_vectors();
  force_n[0] = {3.0, -1.0, 2.0};
  for (int i = 0; i < 1500; ++i) {
    ASSERT_TRUE(apparatus.step(apparatus.kinematics.torque_of_n_m(force_n), -force_n[0]));
  }
  // The difference is what friction holds back.
  EXPECT_LT((apparatus.world.magnet_force_on_hand_n()[0] - force_n[0]).norm(), 1.1);
}

TEST(MujocoWorld, ALooseFingerIsGuidedBackToItsMagnet) {
  Apparatus apparatus;
  apparatus.rest(100);
  apparatus.world.detach(4);
  core::PointVectors force_n = core::zero_vectors();
  force_n[4] = {-2.0, 0.5, 1.5};
  for (int i = 0; i < 120; ++i) {
    ASSERT_TRUE(apparatus.step(apparatus.kinematics.torque_of_n_m(force_n)));
  }
  EXPECT_FALSE(apparatus.world.attached()[4]);
  const Vector3d away_m =
      apparatus.kinematics.tip_position_m()[4] - apparatus.world.hand_position_m();
  apparatus.world.attach(4);
  EXPECT_FALSE(apparatus.world.attached()[4]) << "not before it is there";
  apparatus.rest(3000);
  EXPECT_TRUE(apparatus.world.attached()[4]);
  const Vector3d back_m =
      apparatus.kinematics.tip_position_m()[4] - apparatus.world.hand_position_m();
  EXPECT_GT((away_m - back_m).norm(), 0.01);
  EXPECT_LT((back_m - Vector3d(0.0, 0.064, -0.018)).norm(), 0.005);
}

TEST(MujocoWorld, LooseFingersComeToRest) {
  Apparatus apparatus({.attached = kNoneAttached});
  core::PointVectors force_n = core::zero_vectors();
  force_n.fill({0.0, 1.0, 1.5});
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(apparatus.step(apparatus.kinematics.torque_of_n_m(force_n)));
  }
  apparatus.rest(3000);
  const JointVector before_rad = apparatus.world.encoder_position_rad();
  apparatus.rest(200);
  EXPECT_LT((apparatus.world.encoder_position_rad() - before_rad).cwiseAbs().maxCoeff(), 0.002);
}

TEST(MujocoWorld, WhatIsNoNumberInvalidatesItForGoodUntilReset) {
  Apparatus apparatus;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(apparatus.pull({nan, 0.0, 0.0}));
  EXPECT_FALSE(apparatus.world.is_valid());
  EXPECT_FALSE(apparatus.step());
  EXPECT_TRUE(apparatus.world.encoder_position_rad().allFinite());
  apparatus.world.reset();
  EXPECT_TRUE(apparatus.step());
  JointVector torque_n_m = JointVector::Zero();
  torque_n_m[9] = 1e300;
  EXPECT_FALSE(apparatus.step(torque_n_m));
}

TEST(MujocoWorld, AStepTakesNothingFromTheHeap) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  Apparatus apparatus;
  apparatus.rest(10);
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(apparatus.pull({5.0, 0.0, 0.0}));
  apparatus.world.detach(2);
  apparatus.rest(10);
  apparatus.world.attach(2);
  apparatus.rest(10);
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_EQ(counter.frees(), 0U);
}

TEST(MujocoWorld, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Parameters = MujocoWorld::Parameters;
  EXPECT_THROW(MujocoWorld(Parameters{.period_s = nan}), core::Error);
  EXPECT_THROW(MujocoWorld(Parameters{.home_m = {nan, 0.0, 0.0}}), core::Error);
  EXPECT_THROW(MujocoWorld(Parameters{.base_m = {nan, 0.0, 0.0}}), core::Error);
  EXPECT_THROW(MujocoWorld(Parameters{.break_away_n = 0.0}), core::Error);
}

}  // namespace mujoco_world_test
}  // namespace jnd::device
