#include "core/media/solid_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/allocation_counter.h"

namespace jnd::core {
namespace solid_surfaces_test {

constexpr double kPeriodS = 0.001;
const Immersion kBucket{.radius_m = 0.15, .depth_m = 0.30};

/// A hand with all five points in one place, in a bucket or on a plane of 1000 N/m.
struct Hand {
  PointVectors at(const Eigen::Vector3d& position_m, const Immersion& immersion = kBucket) {
    state.tip_position_m.fill(position_m);
    PointVectors force;
    surfaces.render(medium, immersion, kAreaShareRatio, state, kPeriodS, force);
    return force;
  }
  MediumAmounts medium = container({.stiffness_n_per_m = 1000.0});
  HapticState state;
  SolidSurfaces surfaces;
};

Eigen::Vector3d sum(const PointVectors& force) {
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& part : force) total += part;
  return total;
}

TEST(SolidSurfaces, ThePlaneCarriesEachPointByItsShare) {
  Hand hand;
  hand.medium = solid({.stiffness_n_per_m = 1000.0});
  hand.at({0.0, 0.0, 0.01});
  const PointVectors force = hand.at({5.0, 0.0, -0.004});
  EXPECT_NEAR(sum(force).z(), 4.0, 1e-12);
  EXPECT_NEAR(force[0].z(), 0.35 * 4.0, 1e-12);
  EXPECT_EQ(hand.surfaces.held_bits(), 0);
}

TEST(SolidSurfaces, TheBucketHasAWallAndABottom) {
  Hand hand;
  EXPECT_EQ(sum(hand.at({0.0, 0.0, -0.1})).norm(), 0.0);
  EXPECT_EQ(hand.surfaces.held_bits(), 0b11111);
  const Eigen::Vector3d at_wall = sum(hand.at({0.0, 0.155, -0.1}));
  EXPECT_LT((at_wall - Eigen::Vector3d(0.0, -5.0, 0.0)).norm(), 1e-9);
  hand.at({0.0, 0.0, -0.1});
  const Eigen::Vector3d at_bottom = sum(hand.at({0.0, 0.0, -0.304}));
  EXPECT_LT((at_bottom - Eigen::Vector3d(0.0, 0.0, 4.0)).norm(), 1e-9);
  hand.at({0.0, 0.0, -0.1});
  const Eigen::Vector3d in_the_corner = sum(hand.at({-0.153, 0.0, -0.302}));
  EXPECT_LT((in_the_corner - Eigen::Vector3d(3.0, 0.0, 2.0)).norm(), 1e-9);
}

TEST(SolidSurfaces, TheBucketHoldsWhatPressesUntilItIsLiftedOverTheRim) {
  Hand hand;
  hand.at({0.0, 0.0, -0.1});
  for (int mm = 0; mm <= 20; ++mm) hand.at({0.140 + 0.001 * mm, 0.0, -0.1});
  EXPECT_EQ(hand.surfaces.held_bits(), 0b11111) << "10 mm behind the wall it is still inside";
  EXPECT_NEAR(sum(hand.at({0.160, 0.0, -0.1})).x(), -10.0, 1e-9);
  EXPECT_NEAR(sum(hand.at({0.160, 0.0, -0.005})).x(), -5.0, 1e-9) << "the rim is soft";
  EXPECT_EQ(sum(hand.at({0.160, 0.0, 0.001})).norm(), 0.0);
  EXPECT_EQ(hand.surfaces.held_bits(), 0);
  EXPECT_EQ(sum(hand.at({0.160, 0.0, -0.1})).norm(), 0.0) << "outside there is nothing";
}

TEST(SolidSurfaces, NothingIsDrawnIntoTheBucketFromOutside) {
  Hand hand;
  for (const Eigen::Vector3d& outside :
       {Eigen::Vector3d(0.152, 0.0, -0.1), Eigen::Vector3d(0.0, 0.0, -0.305),
        Eigen::Vector3d(1.0, 1.0, -1.0)}) {
    EXPECT_EQ(sum(hand.at(outside)).norm(), 0.0);
    EXPECT_EQ(hand.surfaces.held_bits(), 0);
  }
}

TEST(SolidSurfaces, AnInfiniteRadiusIsAFloorBelowAFluid) {
  Hand hand;
  const Immersion layer{.depth_m = 0.2};
  hand.at({3.0, -7.0, -0.1}, layer);
  EXPECT_NEAR(sum(hand.at({3.0, -7.0, -0.205}, layer)).z(), 5.0, 1e-9);
  EXPECT_EQ(hand.surfaces.held_bits(), 0b11111);
  EXPECT_EQ(sum(hand.at({3.0, -7.0, -0.205}, Immersion{})).norm(), 0.0) << "bottomless";
}

TEST(SolidSurfaces, OnTheAxisTheWallHasNoSide) {
  Hand hand;
  EXPECT_TRUE(sum(hand.at({0.0, 0.0, -0.1})).allFinite());
}

TEST(SolidSurfaces, ABucketMovedOverTheHandPushesItGently) {
  Hand hand;
  hand.at({0.10, 0.0, -0.1});
  Immersion moved = kBucket;
  moved.origin_x_m = -0.08;  // The wall is now at x = 7 cm.
  double last = 0.0;
  for (int tick = 0; tick < 2000; ++tick) {
    const double force = -sum(hand.at({0.10, 0.0, -0.1}, moved)).x();
    ASSERT_GE(force, last - 1e-9);
    ASSERT_LE(force - last, 0.05 + 1e-9);
    last = force;
  }
  EXPECT_NEAR(last, 30.0, 1e-6);
}

TEST(SolidSurfaces, APlaneMovedInContactIsNoStep) {
  Hand hand;
  hand.medium = solid({.stiffness_n_per_m = 1000.0});
  hand.at({0.0, 0.0, 0.01}, Immersion{});
  const double before = sum(hand.at({0.0, 0.0, -0.002}, Immersion{})).z();
  const double after = sum(hand.at({0.0, 0.0, -0.002}, Immersion{.origin_z_m = 0.05})).z();
  EXPECT_NEAR(after, before, 0.051);
  EXPECT_EQ(sum(hand.at({0.0, 0.0, -0.002}, Immersion{.origin_z_m = -0.05})).z(), 0.0);
}

TEST(SolidSurfaces, APointThatCameOffForgetsWhatItTouched) {
  Hand hand;
  hand.at({0.0, 0.0, -0.1});
  hand.at({0.155, 0.0, -0.1});
  hand.state.attached[3] = false;
  const PointVectors off = hand.at({0.155, 0.0, -0.1});
  EXPECT_EQ(off[3], Eigen::Vector3d::Zero());
  EXPECT_NE(off[0].x(), 0.0);
  EXPECT_EQ(hand.surfaces.held_bits(), 0b10111);
  hand.state.attached[3] = true;
  EXPECT_EQ(hand.at({0.155, 0.0, -0.1})[3], Eigen::Vector3d::Zero()) << "outside, as it is";
}

TEST(SolidSurfaces, SwitchedOnOverAHandTheyAreNoStep) {
  Hand hand;
  hand.medium = solid({.stiffness_n_per_m = 1000.0});
  EXPECT_EQ(sum(hand.at({0.0, 0.0, -0.05})).norm(), 0.0);
  EXPECT_LE(sum(hand.at({0.0, 0.0, -0.05})).norm(), 0.051);
  hand.surfaces.release();
  EXPECT_EQ(sum(hand.at({0.0, 0.0, -0.05})).norm(), 0.0);
}

TEST(SolidSurfaces, AContainerThatIsNowhereDoesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, infinity, -infinity}) {
    Hand hand;
    hand.medium =
        container({.stiffness_n_per_m = 1000.0}) + solid({.stiffness_n_per_m = 1000.0});
    hand.at({0.0, 0.0, -0.1});
    for (double Immersion::*const field :
         {&Immersion::origin_x_m, &Immersion::origin_y_m, &Immersion::origin_z_m,
          &Immersion::radius_m, &Immersion::depth_m}) {
      Immersion broken = kBucket;
      broken.*field = wrong;
      const Eigen::Vector3d force = sum(hand.at({0.0, 0.0, -0.1}, broken));
      EXPECT_LE(force.norm(), 10.0) << force.transpose();
    }
  }
}

TEST(SolidSurfaces, AreSafeToCallOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  Hand hand;
  const test_support::AllocationCounter counter;
  hand.at({0.0, 0.0, -0.1});
  hand.at({0.16, 0.0, -0.1});
  hand.surfaces.release();
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace solid_surfaces_test
}  // namespace jnd::core
