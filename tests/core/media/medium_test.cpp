#include "core/media/medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace medium_test {

HandMotion moving(double speed_m_per_s, double sin_angle_of_attack) {
  return {.velocity_m_per_s = {speed_m_per_s, 0.0, 0.0},
          .speed_m_per_s = speed_m_per_s,
          .sin_angle_of_attack = sin_angle_of_attack};
}

TEST(MediumAmounts, GiveTheForceOfEachLaw) {
  const HandMotion motion = moving(0.7, 0.6);
  EXPECT_EQ(free_space().drag_n(motion), 0.0);
  EXPECT_NEAR(water({.scale = 2.0}).drag_n(motion), WaterDrag({.scale = 2.0}).drag_n(0.7, 0.6),
              1e-14);
  EXPECT_NEAR(viscous({.viscosity_pa_s = 3.0}).drag_n(motion),
              ViscousDrag({.viscosity_pa_s = 3.0}).drag_n(0.7), 1e-14);
  EXPECT_EQ(solid({.stiffness_n_per_m = 500.0}).drag_n(motion), 0.0);
}

TEST(MediumAmounts, AddUp) {
  MediumAmounts both = water({.scale = 2.0});
  both.damping_n_s_per_m = viscous({.viscosity_pa_s = 3.0}).damping_n_s_per_m;
  const HandMotion motion = moving(0.3, 0.9);
  EXPECT_NEAR(
      both.drag_n(motion),
      water({.scale = 2.0}).drag_n(motion) + viscous({.viscosity_pa_s = 3.0}).drag_n(motion),
      1e-14);
}

TEST(MediumAmounts, NeedParametersInRange) {
  EXPECT_THROW(static_cast<void>(water({.scale = -1.0})), Error);
  EXPECT_THROW(static_cast<void>(viscous({.viscosity_pa_s = -1.0})), Error);
  EXPECT_THROW(static_cast<void>(solid({.stiffness_n_per_m = -1.0})), Error);
}

TEST(MediumRamp, StartsInFreeSpaceAndHasArrived) {
  MediumRamp ramp;
  EXPECT_TRUE(ramp.finished());
  EXPECT_EQ(ramp.advance(0.001).damping_n_s_per_m, 0.0);
}

TEST(MediumAmounts, AreNowhereMoreIfNoAmountIsLarger) {
  const MediumAmounts fluid = viscous({.viscosity_pa_s = 3.0});
  const MediumAmounts both = fluid + water({.scale = 2.0});
  EXPECT_TRUE(free_space().is_nowhere_more_than(fluid));
  EXPECT_TRUE(fluid.is_nowhere_more_than(fluid));
  EXPECT_TRUE(fluid.is_nowhere_more_than(both));
  EXPECT_FALSE(both.is_nowhere_more_than(fluid));
  EXPECT_FALSE(water({.scale = 0.1}).is_nowhere_more_than(fluid)) << "less, but of another law";
}

/// Gives every amount another number.
MediumAmounts all_different(double scale = 1.0) {
  MediumAmounts amounts;
  double value = 0.0;
  for (const auto amount : kAmounts) amounts.*amount = scale * (value += 1.5);
  return amounts;
}

TEST(MediumRamp, IsAStraightLineInEveryAmountAndEndsExactly) {
  const MediumAmounts target = all_different();
  MediumRamp ramp;
  ramp.start(target, 0.050);
  for (int tick = 1; tick < 50; ++tick) {
    const MediumAmounts& amounts = ramp.advance(0.001);
    EXPECT_FALSE(ramp.finished());
    for (const auto amount : kAmounts) {
      EXPECT_NEAR(amounts.*amount, tick / 50.0 * target.*amount, 1e-9);
    }
  }
  ramp.advance(0.001);
  ramp.advance(0.001);  // Rounding may leave a very small part of the ramp to the 51st tick.
  EXPECT_TRUE(ramp.finished());
  for (const auto amount : kAmounts) EXPECT_EQ(ramp.current().*amount, target.*amount);
}

TEST(MediumAmounts, AddInEveryAmount) {
  const MediumAmounts sum = all_different() + all_different(2.0);
  const MediumAmounts expected = all_different(3.0);
  for (const auto amount : kAmounts) EXPECT_NEAR(sum.*amount, expected.*amount, 1e-12);
}

TEST(MediumAmounts, AreFiniteOnlyIfEveryOneIs) {
  EXPECT_TRUE(all_different().is_finite());
  for (const auto amount : kAmounts) {
    for (const double wrong :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      MediumAmounts amounts = all_different();
      amounts.*amount = wrong;
      EXPECT_FALSE(amounts.is_finite());
    }
  }
}

TEST(MediumAmounts, KnowWhenTheyAreADampingAndNothingElse) {
  EXPECT_TRUE(viscous({.viscosity_pa_s = 3.0}).is_plain_damping());
  EXPECT_TRUE(free_space().is_plain_damping());
  EXPECT_FALSE(water({}).is_plain_damping());
  EXPECT_FALSE(viscous_inertial({.viscosity_pa_s = 3.0}).is_plain_damping());
  EXPECT_FALSE(ellipsoid({.viscosity_pa_s = 3.0}).is_plain_damping());
}

TEST(MediumAmounts, OfEachNewMediumAreItsLaws) {
  const MediumAmounts inertial = viscous_inertial({.viscosity_pa_s = 2.0});
  EXPECT_EQ(inertial.damping_n_s_per_m, viscous({.viscosity_pa_s = 2.0}).damping_n_s_per_m);
  EXPECT_NEAR(inertial.drag_n(moving(0.5, 0.0)),
              inertial.damping_n_s_per_m * 0.5 + inertial.inertial_n * std::pow(0.5, 1.687),
              1e-12);
  const MediumAmounts mapped = mapped_water({.scale = 2.0});
  EXPECT_NEAR(mapped.drag_n(moving(0.7, 0.6)), water({.scale = 2.0}).drag_n(moving(0.7, 0.6)),
              1e-12)
      << "without a map the thesis's";
  const MediumAmounts bucket =
      container({.stiffness_n_per_m = 800.0, .damping_n_s_per_m = 2.0, .friction_ratio = 0.5});
  EXPECT_EQ(bucket.container().stiffness_n_per_m, 800.0);
  EXPECT_EQ(bucket.container().damping_n_s_per_m, 2.0);
  EXPECT_EQ(bucket.container().friction_n_per_m, 400.0);
  EXPECT_FALSE(bucket.plane().is_there());
  EXPECT_THROW(static_cast<void>(buoyant(-1.0)), Error);
  EXPECT_EQ(buoyant(3.0).buoyancy_n, 3.0);
}

TEST(MediumRamp, StartsFromWhereAnUnfinishedRampHadCome) {
  MediumRamp ramp;
  ramp.start({.damping_n_s_per_m = 10.0}, 0.1);
  for (int tick = 0; tick < 50; ++tick) ramp.advance(0.001);
  const double halfway = ramp.current().damping_n_s_per_m;
  ramp.start(free_space(), 0.1);
  EXPECT_NEAR(ramp.advance(0.001).damping_n_s_per_m, 0.99 * halfway, 1e-9);
}

TEST(MediumRamp, ARampTimeThatIsNoTimeIsOverAtOnce) {
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    MediumRamp ramp;
    ramp.start({.damping_n_s_per_m = 10.0}, wrong);
    EXPECT_EQ(ramp.advance(0.001).damping_n_s_per_m, 10.0);
    EXPECT_TRUE(ramp.finished());
  }
}

TEST(MediumRamp, IsSafeToCallOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  const MediumAmounts honey = viscous({.viscosity_pa_s = 10.0});
  MediumRamp ramp;
  const test_support::AllocationCounter counter;
  ramp.start(honey, 0.05);
  const double drag_n = ramp.advance(0.001).drag_n(moving(0.1, 1.0));
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_GT(drag_n, 0.0);
}

}  // namespace medium_test
}  // namespace jnd::core
