#include "core/hand.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/random_stream.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace hand_test {

PointVectors five_of(const Eigen::Vector3d& vector) {
  return {vector, vector, vector, vector, vector};
}

/// Returns a hand whose palm and index finger span the plane x = 0.
PointVectors hand_in_the_yz_plane() {
  return {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, -0.06),
          Eigen::Vector3d(0, 0.05, 0.04), Eigen::Vector3d(0, 0.12, 0),
          Eigen::Vector3d(0, 0.13, -0.02)};
}

TEST(Hand, TheAreaSharesAddUpToOne) {
  EXPECT_NEAR(std::accumulate(kAreaShareRatio.begin(), kAreaShareRatio.end(), 0.0), 1.0, 1e-15);
}

TEST(HandPlaneNormal, StandsOnThePalmAndTheIndexFinger) {
  EXPECT_NEAR(std::abs(hand_plane_normal(hand_in_the_yz_plane()).x()), 1.0, 1e-15);
}

TEST(HandPlaneNormal, IsZeroForThreePointsOnALine) {
  PointVectors tips = hand_in_the_yz_plane();
  tips[static_cast<int>(ContactPoint::kIndex)] = {0, 0, 0.1};
  EXPECT_EQ(hand_plane_normal(tips), Eigen::Vector3d::Zero());
}

TEST(HandMotion, IsTheMeanOfTheFiveTips) {
  PointVectors velocity = five_of({0.1, 0.0, 0.0});
  velocity[2] = {0.6, -0.5, 0.0};
  const HandMotion motion = hand_motion(hand_in_the_yz_plane(), velocity);
  EXPECT_NEAR(motion.velocity_m_per_s.x(), 0.2, 1e-15);
  EXPECT_NEAR(motion.velocity_m_per_s.y(), -0.1, 1e-15);
  EXPECT_NEAR(motion.speed_m_per_s, std::sqrt(0.05), 1e-15);
}

TEST(HandMotion, ATipThatCameOffHasNoSay) {
  PointVectors velocity = five_of({0.1, 0.0, 0.0});
  velocity[4] = {50.0, 50.0, 50.0};
  const HandMotion motion =
      hand_motion(hand_in_the_yz_plane(), velocity, {true, true, true, true, false});
  EXPECT_NEAR(motion.speed_m_per_s, 0.1, 1e-15);
}

TEST(HandMotion, IsRestWhenEveryTipCameOff) {
  const HandMotion motion = hand_motion(hand_in_the_yz_plane(), five_of({1, 1, 1}), {});
  EXPECT_EQ(motion.speed_m_per_s, 0.0);
  EXPECT_EQ(motion.sin_angle_of_attack, 0.0);
}

TEST(HandMotion, KnowsHeadOnEdgeOnAndBetween) {
  const PointVectors tips = hand_in_the_yz_plane();
  EXPECT_NEAR(hand_motion(tips, five_of({1, 0, 0})).sin_angle_of_attack, 1.0, 1e-15);
  EXPECT_NEAR(hand_motion(tips, five_of({-1, 0, 0})).sin_angle_of_attack, 1.0, 1e-15);
  EXPECT_NEAR(hand_motion(tips, five_of({0, 1, 0})).sin_angle_of_attack, 0.0, 1e-15);
  EXPECT_NEAR(hand_motion(tips, five_of({1, 1, 0})).sin_angle_of_attack,
              std::sin(std::numbers::pi / 4.0), 1e-15);
  EXPECT_EQ(hand_motion(tips, five_of({0, 0, 0})).sin_angle_of_attack, 0.0);
}

TEST(HandMotion, DoesNotDependOnTheFrame) {
  RandomStream random(7, "hand");
  for (int trial = 0; trial < 200; ++trial) {
    PointVectors position;
    PointVectors velocity;
    for (int i = 0; i < kNumContactPoints; ++i) {
      position[i] = {random.normal(), random.normal(), random.normal()};
      velocity[i] = {random.normal(), random.normal(), random.normal()};
    }
    const HandMotion motion = hand_motion(position, velocity);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized();
    for (int i = 0; i < kNumContactPoints; ++i) {
      position[i] = turn * position[i] + Eigen::Vector3d(1.0, 2.0, 3.0);
      velocity[i] = turn * velocity[i];
    }
    const HandMotion turned = hand_motion(position, velocity);
    EXPECT_NEAR(turned.speed_m_per_s, motion.speed_m_per_s, 1e-12);
    EXPECT_NEAR(turned.sin_angle_of_attack, motion.sin_angle_of_attack, 1e-9);
    EXPECT_LE(turned.sin_angle_of_attack, 1.0);
  }
}

TEST(HandMotion, IsSafeToCallOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  const test_support::AllocationCounter counter;
  const HandMotion motion = hand_motion(hand_in_the_yz_plane(), five_of({1, 2, 3}));
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_GT(motion.speed_m_per_s, 0.0);
}

}  // namespace hand_test
}  // namespace jnd::core
