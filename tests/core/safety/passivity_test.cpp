#include "core/safety/passivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/media/god_object.h"
#include "core/random_stream.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace passivity_test {

constexpr double kPeriodS = 0.001;

PointVectors five_of(const Eigen::Vector3d& vector) {
  return {vector, vector, vector, vector, vector};
}

/// Returns the upward force of a flat surface at this depth.
double surface_n(double stiffness_n_per_m, double damping_n_s_per_m, double depth_m,
                 double velocity_m_per_s) {
  GodObject point;
  const SolidAmounts amounts = {stiffness_n_per_m, damping_n_s_per_m, 0.0};
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  (void)point.force_n(amounts, up, 0.0, -depth_m * up, velocity_m_per_s * up, kPeriodS);
  return point.force_n(amounts, up, depth_m, -depth_m * up, velocity_m_per_s * up, kPeriodS)
      .z();
}

PassivityController controller() { return {PassivityController::Parameters{}, kPeriodS}; }

TEST(PassivityController, ChangesNothingAboutDragWhateverTheMotion) {
  PassivityController passivity = controller();
  RandomStream random(3, "passivity");
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int tick = 0; tick < 20'000; ++tick) {
    const Eigen::Vector3d velocity(random.normal(), random.normal(), random.normal());
    position += kPeriodS * velocity;
    // The drag is quadratic and linear, and its damping jumps at random.
    const PointVectors drag =
        five_of(-(random.uniform(0.0, 60.0) + 7.0 * velocity.norm()) * velocity);
    PointVectors force = drag;
    EXPECT_FALSE(passivity.control(five_of(position), five_of(velocity), force));
    for (int i = 0; i < kNumContactPoints; ++i) ASSERT_EQ(force[i], drag[i]);
    passivity.sent(force);
  }
}

TEST(PassivityController, CountsTheEnergyThatWasReallyPutIn) {
  PassivityController passivity = controller();
  PointVectors force = five_of({-2.0, 0.0, 0.0});
  passivity.control(five_of({0.0, 0.0, 0.0}), five_of({1.0, 0.0, 0.0}), force);
  passivity.sent(force);
  // The energy is that of 2 N over 3 mm.
  passivity.control(five_of({0.003, 0.0, 0.0}), five_of({1.0, 0.0, 0.0}), force);
  EXPECT_NEAR(passivity.credit_j(ContactPoint::kThumb), 0.006, 1e-15);
}

TEST(PassivityController, ForgetsItsCreditWhenReset) {
  PassivityController passivity = controller();
  PointVectors force = five_of({-2.0, 0.0, 0.0});
  passivity.control(five_of({0.0, 0.0, 0.0}), five_of({1.0, 0.0, 0.0}), force);
  passivity.sent(force);
  passivity.control(five_of({0.003, 0.0, 0.0}), five_of({1.0, 0.0, 0.0}), force);
  passivity.reset();
  EXPECT_EQ(passivity.credit_j(ContactPoint::kThumb), 0.0);
  // It does not count the earlier way of 1 m either.
  passivity.control(five_of({1.0, 0.0, 0.0}), five_of({1.0, 0.0, 0.0}), force);
  EXPECT_EQ(passivity.credit_j(ContactPoint::kThumb), 0.0);
}

TEST(PassivityController, GivesBackNoMoreThanWasPutIn) {
  // The surface pushes back twice as hard as it was pressed, so it is active.
  PassivityController passivity = controller();
  double put_in_j = 0.0;
  double lowest_j = 0.0;
  PointVectors last_force = zero_vectors();
  double last_z = 0.0;
  for (int tick = 0; tick < 3000; ++tick) {
    const double phase = 2.0 * 3.14159265 * tick / 500.0;
    const double z = 0.01 * std::cos(phase);
    const double velocity = -0.01 * 2.0 * 3.14159265 / 0.5 * std::sin(phase);
    put_in_j -= last_force[0].z() * (z - last_z);
    last_z = z;
    lowest_j = std::min(lowest_j, put_in_j);
    const double stiffness = velocity > 0.0 ? 2000.0 : 1000.0;
    PointVectors force = five_of({0.0, 0.0, surface_n(stiffness, 0.0, -z, velocity)});
    const double wanted = force[0].z();
    passivity.control(five_of({0.0, 0.0, z}), five_of({0.0, 0.0, velocity}), force);
    // The controller only takes away force, down to zero, and never makes it a pull.
    EXPECT_LE(force[0].z(), wanted + 1e-12);
    EXPECT_GE(force[0].z(), -1e-12);
    passivity.sent(force);
    last_force = force;
  }
  // Without control, each of six cycles would give 50 mJ more than it got. What remains is the
  // error of predicting the way of one period from the velocity.
  EXPECT_GT(lowest_j, -0.5e-3);
}

TEST(PassivityController, LetsAPassiveSurfaceReturnWhatItStored) {
  PassivityController passivity = controller();
  double softened_n = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    const double phase = 3.14159265 * tick / 1000.0;
    const double z = -0.01 * std::sin(phase);
    const double velocity = -0.01 * 3.14159265 * std::cos(phase);
    PointVectors force = five_of({0.0, 0.0, surface_n(1000.0, 10.0, -z, velocity)});
    const double wanted = force[0].z();
    passivity.control(five_of({0.0, 0.0, z}), five_of({0.0, 0.0, velocity}), force);
    softened_n = std::max(softened_n, wanted - force[0].z());
    passivity.sent(force);
  }
  EXPECT_LT(softened_n, 0.05);
}

TEST(PassivityController, DoesNotBuzzWithTheNoiseOfAVelocityAtRest) {
  // A float appears around a hand that has put in no energy yet, and whose measured velocity is
  // mostly noise. When the push was taken away along that velocity, 3 N were sent to and fro.
  PassivityController passivity = controller();
  RandomStream random(1, "noise");
  passivity.grant_credit(0b01111);
  for (int tick = 0; tick < 2000; ++tick) {
    const Eigen::Vector3d velocity(random.normal(0.0, 0.01), random.normal(0.0, 0.01),
                                   random.normal(0.0, 0.01));
    PointVectors force = five_of({0.0, 0.0, 8.0});
    passivity.control(five_of(Eigen::Vector3d::Zero()), five_of(velocity), force);
    passivity.sent(force);
    EXPECT_EQ(force[0], Eigen::Vector3d(0.0, 0.0, 8.0));
  }
  EXPECT_EQ(passivity.credit_j(ContactPoint::kIndex), 1.0);
  EXPECT_EQ(passivity.credit_j(ContactPoint::kMiddle), 0.0) << "what does not store gets none";
}

TEST(PassivityController, WhatWasGrantedIsGivenOnce) {
  PassivityController passivity({.max_credit_j = 0.1}, kPeriodS);
  passivity.grant_credit(0b11111);
  double x = 0.0, given_j = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    PointVectors force = five_of({10.0, 0.0, 0.0});
    passivity.control(five_of({x, 0.0, 0.0}), five_of({0.5, 0.0, 0.0}), force);
    passivity.sent(force);
    x += 0.0005;
    given_j += 0.0005 * force[0].x();
  }
  EXPECT_NEAR(given_j, 0.1, 1e-9);
}

TEST(PassivityController, LongDragDoesNotPayForAnEndlessPush) {
  PassivityController passivity({.max_credit_j = 0.1}, kPeriodS);
  double x = 0.0;
  PointVectors force = five_of({-10.0, 0.0, 0.0});
  for (int tick = 0; tick < 5000; ++tick) {
    passivity.control(five_of({x, 0.0, 0.0}), five_of({0.5, 0.0, 0.0}), force);
    passivity.sent(force);
    x += 0.0005;
  }
  EXPECT_DOUBLE_EQ(passivity.credit_j(ContactPoint::kIndex), 0.1);
  // 10 N at 0.5 m/s use 5 mJ in each tick, so the credit is used up after 20 ticks.
  int pushed_ticks = 0;
  for (int tick = 0; tick < 100; ++tick) {
    force = five_of({10.0, 0.0, 0.0});
    passivity.control(five_of({x, 0.0, 0.0}), five_of({0.5, 0.0, 0.0}), force);
    passivity.sent(force);
    x += 0.0005;
    pushed_ticks += force[0].x() > 1e-9 ? 1 : 0;
  }
  EXPECT_NEAR(pushed_ticks, 20, 2);
}

TEST(PassivityController, IsNotPoisonedByValuesThatAreNoNumbers) {
  PassivityController passivity = controller();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PointVectors force = five_of({nan, 0.0, 0.0});
  passivity.control(five_of({nan, 0.0, 0.0}), five_of({1.0, 0.0, 0.0}), force);
  passivity.sent(force);
  EXPECT_TRUE(std::isnan(force[0].x()));
  force = five_of({-1.0, 0.0, 0.0});
  passivity.control(five_of({0.0, 0.0, 0.0}), five_of({nan, 0.0, 0.0}), force);
  passivity.sent(force);
  EXPECT_EQ(passivity.credit_j(ContactPoint::kIndex), 0.0);
}

TEST(PassivityController, AVelocityWhoseSquareIsLostMakesNoInfiniteForce) {
  for (const double velocity : {1e-7, 1e-160, 1e-170, -1e-170, 1e-323, -1e-323}) {
    PassivityController passivity = controller();
    PointVectors force = five_of({std::copysign(3.0, velocity), 2.0, 0.0});
    const PointVectors asked = force;
    passivity.control(five_of({0.0, 0.0, 0.0}), five_of({velocity, 0.0, 0.0}), force);
    EXPECT_EQ(force, asked) << velocity;
  }
}

TEST(PassivityController, NamesTheParameterItRejects) {
  EXPECT_THROW(PassivityController({.max_credit_j = 0.0}, kPeriodS), Error);
  EXPECT_THROW(PassivityController({}, 0.0), Error);
}

TEST(PassivityController, IsSafeToCallOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  PassivityController passivity = controller();
  const test_support::AllocationCounter counter;
  PointVectors force = five_of({1.0, 0.0, 0.0});
  EXPECT_TRUE(passivity.control(five_of({0.0, 0.0, 0.0}), five_of({1.0, 0.0, 0.0}), force));
  passivity.sent(force);
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace passivity_test
}  // namespace jnd::core
