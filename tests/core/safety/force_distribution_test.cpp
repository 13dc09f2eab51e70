#include "core/safety/force_distribution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/media/medium.h"
#include "core/random_stream.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace force_distribution_test {

constexpr std::uint8_t kAllImmersed = 0b11111;
constexpr double kFadeSpeed = 0.005;

HapticState moving(const Eigen::Vector3d& velocity_m_per_s) {
  HapticState state;
  state.tip_velocity_m_per_s.fill(velocity_m_per_s);
  return state;
}

PointVectors distributed(double drag_n, const HapticState& state,
                         std::uint8_t immersed_bits = kAllImmersed) {
  PointVectors force;
  distribute_drag(drag_n, kAreaShareRatio, state, immersed_bits, kFadeSpeed, force);
  return force;
}

TEST(ForceDistribution, AHandMovingAsOneGetsTheWholeDragAgainstItsMotion) {
  const PointVectors force = distributed(10.0, moving({0.3, 0.4, 0.0}));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : force) sum += point;
  EXPECT_NEAR(sum.x(), -6.0, 1e-12);
  EXPECT_NEAR(sum.y(), -8.0, 1e-12);
  // Of 10 N, the palm gets a share of 0.35 and the thumb one of 0.1.
  EXPECT_NEAR(force[0].norm(), 3.5, 1e-12);
  EXPECT_NEAR(force[2].norm(), 1.0, 1e-12);
}

TEST(ForceDistribution, EachPointIsHeldBackAgainstItsOwnMotion) {
  HapticState state = moving({0.3, 0.0, 0.0});
  state.tip_velocity_m_per_s[3] = {0.0, -0.2, 0.0};
  const PointVectors force = distributed(10.0, state);
  EXPECT_NEAR(force[3].x(), 0.0, 1e-15);
  EXPECT_NEAR(force[3].y(), 1.0, 1e-12);
}

TEST(ForceDistribution, APointOutsideOrOffTheHandGetsNothing) {
  HapticState state = moving({0.3, 0.0, 0.0});
  state.attached[1] = false;
  const PointVectors force = distributed(10.0, state, 0b01111);
  EXPECT_EQ(force[1], Eigen::Vector3d::Zero());
  EXPECT_EQ(force[4], Eigen::Vector3d::Zero());
  EXPECT_NEAR(force[0].x(), -3.5, 1e-12);
}

TEST(ForceDistribution, IsExactlyZeroAtRest) {
  for (const Eigen::Vector3d& force : distributed(10.0, moving(Eigen::Vector3d::Zero()))) {
    EXPECT_EQ(force, Eigen::Vector3d::Zero());
  }
}

TEST(ForceDistribution, TakesEnergyFromEveryPointAndNeverGivesAny) {
  RandomStream random(11, "distribution");
  for (int trial = 0; trial < 2000; ++trial) {
    HapticState state;
    for (int i = 0; i < kNumContactPoints; ++i) {
      // The speeds range from far below the fading speed to far above it.
      const double scale = std::pow(10.0, random.uniform(-9.0, 1.0));
      state.tip_velocity_m_per_s[i] =
          scale * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      state.attached[i] = random.with_probability(0.9);
    }
    const auto immersed = static_cast<std::uint8_t>(random.below(32));
    const PointVectors force = distributed(random.uniform(0.0, 50.0), state, immersed);
    for (int i = 0; i < kNumContactPoints; ++i) {
      EXPECT_LE(force[i].dot(state.tip_velocity_m_per_s[i]), 0.0);
    }
  }
}

TEST(ForceDistribution, IsContinuousWhereOneTipTurnsWhileTheHandMovesOn) {
  HapticState state = moving({0.4, 0.0, 0.0});
  Eigen::Vector3d last;
  bool first = true;
  // The velocity of the tip passes through zero in steps of 0.1 mm/s.
  for (double velocity = -0.02; velocity <= 0.02; velocity += 0.0001) {
    state.tip_velocity_m_per_s[3] = {velocity, 0.0, 0.0};
    const Eigen::Vector3d force = distributed(20.0, state)[3];
    // 2 N fade over 5 mm/s, which is no more than 0.04 N a step. Without the fade the force
    // would jump by 4 N.
    if (!first) {
      EXPECT_LE((force - last).norm(), 0.0401) << velocity;
    }
    last = force;
    first = false;
  }
}

TEST(ForceDistribution, IsSafeToCallOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  const HapticState state = moving({0.4, 0.0, 0.0});
  const test_support::AllocationCounter counter;
  const PointVectors force = distributed(20.0, state);
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_LT(force[0].x(), 0.0);
}

}  // namespace force_distribution_test
}  // namespace jnd::core
