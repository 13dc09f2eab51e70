#include "device/exoskeleton/torque_stages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random_stream.h"

namespace jnd::device {
namespace torque_stages_test {

constexpr LimitProtection kProtection = {.low_rad = -0.2,
                                         .high_rad = 0.3,
                                         .stiffness_n_m_per_rad = 2.0,
                                         .damping_n_m_s_per_rad = 0.1,
                                         .max_torque_n_m = 10.0};

TEST(LimitProtection, LeavesAJointAloneWithinItsRange) {
  for (const double position_rad : {-0.2, 0.0, 0.3}) {
    EXPECT_EQ(kProtection.torque_n_m(position_rad, 5.0), 0.0);
    EXPECT_EQ(kProtection.torque_n_m(position_rad, -5.0), 0.0);
  }
}

TEST(LimitProtection, PushesBackLikeASpringAndADamper) {
  // 0.1 rad beyond the limit, the damper works in full.
  EXPECT_NEAR(kProtection.torque_n_m(0.4, 0.0), -0.2, 1e-15);
  EXPECT_NEAR(kProtection.torque_n_m(0.4, 3.0), -0.5, 1e-15);
  EXPECT_NEAR(kProtection.torque_n_m(-0.3, 0.0), 0.2, 1e-15);
  EXPECT_NEAR(kProtection.torque_n_m(-0.3, -3.0), 0.5, 1e-15);
}

TEST(LimitProtection, NeitherPullsTowardsTheStopNorJumpsAtItsEdge) {
  core::RandomStream random(1, "joint");
  for (int i = 0; i < 1000; ++i) {
    const double position_rad = random.uniform(-1.0, 1.0);
    const double torque_n_m = kProtection.torque_n_m(position_rad, random.normal(0.0, 20.0));
    EXPECT_LE(torque_n_m * (position_rad - 0.05), 0.0);
  }
  EXPECT_NEAR(kProtection.torque_n_m(0.3 + 1e-9, 10.0), 0.0, 1e-7);
}

TEST(LimitProtection, NeverGivesMoreThanItsMost) {
  EXPECT_EQ(kProtection.torque_n_m(100.0, 0.0), -10.0);
  EXPECT_EQ(kProtection.torque_n_m(0.4, 1e9), -10.0);
  EXPECT_EQ(kProtection.torque_n_m(-100.0, 0.0), 10.0);
}

TEST(LimitProtection, EveryJointIsFreeInTheNeutralPoseAndHeldBeforeItsStop) {
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    const LimitProtection protection = default_protection(joint);
    const double neutral_rad = neutral_pose_rad()[joint];
    EXPECT_GT(neutral_rad, protection.low_rad + 0.1) << core::kJointNames[joint];
    EXPECT_LT(neutral_rad, protection.high_rad - 0.1) << core::kJointNames[joint];
    EXPECT_GT(protection.low_rad, range_of(joint).low_rad) << core::kJointNames[joint];
    EXPECT_LT(protection.high_rad, range_of(joint).high_rad) << core::kJointNames[joint];
  }
}

TEST(FrictionCompensation, HelpsTheMotionByLessThanTheFriction) {
  EXPECT_EQ(friction_compensation_n_m(0.05, 0.5, 0.0, 0.2), 0.0);
  EXPECT_NEAR(friction_compensation_n_m(0.05, 0.5, 0.2, 0.2), 0.025 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(friction_compensation_n_m(0.05, 0.5, 100.0, 0.2), 0.025, 1e-6);
  EXPECT_LT(friction_compensation_n_m(0.05, 0.5, -100.0, 0.2), 0.0);
}

TEST(HumanTorque, IsWhatARestingLinkHoldsBeyondItsWeight) {
  // The person pushes down with 0.3 N m on a link that weighs 0.2 N m, so the sensor holds up
  // 0.5 N m.
  EXPECT_NEAR(human_torque_n_m(JointVector::Constant(0.5), JointVector::Constant(0.2))[9], -0.3,
              1e-15);
}

TEST(MaxTorque, LetsAFingerPushWithTenNewtonAndNotMuchMore) {
  const JointVector max_n_m = max_torque_n_m();
  EXPECT_EQ(clamped(JointVector::Constant(1e9), max_n_m), max_n_m);
  EXPECT_EQ(clamped(JointVector::Constant(-1e9), max_n_m), -max_n_m);
  // The torque is that of 10 N across a stretched finger of 115 mm.
  for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
    EXPECT_GE(max_n_m[core::finger_joint(2, joint)], 1.15);
    EXPECT_LE(max_n_m[core::finger_joint(2, joint)], 2.0);
  }
}

}  // namespace torque_stages_test
}  // namespace jnd::device
