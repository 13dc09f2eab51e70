#include "core/media/god_object.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::core {
namespace god_object_test {

constexpr double kPeriodS = 0.001;
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// A point that begins just above the plane z = 0.
struct Touch {
  explicit Touch(const SolidParameters& parameters) : amounts(solid_amounts(parameters)) {
    (void)at({0.0, 0.0, 0.001}, Eigen::Vector3d::Zero());
  }
  Eigen::Vector3d at(const Eigen::Vector3d& position_m,
                     const Eigen::Vector3d& velocity_m_per_s = Eigen::Vector3d::Zero()) {
    return point.force_n(amounts, kUp, -position_m.z(), position_m, velocity_m_per_s, kPeriodS);
  }
  SolidAmounts amounts;
  GodObject point;
};

TEST(GodObject, PushesWithStiffnessTimesDepth) {
  Touch touch({.stiffness_n_per_m = 800.0, .damping_n_s_per_m = 10.0});
  EXPECT_NEAR(touch.at({0.0, 0.0, -0.005}).z(), 4.0, 1e-12);
  EXPECT_NEAR(touch.at({0.0, 0.0, -0.005}, {0.0, 0.0, -0.1}).z(), 5.0, 1e-12);
  EXPECT_EQ(touch.at({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}).norm(), 0.0);
  EXPECT_EQ(touch.at({0.0, 0.0, 0.1}, {0.0, 0.0, -1.0}).norm(), 0.0);
}

TEST(GodObject, WithoutFrictionItOnlyPushesOutward) {
  Touch touch({.stiffness_n_per_m = 800.0, .damping_n_s_per_m = 10.0});
  (void)touch.at({0.0, 0.0, -0.005});
  const Eigen::Vector3d force = touch.at({0.02, 0.0, -0.005}, {0.5, -0.2, 0.0});
  EXPECT_EQ(force.x(), 0.0);
  EXPECT_EQ(force.y(), 0.0);
}

TEST(GodObject, SticksWithinTheFrictionAndSlidesBeyondIt) {
  Touch touch({.stiffness_n_per_m = 1000.0, .friction_ratio = 0.5});
  EXPECT_NEAR(touch.at({0.0, 0.0, -0.004}).z(), 4.0, 1e-12);
  // 1 mm aside gives 1 N of at most 2 N, and the point comes back without a trace.
  EXPECT_NEAR(touch.at({0.001, 0.0, -0.004}).x(), -1.0, 1e-12);
  EXPECT_NEAR(touch.at({0.0, 0.0, -0.004}).x(), 0.0, 1e-12);
  // 10 mm aside the surface point has slid to 2 mm behind the hand's.
  EXPECT_NEAR(touch.at({0.010, 0.0, -0.004}).x(), -2.0, 1e-12);
  EXPECT_NEAR(touch.at({0.008, 0.0, -0.004}).x(), 0.0, 1e-12);
  EXPECT_NEAR(touch.at({0.006, 0.0, -0.004}).x(), 2.0, 1e-12);
}

TEST(GodObject, LiftedOffItForgetsWhereItStuck) {
  Touch touch({.stiffness_n_per_m = 1000.0, .friction_ratio = 0.5});
  (void)touch.at({0.0, 0.0, -0.004});
  (void)touch.at({0.0, 0.0, 0.001});
  (void)touch.at({0.05, 0.0, 0.001});
  EXPECT_NEAR(touch.at({0.05, 0.0, -0.004}).x(), 0.0, 1e-12);
}

TEST(GodObject, NeverPullsInAndNeverRubsHarderThanItPresses) {
  RandomStream random(11, "god object");
  for (int run = 0; run < 50; ++run) {
    const double ratio = random.uniform(0.0, 1.5);
    Touch touch({.stiffness_n_per_m = random.uniform(1.0, 100'000.0),
                 .damping_n_s_per_m = random.uniform(0.0, 200.0),
                 .friction_ratio = ratio});
    for (int tick = 0; tick < 200; ++tick) {
      const Eigen::Vector3d position(random.normal(0.0, 0.01), random.normal(0.0, 0.01),
                                     random.normal(0.0, 0.01));
      const Eigen::Vector3d velocity(random.normal(), random.normal(), random.normal());
      const Eigen::Vector3d force = touch.at(position, velocity);
      ASSERT_GE(force.z(), 0.0);
      ASSERT_LE(std::hypot(force.x(), force.y()), ratio * force.z() * (1.0 + 1e-9) + 1e-9);
      ASSERT_TRUE(force.allFinite());
      if (position.z() >= 0.0) {
        ASSERT_EQ(force.norm(), 0.0);
      }
    }
  }
}

TEST(GodObject, TouchingItIsNoForceStep) {
  Touch touch({.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 50.0, .friction_ratio = 1.0});
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (double depth = 0.0; depth < 0.003; depth += 1e-6) {
    const Eigen::Vector3d force = touch.at({2.0 * depth, 0.0, -depth}, {1.0, 0.0, -0.5});
    EXPECT_LT((force - last).norm(), 0.1);
    last = force;
  }
}

TEST(GodObject, APointThatBeginsInsideIsPushedOutGently) {
  GodObject point;
  const SolidAmounts amounts = solid_amounts({.stiffness_n_per_m = 1000.0});
  const Eigen::Vector3d inside(0.0, 0.0, -0.02);
  double last = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    const double force =
        point.force_n(amounts, kUp, 0.02, inside, Eigen::Vector3d::Zero(), kPeriodS).z();
    // The surface rises at 5 cm/s, and its stiffness is 1000 N/m.
    ASSERT_LE(force - last, 0.05 + 1e-9);
    ASSERT_GE(force, last - 1e-12);
    last = force;
  }
  EXPECT_NEAR(last, 20.0, 1e-9) << "and then as any other";
}

TEST(GodObject, ASurfaceRaisedUnderThePointIsNoStepEither) {
  Touch touch({.stiffness_n_per_m = 1000.0});
  const double before = touch.at({0.0, 0.0, -0.002}).z();
  touch.point.surface_rose(0.030);
  const auto raised = [&] {
    return touch.point
        .force_n(touch.amounts, kUp, 0.032, {0.0, 0.0, -0.002}, Eigen::Vector3d::Zero(),
                 kPeriodS)
        .z();
  };
  double last = raised();
  EXPECT_NEAR(last, before, 0.051);
  for (int tick = 0; tick < 1000; ++tick) {
    const double force = raised();
    ASSERT_LE(force - last, 0.05 + 1e-9);
    last = force;
  }
  EXPECT_NEAR(last, 32.0, 1e-9);
}

TEST(GodObject, OnTheWayOutItKeepsWhatItHasSunk) {
  GodObject point;
  const SolidAmounts amounts = solid_amounts({.stiffness_n_per_m = 1000.0});
  const auto at_depth = [&](double depth) {
    return point
        .force_n(amounts, kUp, depth, {0.0, 0.0, -depth}, Eigen::Vector3d::Zero(), kPeriodS)
        .z();
  };
  (void)at_depth(0.02);
  (void)at_depth(0.005);
  // The point came out to 5 mm by itself. Pressed in again, it meets the surface there.
  EXPECT_NEAR(at_depth(0.010), 5.0, 0.11);
}

TEST(GodObject, AnImpactAtThreeMetresPerSecondIsFiniteAndBounded) {
  Touch touch({.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 1.0, .friction_ratio = 0.3});
  double z = 0.002;
  for (int tick = 0; tick < 20; ++tick) {
    z -= 3.0 * kPeriodS;
    const Eigen::Vector3d force = touch.at({0.001 * tick, 0.0, z}, {1.0, 0.0, -3.0});
    ASSERT_TRUE(force.allFinite());
    ASSERT_GE(force.z(), 0.0);
    ASSERT_LE(force.z(), 1000.0 * std::max(0.0, -z) + 3.0 + 1e-9);
  }
}

TEST(GodObject, LeavesANumberThatIsNoneForTheLimiterToSee) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Touch touch({.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 1.0, .friction_ratio = 0.3});
  EXPECT_FALSE(touch.at({0.0, 0.0, -0.01}, {0.0, 0.0, nan}).allFinite());
  for (double SolidAmounts::*const amount :
       {&SolidAmounts::stiffness_n_per_m, &SolidAmounts::damping_n_s_per_m,
        &SolidAmounts::friction_n_per_m}) {
    Touch broken(
        {.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 1.0, .friction_ratio = 0.3});
    broken.amounts.*amount = nan;
    EXPECT_FALSE(broken.at({0.0, 0.0, -0.01}, {0.1, 0.0, 0.1}).allFinite());
  }
}

TEST(SolidAmounts, NameTheParameterTheyReject) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {-1.0, nan, infinity}) {
    EXPECT_THROW((void)solid_amounts({.stiffness_n_per_m = wrong}), Error);
    EXPECT_THROW((void)solid_amounts({.stiffness_n_per_m = 1.0, .damping_n_s_per_m = wrong}),
                 Error);
    EXPECT_THROW((void)solid_amounts({.stiffness_n_per_m = 1.0, .friction_ratio = wrong}),
                 Error);
  }
  EXPECT_THROW((void)solid_amounts({.stiffness_n_per_m = 1e300, .friction_ratio = 1e300}),
               Error);
}

}  // namespace god_object_test
}  // namespace jnd::core
