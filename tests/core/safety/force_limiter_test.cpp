#include "core/safety/force_limiter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random_stream.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace force_limiter_test {

constexpr double kPeriodS = 0.001;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PointVectors five_of(const Eigen::Vector3d& vector) {
  return {vector, vector, vector, vector, vector};
}

ForceLimiter limiter() { return {ForceLimiter::Parameters{}, kPeriodS}; }

/// Returns a limiter whose slew is so high that it has no effect.
ForceLimiter without_slew() { return {{.slew_n_per_s = 1e9}, kPeriodS}; }

double sum_of_magnitudes(const PointVectors& forces) {
  double sum = 0.0;
  for (const Eigen::Vector3d& force : forces) sum += force.norm();
  return sum;
}

TEST(ForceLimiter, LeavesWhatIsWithinItsBoundsUntouched) {
  ForceLimiter limit = limiter();
  PointVectors force = five_of({0.5, -0.5, 1.0});
  EXPECT_FALSE(limit.limit(kAllAttached, five_of({1, 0, 0}), force));
  for (const Eigen::Vector3d& point : force) EXPECT_EQ(point, Eigen::Vector3d(0.5, -0.5, 1.0));
}

TEST(ForceLimiter, ShortensOnePointAndKeepsItsDirection) {
  ForceLimiter limit = without_slew();
  PointVectors force = zero_vectors();
  force[1] = {12.0, 16.0, 0.0};
  EXPECT_TRUE(limit.limit(kAllAttached, five_of({0, 0, 0}), force));
  EXPECT_NEAR(force[1].x(), 6.0, 1e-12);
  EXPECT_NEAR(force[1].y(), 8.0, 1e-12);
}

TEST(ForceLimiter, ScalesAllPointsTogetherWhenTheSumIsTooMuch) {
  ForceLimiter limit = without_slew();
  PointVectors force = five_of({0.0, 0.0, 8.0});
  force[4] = {4.0, 0.0, 0.0};
  EXPECT_TRUE(limit.limit(kAllAttached, five_of({0, 0, 0}), force));
  // The whole force is 36 N, so every force becomes 30/36 of itself.
  EXPECT_NEAR(force[0].z(), 8.0 * 30.0 / 36.0, 1e-12);
  EXPECT_NEAR(force[4].x(), 4.0 * 30.0 / 36.0, 1e-12);
}

TEST(ForceLimiter, LetsAForceChangeOnlySoFastAndArrivesInTheEnd) {
  ForceLimiter limit = limiter();
  PointVectors force = zero_vectors();
  for (int tick = 1; tick <= 3; ++tick) {
    force = zero_vectors();
    force[0] = {5.0, 0.0, 0.0};
    // 2000 N/s in 1 ms is 2 N.
    EXPECT_EQ(limit.limit(kAllAttached, five_of({0, 0, 0}), force), tick < 3);
    EXPECT_NEAR(force[0].x(), std::min(5.0, 2.0 * tick), 1e-12);
  }
}

TEST(ForceLimiter, ADetachedPointGetsNothingAtOnce) {
  ForceLimiter limit = limiter();
  PointVectors force = five_of({2.0, 0.0, 0.0});
  limit.limit(kAllAttached, five_of({0, 0, 0}), force);
  force = five_of({2.0, 0.0, 0.0});
  EXPECT_TRUE(limit.limit({true, true, false, true, true}, five_of({0, 0, 0}), force));
  EXPECT_EQ(force[2], Eigen::Vector3d::Zero());
  EXPECT_EQ(force[0], Eigen::Vector3d(2.0, 0.0, 0.0));
}

TEST(ForceLimiter, ADetachedPointMayFlyAroundWithoutAFault) {
  ForceLimiter limit = limiter();
  PointVectors velocity = five_of({0, 0, 0});
  velocity[2] = {40.0, 0.0, 0.0};
  PointVectors force = five_of({1.0, 0.0, 0.0});
  limit.limit({true, true, false, true, true}, velocity, force);
  EXPECT_EQ(limit.fault(), Fault::kNone);
}

TEST(ForceLimiter, AForceThatIsNoNumberIsALatchedFault) {
  for (const double wrong : {kNan, kInfinity, -kInfinity, 1e300}) {
    ForceLimiter limit = limiter();
    PointVectors force = five_of({1.0, 0.0, 0.0});
    limit.limit(kAllAttached, five_of({0, 0, 0}), force);
    force[3].y() = wrong;
    EXPECT_TRUE(limit.limit(kAllAttached, five_of({0, 0, 0}), force));
    EXPECT_EQ(limit.fault(), Fault::kNonFiniteForce) << wrong;
    EXPECT_EQ(sum_of_magnitudes(force), 0.0);
    force = five_of({1.0, 0.0, 0.0});
    EXPECT_TRUE(limit.limit(kAllAttached, five_of({0, 0, 0}), force));
    EXPECT_EQ(sum_of_magnitudes(force), 0.0);
    limit.rearm();
    force = five_of({4.0, 0.0, 0.0});
    EXPECT_TRUE(limit.limit(kAllAttached, five_of({0, 0, 0}), force));
    EXPECT_NEAR(force[0].x(), 2.0, 1e-12) << "it comes back from zero, within the slew";
  }
}

TEST(ForceLimiter, AVelocityThatIsNoNumberOrTooHighIsALatchedFault) {
  for (const auto& [speed, fault] :
       {std::pair(kNan, Fault::kNonFiniteState), std::pair(kInfinity, Fault::kOverVelocity),
        std::pair(5.001, Fault::kOverVelocity)}) {
    ForceLimiter limit = limiter();
    PointVectors velocity = five_of({0, 0, 0});
    velocity[1].z() = speed;
    PointVectors force = five_of({1.0, 0.0, 0.0});
    EXPECT_TRUE(limit.limit(kAllAttached, velocity, force));
    EXPECT_EQ(limit.fault(), fault) << speed;
    EXPECT_EQ(sum_of_magnitudes(force), 0.0);
  }
}

/// Returns any number that a device or an error in the program may produce.
double wild_number(RandomStream& random) {
  switch (random.below(16)) {
    case 0:
      return 0.0;
    case 1:
      return std::numeric_limits<double>::denorm_min();
    case 2:
      return -std::numeric_limits<double>::min();
    case 3:
      return 1e-300;
    case 4:
      return -1e150;
    default:
      return std::pow(10.0, random.uniform(-3.0, 3.0)) * (random.below(2) == 0 ? 1.0 : -1.0);
  }
}

TEST(ForceLimiter, ItsBoundsHoldWhateverComesIn) {
  RandomStream random(17, "limiter");
  const ForceLimiter::Parameters bounds;
  ForceLimiter limit(bounds, kPeriodS);
  PointVectors last = zero_vectors();
  int num_faults = 0;
  for (int tick = 0; tick < 100'000; ++tick) {
    PointVectors force;
    for (Eigen::Vector3d& point : force) {
      point = {wild_number(random), wild_number(random), wild_number(random)};
    }
    if (random.below(500) == 0) force[random.below(5)].x() = kNan;
    if (random.below(500) == 0) force[random.below(5)].y() = kInfinity;
    std::array<bool, kNumContactPoints> attached = kAllAttached;
    if (random.below(10) == 0) attached[random.below(5)] = false;
    const PointVectors asked = force;
    const bool changed = limit.limit(attached, five_of({0, 0, 0}), force);

    bool differs = false;
    for (int i = 0; i < kNumContactPoints; ++i) {
      ASSERT_TRUE(force[i].allFinite());
      ASSERT_LE(force[i].norm(), bounds.per_point_n * (1.0 + 1e-12));
      if (!attached[i]) {
        ASSERT_EQ(force[i], Eigen::Vector3d::Zero());
      }
      if (attached[i] && limit.fault() == Fault::kNone) {
        ASSERT_LE((force[i] - last[i]).norm(), bounds.slew_n_per_s * kPeriodS * (1.0 + 1e-9));
      }
      differs |= force[i] != asked[i];
    }
    ASSERT_LE(sum_of_magnitudes(force), bounds.total_n * (1.0 + 1e-12));
    ASSERT_EQ(changed, differs);
    last = force;
    if (limit.fault() != Fault::kNone) {
      ++num_faults;
      ASSERT_EQ(sum_of_magnitudes(force), 0.0);
      limit.rearm();
    }
  }
  EXPECT_GT(num_faults, 100);
}

TEST(ForceLimiter, NamesTheParameterItRejects) {
  for (const double wrong : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_THROW(ForceLimiter({.per_point_n = wrong}, kPeriodS), Error);
    EXPECT_THROW(ForceLimiter({.total_n = wrong}, kPeriodS), Error);
    EXPECT_THROW(ForceLimiter({.slew_n_per_s = wrong}, kPeriodS), Error);
    EXPECT_THROW(ForceLimiter({.max_speed_m_per_s = wrong}, kPeriodS), Error);
    EXPECT_THROW(ForceLimiter({}, wrong), Error);
  }
}

TEST(ForceLimiter, IsSafeToCallOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  ForceLimiter limit = limiter();
  const test_support::AllocationCounter counter;
  PointVectors force = five_of({20.0, 0.0, 0.0});
  EXPECT_TRUE(limit.limit(kAllAttached, five_of({0, 0, 0}), force));
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace force_limiter_test
}  // namespace jnd::core
