#include "analysis/commissioning/single_mass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

namespace jnd::analysis {
namespace single_mass_test {

/// Simulates oscillations of a mass on a spring that a loop renders, in steps of a microsecond.
/// Returns their final size over their initial size.
double growth_by_steps(const SingleMass& device, double stiffness_n_per_m) {
  constexpr double kStep_s = 1e-6;
  constexpr double kDuration_s = 8.0;
  const auto steps_a_tick = static_cast<std::int64_t>(std::lround(device.period_s / kStep_s));
  const auto steps_late = static_cast<std::int64_t>(std::lround(device.delay_s / kStep_s));
  double position_m = 0.001, velocity_m_per_s = 0.0, first_m = 0.0, last_m = 0.0;
  std::deque<std::pair<std::int64_t, double>> written;
  double acting_n = 0.0;
  const auto num_steps = static_cast<std::int64_t>(kDuration_s / kStep_s);
  for (std::int64_t step = 0; step < num_steps; ++step) {
    if (step % steps_a_tick == 0) {
      written.emplace_back(step + steps_late, -stiffness_n_per_m * position_m);
    }
    while (!written.empty() && written.front().first <= step) {
      acting_n = written.front().second;
      written.pop_front();
    }
    velocity_m_per_s +=
        kStep_s / device.mass_kg * (acting_n - device.damping_n_s_per_m * velocity_m_per_s);
    position_m += kStep_s * velocity_m_per_s;
    if (step < num_steps / 4) first_m = std::max(first_m, std::abs(position_m));
    if (step >= 3 * num_steps / 4) last_m = std::max(last_m, std::abs(position_m));
  }
  return last_m / first_m;
}

TEST(SingleMass, SwingsGrowAboveItsLimitAndDecayBelow) {
  for (const SingleMass& device :
       {SingleMass{.mass_kg = 0.5, .damping_n_s_per_m = 2.0, .delay_s = 0.0},
        SingleMass{.mass_kg = 0.4, .damping_n_s_per_m = 3.0, .delay_s = 0.0023},
        SingleMass{
            .mass_kg = 0.3, .damping_n_s_per_m = 1.0, .delay_s = 0.004, .period_s = 0.0005}}) {
    const double limit_n_per_m = stiffness_limit_n_per_m(device);
    EXPECT_GT(growth_by_steps(device, 1.1 * limit_n_per_m), 1.0) << limit_n_per_m;
    EXPECT_LT(growth_by_steps(device, 0.9 * limit_n_per_m), 1.0) << limit_n_per_m;
    // The rule of thumb is from Gil et al. (2004).
    const double thumb_n_per_m =
        device.damping_n_s_per_m / (device.delay_s + 0.5 * device.period_s);
    EXPECT_NEAR(limit_n_per_m, thumb_n_per_m, 0.1 * thumb_n_per_m);
  }
}

TEST(SingleMass, WithoutDampingNoSpringIsStable) {
  EXPECT_DOUBLE_EQ(stiffness_limit_n_per_m({.mass_kg = 0.5}), 0.0);
}

TEST(SingleMass, WhatIsOpenOfADeviceIsOpenOfItsLimit) {
  const DelayFit delay{.delay_s = {0.001, 0.0009, 0.0011},
                       .mass_per_gain_kg = {0.5, 0.49, 0.51}};
  ForceFit force;
  force.gain = {0.8, 0.79, 0.81};
  force.damping_n_s_per_m = {1.6, 1.5, 1.7};
  const Measured limit = stiffness_limit(delay, force, 0.001);
  const double lowest = stiffness_limit_n_per_m(
                   {.mass_kg = 0.49, .damping_n_s_per_m = 1.5 / 0.8, .delay_s = 0.0011}),
               exact = stiffness_limit_n_per_m(
                   {.mass_kg = 0.5, .damping_n_s_per_m = 2.0, .delay_s = 0.001});
  EXPECT_DOUBLE_EQ(limit.value, exact);
  EXPECT_LE(limit.ci95_low, lowest);
  EXPECT_GT(limit.ci95_low, 0.8 * exact);
  EXPECT_GT(limit.ci95_high, exact);
}

}  // namespace single_mass_test
}  // namespace jnd::analysis
