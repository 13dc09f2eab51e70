#include "device/exoskeleton/characterization.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "device/exoskeleton/kinematics.h"

namespace jnd::device {
namespace characterization_test {

/// A finger that answers with values that the test knows.
class ToldBench final : public FingerBench {
 public:
  [[nodiscard]] double break_away_weight_n(FingerPose pose, int repetition) override {
    ++num_break_aways;
    const double along_n = joint_of(pose) == 0 ? 0.8 : 0.4;
    return (along_n + 0.01 * (repetition - 2)) / share_along_motion(pose);
  }
  [[nodiscard]] TorqueReading torques_under(FingerPose pose, double weight_n) override {
    weights_n.push_back(weight_n);
    // The readings of joints that the weight does not load must not matter.
    TorqueReading reading{.measured_n_m = {9.0, 9.0, 9.0}, .expected_n_m = {1.0, 1.0, 1.0}};
    const double expected_n_m = 0.1 * weight_n;
    if (joint_of(pose) == 0) {
      reading.measured_n_m[0] = 1.04 * expected_n_m;
      reading.expected_n_m[0] = expected_n_m;
    } else {
      // The lightest weight is left out, so its reading must not matter.
      const bool lightest = weight_n < 0.6;
      reading.measured_n_m = {9.0, (lightest ? 3.0 : 0.91) * expected_n_m, 1.01 * expected_n_m};
      reading.expected_n_m = {1.0, expected_n_m, expected_n_m};
    }
    return reading;
  }

  int num_break_aways = 0;
  std::vector<double> weights_n;
};

TEST(Characterization, FivePosesAndTheirRepetitionsComeToMeanAndSpread) {
  ToldBench bench;
  const FingerCharacter character = characterize_finger(bench, 3);
  EXPECT_EQ(bench.num_break_aways, 15);
  ASSERT_EQ(character.break_away.size(), 5U);
  EXPECT_EQ(character.break_away[4].pose, FingerPose::kInclined);
  // The force is along the motion, even if the finger is inclined.
  EXPECT_NEAR(character.break_away[4].force_n[0], 0.39, 1e-12);
  EXPECT_NEAR(character.extension_n.mean, 0.4, 1e-12);
  EXPECT_NEAR(character.abduction_n.mean, 0.8, 1e-12);
  // The values are three times 0.39, 0.40, 0.41, so the squares are 6 x 0.01^2 over 8.
  EXPECT_NEAR(character.extension_n.sd, std::sqrt(6e-4 / 8.0), 1e-12);
}

TEST(Characterization, SensorsAreJudgedInThePoseThatLoadsThemWithoutTheLightestWeight) {
  ToldBench bench;
  const FingerCharacter character = characterize_finger(bench, 1);
  ASSERT_EQ(bench.weights_n.size(), 10U);
  EXPECT_NEAR(bench.weights_n[0], 0.050 * 9.81, 1e-12);
  EXPECT_NEAR(bench.weights_n[4], 0.250 * 9.81, 1e-12);
  ASSERT_EQ(character.sensors.size(), 3U);
  EXPECT_NEAR(character.sensors[0].mean_relative_error_ratio, 0.04, 1e-12);
  EXPECT_NEAR(character.sensors[1].mean_relative_error_ratio, 0.09, 1e-12);
  EXPECT_NEAR(character.sensors[2].mean_relative_error_ratio, 0.01, 1e-12);
}

TEST(Characterization, TellsHowFarItIsAndCanBeStopped) {
  ToldBench bench;
  double last = 0.0;
  (void)characterize_finger(bench, 2, [&](double done) {
    EXPECT_GT(done, last);
    last = done;
  });
  EXPECT_NEAR(last, 1.0, 1e-12);
  ToldBench stopped;
  EXPECT_THROW((void)characterize_finger(stopped, 2,
                                         [](double done) {
                                           if (done > 0.1) throw std::runtime_error("stop");
                                         }),
               std::runtime_error);
  EXPECT_EQ(stopped.num_break_aways, 3) << "of 20 steps";
}

TEST(Characterization, AMeanWithoutCompanyHasNoSpread) {
  EXPECT_EQ(mean_and_spread({2.0}).mean, 2.0);
  EXPECT_EQ(mean_and_spread({2.0}).sd, 0.0);
  EXPECT_EQ(mean_and_spread({1.0, 3.0}).sd, std::sqrt(2.0));
}

TEST(Characterization, AMotorHoldsTheLinksAndTheWeightOnItsLever) {
  const JointVector pose_rad = neutral_pose_rad();
  const auto without_n_m = expected_torque_n_m(pose_rad, 3, Eigen::Vector3d::Zero());
  const auto with_n_m = expected_torque_n_m(pose_rad, 3, {0.0, 0.0, -1.0});
  // In the neutral pose, the index finger reaches 104.4 mm sideways from its base, so abduction
  // lifts it.
  ExoskeletonKinematics kinematics(Eigen::Vector3d::Zero());
  kinematics.update(pose_rad);
  const double lever_m = kinematics.finger_jacobian(3)(2, 0);
  EXPECT_GT(std::abs(lever_m), 0.05);
  EXPECT_NEAR(with_n_m[0] - without_n_m[0], lever_m, 1e-12);
  EXPECT_NEAR(without_n_m[0], kinematics.gravity_torque_n_m()[core::finger_joint(3, 0)], 1e-12);
}

/// Returns a sample as the sensors of ideal fingers would give it. Each finger gives the hand a
/// fifth of this force.
core::Sample sample_of(double speed_m_per_s, double against_n) {
  core::Sample sample;
  sample.attached_bits = 0b11111;
  const JointVector pose_rad = neutral_pose_rad();
  ExoskeletonKinematics kinematics(Eigen::Vector3d::Zero());
  kinematics.update(pose_rad);
  const Eigen::Vector3d ahead(0.6, 0.0, 0.8);
  core::PointVectors force_n;
  force_n.fill(-against_n / core::kNumContactPoints * ahead);
  const JointVector torque_n_m =
      kinematics.torque_of_n_m(force_n) + kinematics.gravity_torque_n_m();
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    sample.joint_position_rad[joint] = static_cast<float>(pose_rad[joint]);
    sample.joint_torque_n_m[joint] = static_cast<float>(torque_n_m[joint]);
  }
  for (core::PlainVector& tip : sample.tip_velocity_m_per_s) {
    tip = {speed_m_per_s * ahead.x(), 0.0, speed_m_per_s * ahead.z()};
  }
  return sample;
}

TEST(FreeSpaceRegression, FindsTheLineThatTheSensorsTell) {
  FreeSpaceRegression regression;
  for (const double speed_m_per_s : {0.1, 0.2, 0.4, 0.6}) {
    regression.add(sample_of(speed_m_per_s, 5.0 * speed_m_per_s + 0.7));
  }
  EXPECT_EQ(regression.num_samples(), 4);
  EXPECT_NEAR(regression.viscosity_n_s_per_m(), 5.0, 1e-4);
  EXPECT_NEAR(regression.friction_n(), 0.7, 1e-4);
}

TEST(FreeSpaceRegression, LeavesOutWhatTellsNothing) {
  FreeSpaceRegression regression;
  core::Sample dangling = sample_of(0.3, 2.0);
  dangling.attached_bits = 0b11110;
  regression.add(dangling);
  core::Sample stretched = sample_of(0.3, 2.0);
  stretched.joint_position_rad[core::finger_joint(2, 2)] = 0.0f;
  regression.add(stretched);
  EXPECT_EQ(regression.num_samples(), 0);
}

TEST(FreeSpaceRegression, AHandThatHardlyMovesSaysNothing) {
  FreeSpaceRegression regression;
  regression.add(sample_of(0.049, 100.0));
  EXPECT_EQ(regression.num_samples(), 0);
}

}  // namespace characterization_test
}  // namespace jnd::device
