#include "analysis/movement/finger_lag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/allocation_counter.h"

namespace jnd::analysis {
namespace finger_lag_test {

constexpr double kTickS = 0.001;
constexpr double kOmega = 2.0 * std::numbers::pi * 0.7;
const Eigen::Vector3d kPosture(0.02, 0.09, 0.01);

Eigen::Vector3d palm_at(double time_s) {
  return 0.13 * std::sin(kOmega * time_s) * Eigen::Vector3d(0.6, 0.8, 0.3);
}

Eigen::Vector3d palm_velocity_at(double time_s) {
  return 0.13 * kOmega * std::cos(kOmega * time_s) * Eigen::Vector3d(0.6, 0.8, 0.3);
}

/// Feeds ten seconds of strokes in which the fingers do what the palm did `lag_s` before.
void feed(FingerLag& lag, double lag_s) {
  for (double time_s = 0.0; time_s < 10.0; time_s += kTickS) {
    lag.feed(palm_at(time_s - lag_s) + kPosture, palm_at(time_s), palm_velocity_at(time_s));
  }
}

TEST(FingerLag, FindsTheDelayOfFingersThatFollowAndOfFingersThatLead) {
  for (const double lag_s : {0.02, 0.002, -0.015}) {
    FingerLag lag;
    feed(lag, lag_s);
    // For a sine, the result is sin(omega lag) / omega, which is less than the lag by the
    // fraction omega^2 lag^2 / 6.
    EXPECT_NEAR(lag.finish().value(), std::sin(kOmega * lag_s) / kOmega, 1e-6) << lag_s;
  }
}

TEST(FingerLag, APauseDoesNotChangeIt) {
  FingerLag lag;
  feed(lag, 0.02);
  const Eigen::Vector3d rest = palm_at(10.0);
  for (int tick = 0; tick < 20'000; ++tick) {
    lag.feed(rest + kPosture, rest, Eigen::Vector3d::Zero());
  }
  EXPECT_NEAR(lag.finish().value(), 0.02, 1e-3);
}

TEST(FingerLag, AStiffHandHasNoneAndARestingOneNeither) {
  FingerLag lag;
  feed(lag, 0.0);
  EXPECT_FALSE(lag.finish());
  for (int tick = 0; tick < 1000; ++tick) {
    const Eigen::Vector3d trembling(1e-4 * std::sin(tick), 0.0, 0.0);
    lag.feed(kPosture + trembling, Eigen::Vector3d::Zero(), 1e-4 * Eigen::Vector3d::Ones());
  }
  EXPECT_FALSE(lag.finish());
  EXPECT_FALSE(lag.finish());
}

TEST(FingerLag, WhatIsNotFiniteIsLeftOutAndEachFinishStartsAnew) {
  FingerLag lag;
  feed(lag, 0.02);
  const double expected = lag.finish().value();
  lag.feed(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()),
           Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  feed(lag, 0.02);
  EXPECT_DOUBLE_EQ(lag.finish().value(), expected);
}

TEST(FingerLag, TakesNoMemory) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  FingerLag lag;
  const test_support::AllocationCounter counter;
  feed(lag, 0.01);
  (void)lag.finish();
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace finger_lag_test
}  // namespace jnd::analysis
