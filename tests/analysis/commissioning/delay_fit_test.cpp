#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/single_mass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/commissioning/noise_fit.h"
#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace delay_fit_test {

constexpr double kPeriod_s = 0.001;

constexpr int kPushTicks = 30;

/// A device that moves at some 0.2 m/s and is pushed to and fro by 3 N.
struct Device {
  double delay_s = 0.002, mass_kg = 0.8, damping_n_s_per_m = 0.0, friction_n = 0.0;
  double cogging_n = 0.0, position_sd_m = 0.0;
};

/// Simulates the device in steps of a twentieth of a tick.
std::vector<PushedWindow> pushed(const Device& device, int num_ways,
                                 core::RandomStream& random) {
  constexpr int kSteps = 20, kGathering = 300, kWindows = 3, kWindowTicks = 10 * kPushTicks;
  std::vector<PushedWindow> windows;
  for (int way = 0; way < num_ways; ++way) {
    double x = random.uniform(0.0, 0.02), v = 0.2;
    std::vector<double> position_m, commanded_n;
    for (int tick = 0; tick < kGathering + kWindows * kWindowTicks; ++tick) {
      position_m.push_back(x + random.normal(0.0, device.position_sd_m));
      const double push_n = tick % kPushTicks < kPushTicks / 2 ? 3.0 : -3.0;
      commanded_n.push_back(push_n + 10.0 * (0.2 - v) + random.normal(0.0, 0.05));
      for (int step = 0; step < kSteps; ++step) {
        const double told_s = (tick + step / double{kSteps}) * kPeriod_s - device.delay_s;
        const auto then = static_cast<std::ptrdiff_t>(std::floor(told_s / kPeriod_s + 1e-9));
        const double told_n = then >= 0 ? commanded_n[static_cast<std::size_t>(then)] : 0.0;
        const double force_n = told_n - device.friction_n - device.damping_n_s_per_m * v +
                               device.cogging_n * std::sin(2.0 * M_PI * x / 0.02);
        const double next = v + kPeriod_s / kSteps * force_n / device.mass_kg;
        x += 0.5 * kPeriod_s / kSteps * (v + next);
        v = next;
      }
    }
    for (int window = 0; window < kWindows; ++window) {
      const auto first = kGathering + window * kWindowTicks;
      windows.push_back({.position_m = {position_m.begin() + first,
                                        position_m.begin() + first + kWindowTicks},
                         .commanded_n = {commanded_n.begin() + first,
                                         commanded_n.begin() + first + kWindowTicks},
                         .way = way});
    }
  }
  return windows;
}

TEST(DelayFit, FindsDelaysOfAnyPartOfATick) {
  core::RandomStream random(1, "delay");
  for (const double delay_s : {0.0, 0.0004, 0.001, 0.00275, 0.012}) {
    const auto windows = pushed({.delay_s = delay_s}, 5, random);
    const DelayFit fit = fit_delay(windows, kPeriod_s, kPushTicks, 0.0);
    EXPECT_NEAR(fit.delay_s.value, delay_s, 2e-6);
    EXPECT_NEAR(fit.mass_per_gain_kg.value, 0.8, 0.0008);
  }
}

TEST(DelayFit, DampingIsNoDelay) {
  core::RandomStream random(1, "delay");
  const Device device{.mass_kg = 0.3, .damping_n_s_per_m = 5.0};
  const auto windows = pushed(device, 5, random);
  const DelayFit known = fit_delay(windows, kPeriod_s, kPushTicks, 5.0);
  EXPECT_NEAR(known.delay_s.value, device.delay_s, 5e-6);
  EXPECT_NEAR(known.mass_per_gain_kg.value, 0.3, 0.0005);
  // The neglected damping changes the delay by damping / (w^2 mass) = 5 / (209.44^2 0.3) = 0.38
  // ms.
  const DelayFit unknown = fit_delay(windows, kPeriod_s, kPushTicks, 0.0);
  EXPECT_NEAR(unknown.delay_s.value, device.delay_s - 0.00038, 2e-5);
}

TEST(DelayFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kStudies = 100;
  core::RandomStream random(2, "delay");
  int delay = 0, mass = 0;
  for (int study = 0; study < kStudies; ++study) {
    // The true values are rounded to the steps of the simulation.
    const Device device{.delay_s = 5e-5 * std::round(random.uniform(10.0, 80.0)),
                        .mass_kg = random.uniform(0.3, 1.2),
                        .damping_n_s_per_m = 2.0,
                        .friction_n = 1.0,
                        .cogging_n = 0.1,
                        .position_sd_m = 2e-5};
    const DelayFit fit = fit_delay(pushed(device, 10, random), kPeriod_s, kPushTicks, 2.0);
    delay += fit.delay_s.holds(device.delay_s) ? 1 : 0;
    mass += fit.mass_per_gain_kg.holds(device.mass_kg) ? 1 : 0;
  }
  // This is the lower end of the binomial's 99.9 % range at 0.95.
  EXPECT_GE(delay, 87);
  EXPECT_GE(mass, 87);
}

TEST(DelayFit, SomethingThatDoesNotMoveHasNone) {
  core::RandomStream random(3, "delay");
  auto windows = pushed({}, 6, random);
  for (PushedWindow& window : windows) {
    for (double& place_m : window.position_m) place_m = random.normal(0.0, 1e-5);
  }
  EXPECT_THROW((void)fit_delay(windows, kPeriod_s, kPushTicks, 0.0), core::Error);
  EXPECT_THROW((void)fit_delay(pushed({}, 4, random), kPeriod_s, kPushTicks, 0.0), core::Error);
  windows = pushed({}, 6, random);
  windows.front().position_m.pop_back();
  EXPECT_THROW((void)fit_delay(windows, kPeriod_s, kPushTicks, 0.0), core::Error);
}

TEST(DelayFit, WhatSeemsToMoveBeforeItIsPushedIsNoSingleMass) {
  core::RandomStream random(6, "delay");
  auto windows = pushed({.delay_s = 0.0}, 6, random);
  // Positions come two ticks early, forces two ticks late.
  for (PushedWindow& window : windows) {
    std::rotate(window.commanded_n.begin(), window.commanded_n.end() - 2,
                window.commanded_n.end());
  }
  EXPECT_FALSE(is_single_mass(fit_delay(windows, kPeriod_s, kPushTicks, 0.0), {}));
  EXPECT_TRUE(is_single_mass(fit_delay(pushed({}, 6, random), kPeriod_s, kPushTicks, 0.0), {}));
  EXPECT_FALSE(is_single_mass(fit_delay(pushed({}, 6, random), kPeriod_s, kPushTicks, 0.0),
                              {.damps_alike = false}));
}

TEST(DelayFit, ADeviceWithoutNoiseMayBeNanosecondsOff) {
  const auto of = [](double delay_s) {
    return DelayFit{.delay_s = {delay_s, delay_s - 1e-9, delay_s + 1e-9}};
  };
  EXPECT_TRUE(is_single_mass(of(-14e-9), {}));
  EXPECT_FALSE(is_single_mass(of(-50e-6), {}));
}

TEST(NoiseFit, TellsDeviationAndSteps) {
  core::RandomStream random(4, "noise");
  std::vector<Eigen::Vector3d> position_m, velocity_m_per_s;
  const auto draw = [&](double sd, double step) {
    Eigen::Vector3d vector;
    for (int axis = 0; axis < 3; ++axis) {
      vector[axis] = step > 0.0 ? step * std::round(random.normal(0.3, sd) / step)
                                : random.normal(0.0, sd);
    }
    return vector;
  };
  for (int i = 0; i < 3000; ++i) {
    position_m.push_back(draw(2e-5, 8e-6));
    velocity_m_per_s.push_back(draw(0.002, 0.0));
  }
  const NoiseFit fit = fit_noise(position_m, velocity_m_per_s);
  EXPECT_NEAR(fit.position_resolution_m, 8e-6, 1e-12);
  // Rounding adds a twelfth of the squared resolution to the variance.
  EXPECT_NEAR(fit.position_sd_m.value, std::sqrt(4e-10 + 64e-12 / 12.0), 6e-7);
  EXPECT_TRUE(fit.velocity_sd_m_per_s.holds(0.002));
  EXPECT_LT(fit.velocity_sd_m_per_s.ci95_high, 0.0021);
  position_m.resize(50);
  EXPECT_THROW((void)fit_noise(position_m, velocity_m_per_s), core::Error);
}

}  // namespace delay_fit_test
}  // namespace jnd::analysis
