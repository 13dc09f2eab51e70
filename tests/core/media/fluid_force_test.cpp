#include "core/media/fluid_force.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/random_stream.h"
#include "core/safety/force_distribution.h"
#include "core/safety/passivity.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace fluid_force_test {

constexpr double kRightAngle = std::numbers::pi / 2.0;
constexpr std::uint8_t kAllImmersed = 0b11111;

/// A plate has C_L = sin 2 alpha and C_D = 1.
ForceMap plate() {
  std::vector<ForceMap::Row> rows;
  for (int i = 0; i <= 90; ++i) {
    const double angle = kRightAngle * i / 90;
    rows.push_back({angle, 1.0, 1.0, i == 90 ? 0.0 : std::sin(2.0 * angle)});
  }
  return ForceMap(rows);
}

/// The fingers point along y and the hand plane's normal along x, at a depth of 10 cm.
HapticState hand_moving(const Eigen::Vector3d& velocity_m_per_s) {
  HapticState state;
  state.tip_position_m = {Eigen::Vector3d(0, -0.061, -0.1), Eigen::Vector3d(0, -0.061, -0.16),
                          Eigen::Vector3d(0, 0, -0.08), Eigen::Vector3d(0, 0.059, -0.1),
                          Eigen::Vector3d(0, 0.064, -0.12)};
  state.tip_velocity_m_per_s.fill(velocity_m_per_s);
  return state;
}

PointVectors force_of(const MediumAmounts& medium, const HapticState& state,
                      const ForceMap* map = nullptr, std::uint8_t immersed = kAllImmersed) {
  PointVectors force;
  add_up_fluid_force(
      medium, map,
      hand_motion(state.tip_position_m, state.tip_velocity_m_per_s, state.attached),
      kAreaShareRatio, state, immersed, 0.0, 0.005, force);
  return force;
}

Eigen::Vector3d total(const PointVectors& force) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& part : force) sum += part;
  return sum;
}

HapticState random_hand(RandomStream& random) {
  HapticState state = hand_moving(Eigen::Vector3d::Zero());
  for (int i = 0; i < kNumContactPoints; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      state.tip_position_m[i][axis] += random.normal(0.0, 0.02);
      state.tip_velocity_m_per_s[i][axis] = random.normal(0.0, 0.5);
    }
  }
  return state;
}

TEST(FluidForce, OfTheOldMediaIsTheirDistributedDrag) {
  const MediumAmounts medium = water({}) + viscous({.viscosity_pa_s = 2.0});
  RandomStream random(2, "fluid");
  for (int i = 0; i < 100; ++i) {
    const HapticState state = random_hand(random);
    const HandMotion motion = hand_motion(state.tip_position_m, state.tip_velocity_m_per_s);
    PointVectors expected;
    distribute_drag(medium.drag_n(motion), kAreaShareRatio, state, kAllImmersed, 0.005,
                    expected);
    const PointVectors force = force_of(medium, state);
    for (int point = 0; point < kNumContactPoints; ++point) {
      ASSERT_EQ(force[point], expected[point]);
    }
  }
}

TEST(FluidForce, MediaAddUp) {
  const ForceMap map = plate();
  const MediumAmounts parts[] = {water({}), mapped_water({}),
                                 viscous_inertial({.viscosity_pa_s = 2.0}),
                                 ellipsoid({.viscosity_pa_s = 3.0}), buoyant(4.0)};
  RandomStream random(3, "fluid");
  for (int i = 0; i < 100; ++i) {
    const HapticState state = random_hand(random);
    MediumAmounts all;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const MediumAmounts& part : parts) {
      all += part;
      sum += force_of(part, state, &map)[2];
    }
    ASSERT_LT((force_of(all, state, &map)[2] - sum).norm(), 1e-12);
  }
}

TEST(Lift, IsAtRightAnglesToThePointsMotion) {
  const ForceMap map = plate();
  RandomStream random(4, "lift");
  for (int i = 0; i < 10'000; ++i) {
    const HapticState state = random_hand(random);
    const PointVectors force = force_of({.lift_kg_per_m = 7.4}, state, &map);
    for (int point = 0; point < kNumContactPoints; ++point) {
      const Eigen::Vector3d& velocity = state.tip_velocity_m_per_s[point];
      ASSERT_NEAR(force[point].dot(velocity), 0.0,
                  1e-15 * force[point].norm() * velocity.norm() + 1e-300);
    }
  }
}

TEST(Lift, OfAHandAtFortyFiveDegreesIsWorkedByHand) {
  // v = (1, 0, 1)/sqrt 2 lies at 45 degrees to the normal. The plate is driven back from where
  // it meets the fluid, so to -x, and at right angles to v: along (-1, 0, 1).
  const ForceMap map = plate();
  const HapticState state = hand_moving(Eigen::Vector3d(1.0, 0.0, 1.0) / std::sqrt(2.0));
  const Eigen::Vector3d force = total(force_of({.lift_kg_per_m = 7.4}, state, &map));
  EXPECT_LT((force - 7.4 * Eigen::Vector3d(-1.0, 0.0, 1.0) / std::sqrt(2.0)).norm(), 1e-9);
  // The plane's normal has no sign, so the lift must not depend on it.
  HapticState mirrored = state;
  std::swap(mirrored.tip_position_m[0], mirrored.tip_position_m[1]);
  mirrored.tip_position_m[3].z() = mirrored.tip_position_m[0].z();
  EXPECT_LT((total(force_of({.lift_kg_per_m = 7.4}, mirrored, &map)) - force).norm(), 1e-9);
}

TEST(Lift, IsContinuousThroughEdgeOnAndHeadOn) {
  const ForceMap map = plate();
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  bool first = true;
  for (double angle = -0.3; angle < 6.5; angle += 1e-4) {
    const HapticState state = hand_moving({std::sin(angle), 0.0, std::cos(angle)});
    const Eigen::Vector3d force = total(force_of({.lift_kg_per_m = 7.4}, state, &map));
    if (!first) {
      ASSERT_LT((force - last).norm(), 0.005) << angle;
    }
    first = false;
    last = force;
  }
}

TEST(Lift, IsOffWithoutAMapAndWithoutAnAmount) {
  const HapticState state = hand_moving({0.7, 0.0, 0.7});
  const ForceMap map = plate();
  EXPECT_EQ(total(force_of({.lift_kg_per_m = 7.4}, state)).norm(), 0.0);
  const Eigen::Vector3d drag = total(force_of(water({}), state, &map));
  EXPECT_LT(drag.cross(Eigen::Vector3d(0.7, 0.0, 0.7)).norm(), 1e-12) << "against the motion";
}

TEST(EllipsoidForce, FollowsTheHandsAxes) {
  const MediumAmounts medium = ellipsoid({.viscosity_pa_s = 1.0});
  EXPECT_NEAR(total(force_of(medium, hand_moving({0.0, 0.5, 0.0}))).y(),
              -0.5 * medium.ellipsoid_fingers_n_s_per_m, 1e-12);
  EXPECT_NEAR(total(force_of(medium, hand_moving({0.0, 0.0, 0.5}))).z(),
              -0.5 * medium.ellipsoid_across_n_s_per_m, 1e-12);
  EXPECT_NEAR(total(force_of(medium, hand_moving({0.5, 0.0, 0.0}))).x(),
              -0.5 * medium.ellipsoid_normal_n_s_per_m, 1e-12);
}

TEST(EllipsoidForce, TurnsWithTheHand) {
  const MediumAmounts medium = ellipsoid({.viscosity_pa_s = 5.0});
  RandomStream random(6, "turn");
  for (int i = 0; i < 200; ++i) {
    const HapticState state = random_hand(random);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized();
    HapticState turned = state;
    for (int point = 0; point < kNumContactPoints; ++point) {
      turned.tip_position_m[point] = turn * state.tip_position_m[point];
      turned.tip_velocity_m_per_s[point] = turn * state.tip_velocity_m_per_s[point];
    }
    const PointVectors force = force_of(medium, state);
    const PointVectors force_turned = force_of(medium, turned);
    for (int point = 0; point < kNumContactPoints; ++point) {
      ASSERT_LT((turn * force[point] - force_turned[point]).norm(), 1e-10);
    }
  }
}

TEST(EllipsoidForce, TakesEnergyFromEveryPointWhateverItsMotion) {
  const MediumAmounts medium = ellipsoid({.viscosity_pa_s = 16.0});
  RandomStream random(7, "passive");
  for (int i = 0; i < 10'000; ++i) {
    const HapticState state = random_hand(random);
    const PointVectors force = force_of(medium, state);
    for (int point = 0; point < kNumContactPoints; ++point) {
      ASSERT_LE(force[point].dot(state.tip_velocity_m_per_s[point]), 0.0);
    }
  }
}

TEST(EllipsoidForce, OfAHandWithoutAPlaneIsTheMean) {
  const MediumAmounts medium = ellipsoid({.viscosity_pa_s = 1.0});
  HapticState state = hand_moving({0.3, 0.2, 0.1});
  state.tip_position_m.fill({0.0, 0.0, -0.1});
  const double mean = (medium.ellipsoid_fingers_n_s_per_m + medium.ellipsoid_across_n_s_per_m +
                       medium.ellipsoid_normal_n_s_per_m) /
                      3.0;
  EXPECT_LT((total(force_of(medium, state)) + mean * Eigen::Vector3d(0.3, 0.2, 0.1)).norm(),
            1e-12);
}

TEST(Buoyancy, LiftsTheImmersedPointsAndGrowsFromTheSurface) {
  HapticState state = hand_moving(Eigen::Vector3d::Zero());
  EXPECT_NEAR(total(force_of(buoyant(4.0), state)).z(), 4.0, 1e-12);
  for (Eigen::Vector3d& position : state.tip_position_m) position.z() = -0.015;
  EXPECT_NEAR(total(force_of(buoyant(4.0), state)).z(), 2.0, 1e-12);
  for (Eigen::Vector3d& position : state.tip_position_m) position.z() = -1e-6;
  EXPECT_LT(total(force_of(buoyant(4.0), state)).z(), 0.001);
}

TEST(Buoyancy, GivesBackNoMoreThanTheHandPutIn) {
  // A hand that begins 20 cm deep is not driven up. If it is pushed down and let up, it gets
  // back what that took.
  PassivityController passivity({}, 0.001);
  HapticState state = hand_moving(Eigen::Vector3d::Zero());
  double given_j = 0.0;
  double lowest_balance_j = 0.0;
  const auto move = [&](double speed_m_per_s, int num_ticks) {
    state.tip_velocity_m_per_s.fill({0.0, 0.0, speed_m_per_s});
    for (int tick = 0; tick < num_ticks; ++tick) {
      PointVectors force = force_of(buoyant(8.0), state);
      passivity.control(state.tip_position_m, state.tip_velocity_m_per_s, force);
      passivity.sent(force);
      for (int point = 0; point < kNumContactPoints; ++point) {
        state.tip_position_m[point].z() += 0.001 * speed_m_per_s;
        given_j += force[point].z() * 0.001 * speed_m_per_s;
      }
      lowest_balance_j = std::max(lowest_balance_j, given_j);
    }
  };
  move(0.1, 500);
  EXPECT_LT(lowest_balance_j, 1e-9) << "begun below, it is not driven up";
  move(-0.1, 500);
  EXPECT_LT(given_j, -0.3);
  move(0.1, 500);
  EXPECT_NEAR(given_j, 0.0, 0.01) << "what was put in comes back";
  EXPECT_LT(lowest_balance_j, 1e-3);
}

TEST(FluidForce, IsNothingForAPointThatIsOffOrOutside) {
  const ForceMap map = plate();
  MediumAmounts all = mapped_water({}) + ellipsoid({.viscosity_pa_s = 3.0}) + buoyant(3.0);
  HapticState state = hand_moving({0.5, 0.1, 0.2});
  state.attached[1] = false;
  const PointVectors force = force_of(all, state, &map, 0b01111);
  EXPECT_EQ(force[1], Eigen::Vector3d::Zero());
  EXPECT_EQ(force[4], Eigen::Vector3d::Zero());
  EXPECT_GT(force[0].norm(), 0.0);
}

TEST(FluidForce, IsSafeToComputeOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  const ForceMap map = plate();
  const MediumAmounts all =
      mapped_water({}) + ellipsoid({.viscosity_pa_s = 3.0}) + buoyant(3.0);
  const HapticState state = hand_moving({0.5, 0.1, 0.2});
  const test_support::AllocationCounter counter;
  (void)force_of(all, state, &map);
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace fluid_force_test
}  // namespace jnd::core
