#include "app/session/person_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/error.h"
#include "device/exoskeleton/kinematics.h"

namespace jnd::app {
namespace person_bench_test {

using device::FingerPose;

constexpr int kPoint = 3;

/// Returns a sample of a finger whose joints hold this weight. The gain of each sensor is wrong
/// by its own factor.
core::Sample sample_under(double weight_n) {
  core::Sample sample;
  const device::JointVector pose_rad = device::neutral_pose_rad();
  const auto expected_n_m =
      device::expected_torque_n_m(pose_rad, kPoint, {0.0, 0.0, -weight_n});
  constexpr double kGain[] = {1.04, 0.91, 1.01};
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    sample.joint_position_rad[joint] = static_cast<float>(pose_rad[joint]);
  }
  for (std::size_t joint = 0; joint < expected_n_m.size(); ++joint) {
    sample.joint_torque_n_m[core::finger_joint(kPoint, static_cast<int>(joint))] =
        static_cast<float>(kGain[joint] * expected_n_m[joint]);
  }
  return sample;
}

class PersonBenchTest : public ::testing::Test {
 protected:
  PersonBench bench(const std::string& answers, double hung_n = 1.0) {
    in_.str(answers);
    return {in_, out_, kPoint, 10,
            [this, hung_n](double duration_s,
                           const std::function<void(const core::Sample&)>& take) {
              measured_s_ = duration_s;
              for (int i = 0; i < num_samples_; ++i) take(sample_under(hung_n));
            }};
  }
  [[nodiscard]] int num_told(const std::string& words) const {
    int count = 0;
    const std::string text = out_.str();
    for (std::size_t at = text.find(words); at != std::string::npos;
         at = text.find(words, at + 1)) {
      ++count;
    }
    return count;
  }

  std::istringstream in_;
  std::ostringstream out_;
  double measured_s_ = 0.0;
  int num_samples_ = 3;
};

TEST_F(PersonBenchTest, TheContainersWeightIsTypedInGramsAndPullsInNewtons) {
  PersonBench person = bench("\n40.8\n41\n");
  EXPECT_NEAR(person.break_away_weight_n(FingerPose::k0, 1), 0.0408 * 9.81, 1e-12);
  EXPECT_NEAR(person.break_away_weight_n(FingerPose::k0, 2), 0.041 * 9.81, 1e-12);
  EXPECT_EQ(num_told("the device's finger for the index finger"), 1) << "told once a pose";
  EXPECT_EQ(num_told("at 0 degrees"), 1);
  EXPECT_EQ(num_told("1 of 10"), 1);
  EXPECT_EQ(num_told("2 of 10"), 1);
}

TEST_F(PersonBenchTest, WhatIsNoWeightIsAskedForAgain) {
  PersonBench person = bench("\nforty\n-3\n0\n2001\nnan\n12 g\n\n85\n");
  EXPECT_NEAR(person.break_away_weight_n(FingerPose::k90, 1), 0.085 * 9.81, 1e-12);
  EXPECT_EQ(num_told("Expected a weight in g"), 7);
}

TEST_F(PersonBenchTest, WeightsAreHungStepByStepAndMeasuredForTenSeconds) {
  PersonBench person = bench("\n", 0.05 * 9.81);
  const device::TorqueReading reading = person.torques_under(FingerPose::k90, 0.05 * 9.81);
  EXPECT_EQ(measured_s_, 10.0);
  EXPECT_EQ(num_told("Hang 50 g at the tip of the index finger"), 1);
  // In the neutral pose, a weight at the index finger loads the abduction joint alone.
  EXPECT_GT(std::abs(reading.expected_n_m[0]), 0.03);
  EXPECT_NEAR(reading.measured_n_m[0] / reading.expected_n_m[0], 1.04, 1e-5);
  EXPECT_NEAR(reading.expected_n_m[1], 0.0, 1e-6);
  EXPECT_NEAR(reading.measured_n_m[1], 0.0, 1e-6);
}

TEST_F(PersonBenchTest, TheEndOfTheAnswersEndsIt) {
  PersonBench person = bench("");
  EXPECT_THROW((void)person.break_away_weight_n(FingerPose::k0, 1), core::Error);
  EXPECT_THROW((void)person.torques_under(FingerPose::k0, 1.0), core::Error);
}

TEST_F(PersonBenchTest, ADeviceThatSaysNothingIsAnError) {
  num_samples_ = 0;
  PersonBench person = bench("\n");
  EXPECT_THROW((void)person.torques_under(FingerPose::k0, 1.0), core::Error);
}

}  // namespace person_bench_test
}  // namespace jnd::app
