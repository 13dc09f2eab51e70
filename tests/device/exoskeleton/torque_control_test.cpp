#include "device/exoskeleton/torque_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::device {
namespace torque_control_test {

constexpr double kPeriod_s = 0.001;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The neutral pose at rest, as the sensors measure it.
struct Rest {
  Rest() {
    measured.position_rad = neutral_pose_rad();
    measured.torque_n_m = kinematics.gravity_torque_n_m();
  }
  ExoskeletonKinematics kinematics{Eigen::Vector3d::Zero()};
  TorqueControl::Measured measured;
};

core::PointVectors one_force(double x_n) {
  core::PointVectors force_n = core::zero_vectors();
  force_n[3] = {x_n, 0.0, 0.0};
  return force_n;
}

TEST(TorqueControl, AtRestWithoutForceItCarriesTheWeightAlone) {
  Rest rest;
  TorqueControl control({}, kPeriod_s);
  const JointVector torque_n_m =
      control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors());
  EXPECT_LT((torque_n_m - rest.kinematics.gravity_torque_n_m()).norm(), 1e-12);
  EXPECT_EQ(control.fault(), core::Fault::kNone);
}

TEST(TorqueControl, AForceComesOutAtItsFingerAndAtTheArm) {
  Rest rest;
  TorqueControl control({}, kPeriod_s);
  const JointVector rendered_n_m =
      control.torque_n_m(rest.kinematics, rest.measured, one_force(2.0)) -
      rest.kinematics.gravity_torque_n_m();
  // 2 N act towards the hand (+x). Worked by hand, the finger reaches 64.25 mm along before it.
  EXPECT_NEAR(rendered_n_m[core::finger_joint(3, 1)], 2.0 * 0.06425, 1e-5);
  EXPECT_NEAR(rendered_n_m[core::finger_joint(3, 0)], 0.0, 1e-12);
  // The first axis of the arm is upright, so its torque is the force times the distance in y.
  const double lever_m =
      rest.kinematics.tip_position_m()[3].y() - rest.kinematics.base_position_m().y();
  EXPECT_NEAR(rendered_n_m[0], -2.0 * lever_m, 1e-12);
  for (const int other : {0, 1, 2, 4}) {
    EXPECT_NEAR(rendered_n_m.segment<3>(core::finger_joint(other, 0)).norm(), 0.0, 1e-15);
  }
}

TEST(TorqueControl, FeedForwardHelpsThePersonByItsGain) {
  Rest rest;
  TorqueControl control({.feed_forward_gain_ratio = 0.5}, kPeriod_s);
  // The person pushes the extension of the index finger by 0.1 N m, and the sensor holds it.
  rest.measured.torque_n_m[core::finger_joint(3, 1)] -= 0.1;
  JointVector torque_n_m;
  for (int tick = 0; tick < 1000; ++tick) {
    torque_n_m = control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors());
  }
  const JointVector helped_n_m = torque_n_m - rest.kinematics.gravity_torque_n_m();
  EXPECT_NEAR(helped_n_m[core::finger_joint(3, 1)], 0.05, 1e-9);
  EXPECT_NEAR(helped_n_m.norm(), 0.05, 1e-9);
}

TEST(TorqueControl, FeedForwardDividesTheRenderedForceUnlessThatIsMadeUpFor) {
  for (const bool compensates : {false, true}) {
    Rest rest;
    TorqueControl control(
        {.feed_forward_gain_ratio = 0.5, .compensates_feed_forward = compensates}, kPeriod_s);
    const JointVector gravity_n_m = rest.kinematics.gravity_torque_n_m();
    JointVector torque_n_m = gravity_n_m;
    // The hand holds still, whatever the finger does.
    for (int tick = 0; tick < 2000; ++tick) {
      rest.measured.torque_n_m = torque_n_m;
      torque_n_m = control.torque_n_m(rest.kinematics, rest.measured, one_force(2.0));
    }
    const double at_index_n_m =
        torque_n_m[core::finger_joint(3, 1)] - gravity_n_m[core::finger_joint(3, 1)];
    EXPECT_NEAR(at_index_n_m, 2.0 * 0.06425 / (compensates ? 1.0 : 1.5), 1e-5);
  }
}

TEST(TorqueControl, CompensatesTheFrictionOfMovingFingers) {
  Rest rest;
  TorqueControl control(
      {.friction_compensation_ratio = 0.5, .platform_damping_n_m_s_per_rad = 0.0}, kPeriod_s);
  rest.measured.velocity_rad_per_s.setConstant(50.0);
  const JointVector torque_n_m =
      control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()) -
      rest.kinematics.gravity_torque_n_m();
  EXPECT_NEAR(torque_n_m[core::finger_joint(0, 0)], 0.5 * kFingerFriction_n_m[0], 1e-5);
  EXPECT_NEAR(torque_n_m[core::finger_joint(4, 2)], 0.5 * kFingerFriction_n_m[2], 1e-5);
  EXPECT_LT(torque_n_m.head<core::kNumArmJoints>().norm(), 1e-12);
}

TEST(TorqueControl, PushesAFingerBackBeforeItsStop) {
  Rest rest;
  TorqueControl control({}, kPeriod_s);
  const int joint = core::finger_joint(1, 1);
  rest.measured.position_rad[joint] = range_of(joint).high_rad - 0.05;
  const JointVector torque_n_m =
      control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()) -
      rest.kinematics.gravity_torque_n_m();
  EXPECT_LT(torque_n_m[joint], -0.3);
  EXPECT_GE(torque_n_m[joint], -0.35) << "a person's finger is in it";
}

TEST(TorqueControl, TurnsThePlatformBackUnlessToldNotTo) {
  Rest rest;
  TorqueControl control(
      {.platform_stiffness_n_m_per_rad = 10.0, .platform_damping_n_m_s_per_rad = 2.0},
      kPeriod_s);
  // Only the last joint turns about the flange, which points along x.
  rest.measured.position_rad[6] += 0.1;
  rest.kinematics.update(rest.measured.position_rad);
  rest.measured.velocity_rad_per_s[6] = 0.5;
  const JointVector torque_n_m =
      control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()) -
      rest.kinematics.gravity_torque_n_m();
  EXPECT_NEAR(torque_n_m[6], -(10.0 * std::sin(0.1) + 2.0 * 0.5), 1e-9);
  TorqueControl free(
      {.platform_stiffness_n_m_per_rad = 0.0, .platform_damping_n_m_s_per_rad = 0.0},
      kPeriod_s);
  EXPECT_LT((free.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()) -
             rest.kinematics.gravity_torque_n_m())
                .norm(),
            1e-12);
}

TEST(TorqueControl, ThePlatformIsTurnedBackByNoMoreThanItsMost) {
  Rest rest;
  TorqueControl control({.max_platform_moment_n_m = 3.0}, kPeriod_s);
  rest.measured.position_rad[6] += 0.1;
  rest.measured.velocity_rad_per_s[6] = 5.0;
  rest.kinematics.update(rest.measured.position_rad);
  const JointVector torque_n_m =
      control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()) -
      rest.kinematics.gravity_torque_n_m();
  EXPECT_NEAR(torque_n_m[6], -3.0, 1e-9);
}

TEST(TorqueControl, NoForceIsTooLargeForTheClamp) {
  Rest rest;
  TorqueControl control({}, kPeriod_s);
  core::PointVectors force_n;
  force_n.fill(Eigen::Vector3d(1e12, -1e12, 1e12));
  const JointVector torque_n_m = control.torque_n_m(rest.kinematics, rest.measured, force_n);
  EXPECT_TRUE((torque_n_m.cwiseAbs().array() <= max_torque_n_m().array()).all());
}

/// Returns whether these torques hold the robot's weight and do nothing else.
bool is_weight_alone(const JointVector& torque_n_m, const Rest& rest) {
  return (torque_n_m - rest.kinematics.gravity_torque_n_m()).norm() < 1e-12;
}

TEST(TorqueControl, WithoutForceNoPoseIsHeldAgainstTheHandByMoreThanAFewNewton) {
  core::RandomStream random(1, "pose");
  for (int i = 0; i < 2000; ++i) {
    Rest rest;
    for (int joint = 0; joint < core::kNumJoints; ++joint) {
      const JointRange range = range_of(joint);
      rest.measured.position_rad[joint] = random.uniform(range.low_rad, range.high_rad);
      rest.measured.velocity_rad_per_s[joint] = random.normal(0.0, 3.0);
    }
    rest.kinematics.update(rest.measured.position_rad);
    TorqueControl control({}, kPeriod_s);
    const JointVector torque_n_m =
        control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()) -
        rest.kinematics.gravity_torque_n_m();
    // The limit is 5 N on a lever of 7 cm, and less than the friction that is compensated.
    for (int joint = core::kNumArmJoints; joint < core::kNumJoints; ++joint) {
      ASSERT_LE(std::abs(torque_n_m[joint]), 0.35 + 0.1) << core::kJointNames[joint];
    }
  }
}

TEST(TorqueControl, ABrokenTorqueSensorPushesNoMoreThanItsMotorTwice) {
  for (const double broken_n_m : {500.0, -500.0}) {
    Rest rest;
    rest.measured.torque_n_m.array() += broken_n_m;
    TorqueControl control({.feed_forward_gain_ratio = 1.0}, kPeriod_s);
    JointVector torque_n_m;
    for (int tick = 0; tick < 500; ++tick) {
      torque_n_m = control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors());
    }
    EXPECT_TRUE((torque_n_m.cwiseAbs().array() <= max_torque_n_m().array()).all());
    // After the fault ends, its effect is gone within a few time constants of the filter.
    rest.measured.torque_n_m = rest.kinematics.gravity_torque_n_m();
    for (int tick = 0; tick < 200; ++tick) {
      torque_n_m = control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors());
    }
    EXPECT_LT((torque_n_m - rest.kinematics.gravity_torque_n_m()).cwiseAbs().maxCoeff(), 0.01);
  }
}

TEST(TorqueControl, AForceThatIsNoNumberLeavesTheWeightHeldAndNothingElseUntilRearmed) {
  for (const double broken : {kNan, kInfinity, -kInfinity}) {
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      for (int axis = 0; axis < 3; ++axis) {
        Rest rest;
        TorqueControl control({.feed_forward_gain_ratio = 0.5}, kPeriod_s);
        core::PointVectors force_n = core::zero_vectors();
        force_n[point][axis] = broken;
        EXPECT_TRUE(
            is_weight_alone(control.torque_n_m(rest.kinematics, rest.measured, force_n), rest));
        EXPECT_EQ(control.fault(), core::Fault::kNonFiniteForce);
        EXPECT_TRUE(is_weight_alone(
            control.torque_n_m(rest.kinematics, rest.measured, one_force(1.0)), rest));
        control.rearm();
        EXPECT_FALSE(is_weight_alone(
            control.torque_n_m(rest.kinematics, rest.measured, one_force(1.0)), rest));
        EXPECT_EQ(control.fault(), core::Fault::kNone);
      }
    }
  }
}

TEST(TorqueControl, APoseThatIsNoNumberMeansNoTorqueAtAll) {
  Rest rest;
  rest.measured.position_rad[3] = kNan;
  rest.kinematics.update(rest.measured.position_rad);
  TorqueControl control({}, kPeriod_s);
  EXPECT_TRUE(
      control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()).isZero(0.0));
  EXPECT_EQ(control.fault(), core::Fault::kNonFiniteState);
}

TEST(TorqueControl, ASensorThatIsNoNumberLeavesTheWeightHeldAndIsForgotten) {
  for (const double broken : {kNan, kInfinity}) {
    for (int joint = 0; joint < core::kNumJoints; ++joint) {
      Rest rest;
      TorqueControl control({.feed_forward_gain_ratio = 0.5}, kPeriod_s);
      const TorqueControl::Measured sound = rest.measured;
      rest.measured.torque_n_m[joint] = broken;
      EXPECT_TRUE(is_weight_alone(
          control.torque_n_m(rest.kinematics, rest.measured, core::zero_vectors()), rest));
      EXPECT_EQ(control.fault(), core::Fault::kNonFiniteState);
      control.rearm();
      const JointVector torque_n_m =
          control.torque_n_m(rest.kinematics, sound, core::zero_vectors());
      EXPECT_TRUE(torque_n_m.allFinite());
      EXPECT_EQ(control.fault(), core::Fault::kNone);
    }
  }
}

TEST(TorqueControl, NamesTheParameterItRejects) {
  using Parameters = TorqueControl::Parameters;
  EXPECT_THROW(TorqueControl(Parameters{.feed_forward_gain_ratio = kNan}, kPeriod_s),
               core::Error);
  EXPECT_THROW(TorqueControl(Parameters{.feed_forward_gain_ratio = 50.0}, kPeriod_s),
               core::Error)
      << "sensor and motor would swing up";
  EXPECT_THROW(TorqueControl(Parameters{.feed_forward_cutoff_hz = 0.0}, kPeriod_s),
               core::Error);
  EXPECT_THROW(TorqueControl(Parameters{.friction_compensation_ratio = 1.0}, kPeriod_s),
               core::Error);
  EXPECT_THROW(TorqueControl(Parameters{.friction_speed_rad_per_s = 0.0}, kPeriod_s),
               core::Error);
  EXPECT_THROW(TorqueControl(Parameters{.platform_stiffness_n_m_per_rad = kNan}, kPeriod_s),
               core::Error);
  EXPECT_THROW(TorqueControl(Parameters{.platform_damping_n_m_s_per_rad = -1.0}, kPeriod_s),
               core::Error);
  EXPECT_THROW(TorqueControl(Parameters{.limit_protection_ratio = -1.0}, kPeriod_s),
               core::Error);
  EXPECT_THROW(TorqueControl({}, 0.0), core::Error);
}

}  // namespace torque_control_test
}  // namespace jnd::device
