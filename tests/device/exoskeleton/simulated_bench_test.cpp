#include "device/exoskeleton/simulated_bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "device/drawn_mass.h"
#include "device/haptic_loop.h"
#include "support/sanitizer.h"

namespace jnd::device {
namespace simulated_bench_test {

// The values with which the model is built (data/models/README.md).
constexpr double kExtension_n = 0.4, kAbduction_n = 0.83;
constexpr double kSensorError[] = {0.0356, 0.0889, 0.0083};

TEST(SimulatedBench, RecoversTheFrictionOfTheModelInEveryPose) {
  for (const int point : {0, 2, 3}) {
    SimulatedBench bench({.point = point});
    for (const FingerPose pose : {FingerPose::k0, FingerPose::k180, FingerPose::kInclined}) {
      const double along_n = share_along_motion(pose) * bench.break_away_weight_n(pose, 1);
      EXPECT_NEAR(along_n, kExtension_n, 0.1 * kExtension_n)
          << point << ' ' << kFingerPoseNames[static_cast<std::size_t>(pose)];
    }
    for (const FingerPose pose : {FingerPose::k90, FingerPose::k270}) {
      EXPECT_NEAR(bench.break_away_weight_n(pose, 1), kAbduction_n, 0.03 * kAbduction_n)
          << point << ' ' << kFingerPoseNames[static_cast<std::size_t>(pose)];
    }
  }
}

TEST(SimulatedBench, RecoversTheMeansOfAllPosesAndTheSensorsErrors) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  SimulatedBench bench({});
  const FingerCharacter character = characterize_finger(bench, 2);
  EXPECT_NEAR(character.extension_n.mean, kExtension_n, 0.05 * kExtension_n);
  EXPECT_NEAR(character.abduction_n.mean, kAbduction_n, 0.03 * kAbduction_n);
  for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
    EXPECT_NEAR(character.sensors[joint].mean_relative_error_ratio, kSensorError[joint], 0.001)
        << joint;
  }
}

TEST(SimulatedBench, TheSameSeedGivesTheSameWeightToTheBit) {
  SimulatedBench one({.seed = 4}), again({.seed = 4}), other({.seed = 5});
  const double weight_n = one.break_away_weight_n(FingerPose::k90, 2);
  EXPECT_EQ(again.break_away_weight_n(FingerPose::k90, 2), weight_n);
  EXPECT_NE(other.break_away_weight_n(FingerPose::k90, 2), weight_n);
  EXPECT_NE(one.break_away_weight_n(FingerPose::k90, 3), weight_n);
}

TEST(SimulatedBench, AFingerThatIsNotThereIsRefused) {
  EXPECT_THROW(SimulatedBench({.point = 5}), core::Error);
}

TEST(SimulatedBench, FreeSpaceFeelsAsViscousAsItTrulyIsToTenPercent) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  // The same line is fitted to the forces that the magnets truly exert on the hand, and to its
  // true motion.
  double num = 0.0, sum_v = 0.0, sum_vv = 0.0, sum_f = 0.0, sum_vf = 0.0;
  for (const double max_m_per_s : {0.2, 0.4, 0.6}) {
    ExoskeletonDevice exoskeleton({});
    core::LatestValue<core::HapticCommand> commands;
    core::LatestValue<core::Telemetry> telemetry;
    core::EmergencyStop stop;
    HapticLoop loop({.starts_armed = true}, exoskeleton, {commands, telemetry, stop});
    SimulatedHand& hand = *exoskeleton.simulated_hand();
    hand.begin_strokes({.amplitude_m = 0.2, .max_speed_m_per_s = max_m_per_s},
                       core::RandomStream(3, "stroke"));
    while (hand.strokes_finished() < 4) {
      loop.tick();
      const Eigen::Vector3d& velocity = exoskeleton.world().hand_velocity_m_per_s();
      const double v = velocity.norm();
      if (hand.strokes_finished() < 1 || v < FreeSpaceRegression::kLeastSpeedMPerS) continue;
      const double f =
          -total_of(exoskeleton.world().magnet_force_on_hand_n()).dot(velocity) / v;
      num += 1.0;
      sum_v += v;
      sum_vv += v * v;
      sum_f += f;
      sum_vf += v * f;
    }
  }
  const double truth_n_s_per_m =
      (num * sum_vf - sum_v * sum_f) / (num * sum_vv - sum_v * sum_v);
  const FreeSpaceRegression found = stroke_in_free_space(1000.0, 1);
  EXPECT_GT(found.num_samples(), 5000);
  EXPECT_NEAR(found.viscosity_n_s_per_m(), truth_n_s_per_m, 0.1 * truth_n_s_per_m);
}

TEST(SimulatedBench, FreeSpaceCanBeStopped) {
  EXPECT_THROW(
      (void)stroke_in_free_space(1000.0, 1, [](double) { throw std::runtime_error("stop"); }),
      std::runtime_error);
}

}  // namespace simulated_bench_test
}  // namespace jnd::device
