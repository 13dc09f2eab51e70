#include "analysis/commissioning/damping_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace damping_limit_test {

constexpr double kPeriod_s = 0.001;
constexpr int kSweepTicks = 128;

/// Several masses side by side, each with its own input. Their velocity is read a whole number
/// of ticks after the force that changed it.
struct Masses {
  std::vector<double> mass_kg;
  int delay_ticks = 0;
};

/// Returns the limit, worked out by hand. From v(k + 1) = v(k) + T / m u(k - d) follows G(z) =
/// T / m z^-d / (z - 1). Its phase is -180 degrees where w d + w / 2 = 90 degrees, and |z - 1|
/// = 2 sin(w / 2), so
///   limit = 2 m / T sin(w / 2) / share,   w = pi / (2 d + 1).
double limit_by_hand(double mass_kg, double share_ratio, int delay_ticks) {
  const double angle = std::numbers::pi / (2.0 * delay_ticks + 1.0);
  return 2.0 * mass_kg / kPeriod_s * std::sin(0.5 * angle) / share_ratio;
}

SweptWay way_of(const Masses& masses, int input, double sd_m_per_s,
                core::RandomStream& random) {
  constexpr int kSweeps = 6;
  const auto num_inputs = static_cast<Eigen::Index>(masses.mass_kg.size());
  SweptWay way{.input = input,
               .commanded_n = Eigen::MatrixXd::Zero(num_inputs, kSweepTicks),
               .velocity_m_per_s = Eigen::MatrixXd::Zero(num_inputs, kSweepTicks)};
  const int begin = static_cast<int>(random.uniform(0.0, kSweepTicks));
  const auto force_n = [&](int tick) {
    const double k = (tick + begin + 16 * kSweepTicks) % kSweepTicks;
    return 3.0 * std::cos(0.5 * std::numbers::pi * k * k / kSweepTicks);
  };
  double velocity_m_per_s = 0.0, mean_n = 0.0;
  for (int tick = 0; tick < kSweepTicks; ++tick) mean_n += force_n(tick) / kSweepTicks;
  for (int tick = -kSweepTicks; tick < kSweeps * kSweepTicks; ++tick) {
    if (tick >= 0) {
      const Eigen::Index place = tick % kSweepTicks;
      way.commanded_n(input, place) += force_n(tick) / kSweeps;
      way.velocity_m_per_s(input, place) += velocity_m_per_s / kSweeps;
      for (Eigen::Index row = 0; row < num_inputs; ++row) {
        way.velocity_m_per_s(row, place) += random.normal(0.0, sd_m_per_s) / kSweeps;
      }
    }
    velocity_m_per_s += kPeriod_s / masses.mass_kg[static_cast<std::size_t>(input)] *
                        (force_n(tick - masses.delay_ticks) - mean_n);
  }
  return way;
}

std::vector<SweptWay> ways_of(const Masses& masses, double sd_m_per_s,
                              core::RandomStream& random) {
  constexpr int kWays = 8;
  std::vector<SweptWay> ways;
  for (int way = 0; way < kWays; ++way) {
    for (std::size_t input = 0; input < masses.mass_kg.size(); ++input) {
      ways.push_back(way_of(masses, static_cast<int>(input), sd_m_per_s, random));
    }
  }
  return ways;
}

TEST(DampingLimit, IsTheOneWorkedOutByHand) {
  core::RandomStream random(1, "sweeps");
  for (const int delay_ticks : {0, 1, 2, 4}) {
    const Masses masses{.mass_kg = {0.7}, .delay_ticks = delay_ticks};
    const DampingLimit limit =
        damping_limit(ways_of(masses, 0.0, random), Eigen::VectorXd::Ones(1), kPeriod_s,
                      delay_ticks * kPeriod_s, 1e6);
    const double expected = limit_by_hand(0.7, 1.0, delay_ticks);
    EXPECT_NEAR(limit.damping_n_s_per_m.value, expected, 0.01 * expected) << delay_ticks;
    EXPECT_NEAR(limit.frequency_hz, 500.0 / (2.0 * delay_ticks + 1.0), 4.0) << delay_ticks;
  }
}

TEST(DampingLimit, TheLightestForItsShareDecides) {
  core::RandomStream random(2, "sweeps");
  const Masses masses{.mass_kg = {0.7, 0.2, 0.5}, .delay_ticks = 2};
  const Eigen::Vector3d shares(0.6, 0.1, 0.3);
  const DampingLimit limit =
      damping_limit(ways_of(masses, 0.0, random), shares, kPeriod_s, 0.002, 1e6);
  const double expected = limit_by_hand(0.7, 0.6, 2);
  EXPECT_LT(expected, limit_by_hand(0.2, 0.1, 2));
  EXPECT_NEAR(limit.damping_n_s_per_m.value, expected, 0.01 * expected);
}

TEST(DampingLimit, IntervalsHoldTheTruthAndLowerEndsLieBelowIt) {
  constexpr int kStudies = 200;
  core::RandomStream random(3, "sweeps");
  const Masses masses{.mass_kg = {0.8}, .delay_ticks = 2};
  const double truth = limit_by_hand(0.8, 1.0, 2);
  int held = 0, above = 0;
  for (int study = 0; study < kStudies; ++study) {
    const DampingLimit limit = damping_limit(ways_of(masses, 0.003, random),
                                             Eigen::VectorXd::Ones(1), kPeriod_s, 0.002, 1e6);
    held += limit.damping_n_s_per_m.holds(truth) ? 1 : 0;
    above += limit.damping_n_s_per_m.ci95_low > truth ? 1 : 0;
  }
  // The jackknife uses only eight ways, so the interval holds the true value slightly less
  // often than it claims.
  EXPECT_GE(held, static_cast<int>(0.91 * kStudies));
  EXPECT_LE(above, static_cast<int>(0.05 * kStudies));
}

TEST(DampingLimit, WhatNobodyAsksForIsToldAsAtLeast) {
  core::RandomStream random(4, "sweeps");
  const Masses masses{.mass_kg = {0.7}, .delay_ticks = 0};
  const DampingLimit limit = damping_limit(ways_of(masses, 0.0, random),
                                           Eigen::VectorXd::Ones(1), kPeriod_s, 0.0, 900.0);
  EXPECT_TRUE(limit.is_beyond);
  EXPECT_DOUBLE_EQ(limit.damping_n_s_per_m.ci95_low, 900.0);
}

TEST(DampingLimit, TooFewWaysAreRefused) {
  core::RandomStream random(5, "sweeps");
  std::vector<SweptWay> ways = ways_of({.mass_kg = {0.7}}, 0.0, random);
  ways.resize(3);
  EXPECT_THROW((void)damping_limit(ways, Eigen::VectorXd::Ones(1), kPeriod_s, 0.0, 1e6),
               core::Error);
}

}  // namespace damping_limit_test
}  // namespace jnd::analysis
