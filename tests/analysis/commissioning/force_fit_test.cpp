#include "analysis/commissioning/force_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace force_fit_test {

/// The true values of a device.
struct Truth {
  double gain = 0.9, weight_n = 1.5, damping_n_s_per_m = 2.4, friction_n = 0.6, mass_kg = 0.7;
  double sideways_n = 0.2;  ///< A constant force along +x.
};

constexpr double kMassPerGain_kg = 0.7 / 0.9;

/// Returns the command for a path, which balances forces and inertia.
double commanded_n(const Truth& truth, const GuidedWay& way, const Eigen::Vector3d& up) {
  const Eigen::Vector3d constant_n =
      -truth.weight_n * up + truth.sideways_n * Eigen::Vector3d::UnitX();
  return (way.load_n * (up.dot(way.direction) + way.acceleration_m_per_s2 / 9.80665) +
          truth.mass_kg * way.acceleration_m_per_s2 +
          truth.damping_n_s_per_m * way.speed_m_per_s + truth.friction_n -
          constant_n.dot(way.direction)) /
         truth.gain;
}

std::vector<GuidedWay> ways_of(const Truth& truth, const Eigen::Vector3d& up, double sd_n,
                               core::RandomStream& random, double load_error_ratio = 0.0) {
  std::vector<GuidedWay> ways;
  const auto go = [&](const Eigen::Vector3d& direction, double speed_m_per_s, double load_n,
                      int pose) {
    GuidedWay way{.direction = direction,
                  .speed_m_per_s = speed_m_per_s,
                  .acceleration_m_per_s2 = random.normal(0.0, 0.05),
                  .load_n = load_n * (1.0 + load_error_ratio),
                  .pose = pose};
    way.commanded_n = commanded_n(truth, way, up) + random.normal(0.0, sd_n);
    way.load_n = load_n;  // The load that the laboratory believes.
    ways.push_back(way);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sense : {1.0, -1.0}) {
      for (const double speed : {0.05, 0.1, 0.2, 0.3}) {
        go(sense * Eigen::Vector3d::Unit(axis), speed, 0.0, 0);
      }
    }
  }
  for (const double load_n : {1.0, 2.0, 4.0}) {
    for (const double sense : {1.0, -1.0}) {
      for (int pose = 0; pose < 3; ++pose) go(sense * up, 0.1, load_n, pose);
    }
  }
  return ways;
}

TEST(ForceFit, FindsEverythingWhereNothingIsNoisy) {
  const Truth truth;
  core::RandomStream random(1, "force");
  // The device's y axis points up.
  const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  const ForceFit fit = fit_force(ways_of(truth, up, 0.0, random), up, kMassPerGain_kg, 0.0);
  EXPECT_NEAR(fit.gain.value, truth.gain, 1e-9);
  EXPECT_NEAR(fit.weight_n.value, truth.weight_n, 1e-9);
  EXPECT_NEAR(fit.damping_n_s_per_m.value, truth.damping_n_s_per_m, 1e-9);
  EXPECT_NEAR(fit.friction_n.value, truth.friction_n, 1e-9);
  EXPECT_NEAR(fit.hysteresis_n.value, truth.friction_n / truth.gain, 1e-9);
  EXPECT_NEAR(fit.offset_n.x(), truth.sideways_n, 1e-9);
  EXPECT_NEAR(fit.pose_spread_ratio, 0.0, 1e-9);
}

TEST(ForceFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kStudies = 2000;
  const Truth truth;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  core::RandomStream random(2, "force");
  int gain = 0, weight = 0, damping = 0, friction = 0;
  for (int study = 0; study < kStudies; ++study) {
    const ForceFit fit = fit_force(ways_of(truth, up, 0.03, random), up, kMassPerGain_kg, 0.0);
    gain += fit.gain.holds(truth.gain) ? 1 : 0;
    weight += fit.weight_n.holds(truth.weight_n) ? 1 : 0;
    damping += fit.damping_n_s_per_m.holds(truth.damping_n_s_per_m) ? 1 : 0;
    friction += fit.friction_n.holds(truth.friction_n) ? 1 : 0;
  }
  // The tolerance is three standard errors of a proportion of 0.95.
  for (const int held : {gain, weight, damping, friction}) {
    EXPECT_NEAR(held / static_cast<double>(kStudies), 0.95, 0.015);
  }
}

TEST(ForceFit, WhatIsOpenOfTheLoadsWidensAllThatIsInNewtons) {
  const Truth truth;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  core::RandomStream random(3, "force");
  const std::vector<GuidedWay> ways =
      ways_of(truth, up, 0.0, random, /*load_error_ratio=*/0.01);
  const ForceFit sure = fit_force(ways, up, kMassPerGain_kg, 0.0),
                 unsure = fit_force(ways, up, kMassPerGain_kg, 0.01);
  // The load is 1 % heavier than believed, so every result is 1 % too small.
  EXPECT_NEAR(sure.gain.value, truth.gain / 1.01, 1e-9);
  EXPECT_FALSE(sure.gain.holds(truth.gain));
  EXPECT_TRUE(unsure.gain.holds(truth.gain));
  EXPECT_TRUE(unsure.damping_n_s_per_m.holds(truth.damping_n_s_per_m));
  EXPECT_TRUE(unsure.weight_n.holds(truth.weight_n));
}

TEST(ForceFit, DampingThatDiffersBetweenAxesIsThatOfTheFirst) {
  const Truth truth;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  core::RandomStream random(6, "force");
  std::vector<GuidedWay> ways = ways_of(truth, up, 0.03, random);
  const ForceFit alike = fit_force(ways, up, kMassPerGain_kg, 0.0);
  EXPECT_TRUE(alike.damps_alike);
  // The damping along y, where nothing hangs, is ten times as large.
  for (GuidedWay& way : ways) {
    if (way.direction.y() != 0.0) {
      way.commanded_n += 9.0 * truth.damping_n_s_per_m * way.speed_m_per_s / truth.gain;
    }
  }
  const ForceFit fit = fit_force(ways, up, kMassPerGain_kg, 0.0);
  EXPECT_FALSE(fit.damps_alike);
  EXPECT_TRUE(fit.damping_n_s_per_m.holds(truth.damping_n_s_per_m));
  // One damping for all axes would leave much more uncertainty.
  EXPECT_LT(fit.damping_n_s_per_m.ci95_high - fit.damping_n_s_per_m.ci95_low, 2.0);
  ASSERT_EQ(fit.damping_by_axis_n_s_per_m.size(), 3U);
  EXPECT_TRUE(fit.damping_by_axis_n_s_per_m[1].holds(10.0 * truth.damping_n_s_per_m));
  // Results that depend on loads are as certain as before.
  EXPECT_DOUBLE_EQ(fit.gain.value, alike.gain.value);
  EXPECT_DOUBLE_EQ(fit.gain.ci95_low, alike.gain.ci95_low);
  EXPECT_DOUBLE_EQ(fit.weight_n.value, alike.weight_n.value);
}

TEST(ForceFit, AGainThatDiffersBetweenPosesIsTold) {
  Truth weak, strong;
  weak.gain = 0.9;
  strong.gain = 1.0;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  core::RandomStream random(4, "force");
  std::vector<GuidedWay> ways = ways_of(weak, up, 0.0, random);
  for (GuidedWay& way : ways) {
    if (way.pose == 2) way.commanded_n *= 0.9;
  }
  EXPECT_GT(fit_force(ways, up, kMassPerGain_kg, 0.0).pose_spread_ratio, 0.03);
}

TEST(ForceFit, WaysThatDoNotTellItApartAreRefused) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  core::RandomStream random(5, "force");
  std::vector<GuidedWay> without_loads;
  for (const GuidedWay& way : ways_of({}, up, 0.01, random)) {
    if (way.load_n == 0.0) without_loads.push_back(way);
  }
  EXPECT_THROW((void)fit_force(without_loads, up, kMassPerGain_kg, 0.0), core::Error);
  // The loads hang at the wrong end.
  EXPECT_THROW((void)fit_force(ways_of({}, up, 0.0, random), -up, kMassPerGain_kg, 0.0),
               core::Error);
}

TEST(GuidedWay, IsTheBalanceOfEnergyAlongTheWay) {
  // The speed goes from 0.1 to 0.3 m/s within 0.4 s, at 0.5 m/s^2. The force is 2 N against a
  // spring that returns what it takes.
  std::vector<double> position_m, force_n;
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.001 * i;
    position_m.push_back(0.3 + 0.1 * t + 0.25 * t * t);
    force_n.push_back(2.0 + std::sin(2.0 * M_PI * (position_m.back() - 0.3) / 0.02));
  }
  const GuidedWay way =
      guided_way(Eigen::Vector3d::UnitY(), position_m, force_n, 0.001, 1.2, 2);
  EXPECT_NEAR(way.acceleration_m_per_s2, 0.5, 0.002);
  // This is the integral of v^2 over that of v, over the ticks between 8 ms from either end.
  const double from = 0.104, to = 0.296;
  const double expected =
      (to * to * to - from * from * from) / 3.0 / ((to * to - from * from) / 2.0);
  EXPECT_NEAR(way.speed_m_per_s, expected, 2e-4);
  EXPECT_NEAR(way.commanded_n, 2.0, 0.05);
  EXPECT_EQ(way.pose, 2);
  const std::vector<double> still(401, 0.1);
  EXPECT_THROW((void)guided_way(Eigen::Vector3d::UnitY(), still, force_n, 0.001, 0.0, 0),
               core::Error);
}

TEST(GuidedWay, FromRestToRestCountsTheWholePathAndNothingOfWhatLinksGaveBack) {
  // A tool of 1 kg, with a link of 2 kg on a spring behind it, goes 10 cm, overshoots and comes
  // to rest. The energy put in is what both dampers took, whatever the path. The equations are
  // solved in steps of 0.02 ms and reported once a millisecond.
  constexpr double kStep_s = 2e-5, kTick_s = 1e-3;
  double x_m = 0.0, v = 0.0, link_m = 0.0, link_v = 0.0, taken_j = 0.0, path_m = 0.0;
  std::vector<double> position_m, force_n;
  for (int tick = 0; tick < 8000; ++tick) {
    const double s = std::min(1.0, tick * kTick_s / 0.8);
    const double to_m = 0.1 * s * s * s * (10.0 + s * (6.0 * s - 15.0));
    const double force = 150.0 * (to_m - x_m) - 20.0 * v;
    // Taken at the middle of the time in which the force is constant.
    double middle_m = x_m;
    for (int step = 0; step < 50; ++step) {
      const double link_n = 80.0 * (link_m - x_m) + 4.0 * (link_v - v);
      taken_j += kStep_s * (3.0 * v * v + 4.0 * (link_v - v) * (link_v - v));
      link_v -= kStep_s * link_n / 2.0;
      v += kStep_s * (force + link_n - 3.0 * v);
      x_m += kStep_s * v;
      path_m += kStep_s * std::abs(v);
      link_m += kStep_s * link_v;
      if (step == 24) middle_m = x_m;
    }
    position_m.push_back(middle_m);
    force_n.push_back(force);
  }
  ASSERT_GT(path_m, 1.05 * x_m) << "it goes beyond, or the test is none";
  const GuidedWay way =
      guided_way(Eigen::Vector3d::UnitX(), position_m, force_n, kTick_s, 0.0, 0);
  EXPECT_NEAR(way.acceleration_m_per_s2, 0.0, 1e-4);
  EXPECT_NEAR(way.path_ratio, path_m / x_m, 0.03) << "the last swings are too slow to be told";
  EXPECT_NEAR(way.commanded_n, taken_j / x_m, 0.01 * taken_j / x_m);
}

}  // namespace force_fit_test
}  // namespace jnd::analysis
