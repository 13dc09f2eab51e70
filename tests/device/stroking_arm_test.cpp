#include "device/stroking_arm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"

namespace jnd::device {
namespace stroking_arm_test {

constexpr double kPeriodS = 0.001;

StrokingArm arm() { return {StrokingArm::Parameters{}, kPeriodS}; }

/// Returns a plan in which all strokes are alike.
StrokePlan steady(std::int64_t num_strokes = 0) {
  return {.amplitude_sd_ratio = 0.0,
          .speed_sd_ratio = 0.0,
          .height_sd_m = 0.0,
          .sideways_sd_m = 0.0,
          .num_strokes = num_strokes};
}

core::RandomStream stream(std::int64_t trial = 1) { return {1, "stroke", {trial}}; }

TEST(StrokingArm, RestsAtHomeUntilToldToStroke) {
  StrokingArm resting = arm();
  for (int tick = 0; tick < 100; ++tick) resting.advance();
  EXPECT_TRUE(resting.is_home());
  EXPECT_EQ(resting.reference_m(), Eigen::Vector3d(0.0, 0.0, -0.15));
  EXPECT_EQ(resting.reference_velocity_m_per_s(), Eigen::Vector3d::Zero());
}

TEST(StrokingArm, AStrokeHasTheWidthSpeedAndDurationOfItsPlan) {
  StrokingArm stroking = arm();
  stroking.begin_strokes(steady(), stream());
  while (stroking.strokes_finished() < 1) stroking.advance();
  double low = 1.0, high = -1.0, fastest = 0.0;
  int num_ticks = 0;
  while (stroking.strokes_finished() < 2) {
    stroking.advance();
    ++num_ticks;
    low = std::min(low, stroking.reference_m().x());
    high = std::max(high, stroking.reference_m().x());
    fastest = std::max(fastest, stroking.reference_velocity_m_per_s().x());
  }
  EXPECT_NEAR(low, -0.28, 1e-9);
  EXPECT_NEAR(high, 0.28, 1e-9);
  EXPECT_NEAR(fastest, 0.45, 1e-3);
  // A cycle of x = A cos(v t / A) lasts 2 pi A / v.
  EXPECT_NEAR(num_ticks, 2.0 * std::numbers::pi * 0.28 / 0.45 / kPeriodS, 2.0);
}

TEST(StrokingArm, TheHandIsLowerOnTheWayForwardAndHigherOnTheWayBack) {
  StrokingArm stroking = arm();
  stroking.begin_strokes(steady(), stream());
  while (stroking.strokes_finished() < 1) stroking.advance();
  double lowest = 0.0, highest = -1.0;
  while (stroking.strokes_finished() < 2) {
    stroking.advance();
    const double z = stroking.reference_m().z();
    const double velocity = stroking.reference_velocity_m_per_s().x();
    if (velocity > 1e-6) {
      EXPECT_LE(z, -0.15 + 1e-12);
    }
    if (velocity < -1e-6) {
      EXPECT_GE(z, -0.15 - 1e-12);
    }
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  EXPECT_NEAR(lowest, -0.165, 1e-6);
  EXPECT_NEAR(highest, -0.135, 1e-6);
}

TEST(StrokingArm, NeitherTheReferenceNorItsVelocityEverJumps) {
  StrokingArm stroking = arm();
  Eigen::Vector3d last = stroking.reference_m();
  Eigen::Vector3d last_velocity = Eigen::Vector3d::Zero();
  const auto advance_and_check = [&] {
    stroking.advance();
    const Eigen::Vector3d velocity = stroking.reference_velocity_m_per_s();
    // The reference has at most 1.6 m/s and 20 m/s^2.
    ASSERT_LT((stroking.reference_m() - last).norm(), 1.6 * kPeriodS);
    ASSERT_LT((velocity - last_velocity).norm(), 20.0 * kPeriodS);
    // The velocity is that of the reference.
    ASSERT_NEAR(
        ((stroking.reference_m() - last) / kPeriodS - 0.5 * (velocity + last_velocity)).norm(),
        0.0, 2e-3);
    last = stroking.reference_m();
    last_velocity = velocity;
  };
  for (int round = 0; round < 20; ++round) {
    stroking.begin_strokes({.num_strokes = 2}, stream(round));
    // Sometimes the next strokes, or the way home, interrupt in the middle of a stroke.
    for (int tick = 0; tick < 1500 + 517 * round; ++tick) advance_and_check();
    if (round % 3 == 0) {
      stroking.go_home();
      for (int tick = 0; tick < 150 * (round % 7); ++tick) advance_and_check();
    }
  }
}

TEST(StrokingArm, GoesHomeWithinItsTimeFromAnywhere) {
  for (int tick_of_order = 0; tick_of_order < 6000; tick_of_order += 317) {
    StrokingArm stroking = arm();
    stroking.begin_strokes({}, stream());
    for (int tick = 0; tick < tick_of_order; ++tick) stroking.advance();
    stroking.go_home();
    int num_ticks = 0;
    while (!stroking.is_home() && num_ticks < 10'000) {
      stroking.advance();
      ++num_ticks;
    }
    EXPECT_EQ(num_ticks, 600);
    EXPECT_EQ(stroking.reference_m(), Eigen::Vector3d(0.0, 0.0, -0.15));
  }
}

TEST(StrokingArm, AfterTheStrokesAskedForItGoesHomeByItself) {
  StrokingArm stroking = arm();
  stroking.begin_strokes({.num_strokes = 3}, stream());
  int num_ticks = 0;
  while (!stroking.is_home() && num_ticks < 100'000) {
    stroking.advance();
    ++num_ticks;
  }
  EXPECT_EQ(stroking.strokes_finished(), 3);
  stroking.begin_strokes({.num_strokes = 3}, stream());
  EXPECT_EQ(stroking.strokes_finished(), 0);
}

/// Returns the turning points on the right, one for each stroke.
std::vector<double> far_ends(std::int64_t trial) {
  StrokingArm stroking = arm();
  stroking.begin_strokes({}, stream(trial));
  std::vector<double> ends;
  double highest = -1.0;
  while (ends.size() < 40) {
    const std::int64_t before = stroking.strokes_finished();
    stroking.advance();
    highest = std::max(highest, stroking.reference_m().x());
    if (stroking.strokes_finished() > before) {
      ends.push_back(highest);
      highest = -1.0;
    }
  }
  return ends;
}

TEST(StrokingArm, StrokesDifferFromOneAnotherAndRepeatWithTheirStream) {
  const std::vector<double> ends = far_ends(1);
  EXPECT_EQ(ends, far_ends(1));
  EXPECT_NE(ends, far_ends(2));
  double mean = 0.0;
  for (const double end : ends) mean += end / 40.0;
  double variance = 0.0;
  for (const double end : ends) variance += (end - mean) * (end - mean) / 39.0;
  EXPECT_NEAR(mean, 0.28, 0.008);
  EXPECT_NEAR(std::sqrt(variance) / 0.28, 0.05, 0.02);
}

TEST(StrokingArm, PullsTowardsItsReferenceThroughItsImpedance) {
  const StrokingArm resting = arm();
  const Eigen::Vector3d force =
      resting.force_n({0.01, 0.0, -0.15}, Eigen::Vector3d(0.0, 0.2, 0.0));
  EXPECT_NEAR(force.x(), -3.0, 1e-12);
  EXPECT_NEAR(force.y(), -4.0, 1e-12);
  EXPECT_NEAR(force.z(), 0.0, 1e-12);
}

TEST(StrokingArm, NamesTheFieldOfAPlanItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(require_valid({}));
  EXPECT_THROW(require_valid({.amplitude_m = 0.0}), core::Error);
  EXPECT_THROW(require_valid({.max_speed_m_per_s = nan}), core::Error);
  EXPECT_THROW(require_valid({.height_m = nan}), core::Error);
  EXPECT_THROW(require_valid({.lift_m = nan}), core::Error);
  EXPECT_THROW(require_valid({.amplitude_sd_ratio = 0.31}), core::Error);
  EXPECT_THROW(require_valid({.speed_sd_ratio = -0.1}), core::Error);
  EXPECT_THROW(require_valid({.height_sd_m = -0.1}), core::Error);
  EXPECT_THROW(require_valid({.sideways_sd_m = nan}), core::Error);
  EXPECT_THROW(require_valid({.num_strokes = -1}), core::Error);
  EXPECT_NO_THROW(require_valid({.amplitude_m = 2.0, .max_speed_m_per_s = 5.0}));
  EXPECT_NO_THROW(require_valid({.amplitude_m = 0.001, .max_speed_m_per_s = 0.001}));
  EXPECT_THROW(require_valid({.amplitude_m = 2.001}), core::Error);
  EXPECT_THROW(require_valid({.amplitude_m = 1e308}), core::Error);
  EXPECT_THROW(require_valid({.max_speed_m_per_s = 5.001}), core::Error);
  EXPECT_THROW(require_valid({.max_speed_m_per_s = 0.0009}), core::Error);
  EXPECT_THROW(require_valid({.height_m = -5.1}), core::Error);
  EXPECT_THROW(require_valid({.lift_m = 1.1}), core::Error);
  EXPECT_THROW(require_valid({.height_sd_m = 0.6}), core::Error);
  EXPECT_THROW(require_valid({.sideways_sd_m = 0.6}), core::Error);
  EXPECT_THROW(require_valid({.num_strokes = 1'000'001}), core::Error);
  EXPECT_TRUE(is_valid({}));
  EXPECT_FALSE(is_valid({.lift_m = nan}));
  EXPECT_FALSE(is_valid({.num_strokes = -1}));
  EXPECT_THROW(StrokingArm({.stiffness_n_per_m = nan}, kPeriodS), core::Error);
  EXPECT_THROW(StrokingArm({.home_x_m = nan}, kPeriodS), core::Error);
  EXPECT_THROW(StrokingArm({.home_s = 0.0}, kPeriodS), core::Error);
}

}  // namespace stroking_arm_test
}  // namespace jnd::device
