#include "device/stability.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "device/drawn_mass.h"

namespace jnd::device {
namespace stability_test {

constexpr double kRate_hz = 1000.0;
constexpr double kPeriod_s = 1.0 / kRate_hz;

/// One mass, to which all five tips are fixed at the same height, with a damper of its own:
///
/// m (v' - v) / T = force - b v + press,   x' = x + T v',
///
/// where the force is that of `delay_ticks` ticks before. The mass starts with a speed.
class SampledMass final : public HapticDevice {
 public:
  double mass_kg = 3e-4;  ///< The mass is so light that the limiter's slew has no effect.
  double damping_n_s_per_m = 0.0;
  int delay_ticks = 0;
  double start_m_per_s = 0.05;
  double press_n = 0.0;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  std::int64_t broken_from_tick = 1'000'000;

  [[nodiscard]] std::string_view name() const noexcept override { return "sampled_mass"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return {.simulated = true};
  }
  void open() override {
    position_m_ = 0.0;
    velocity_m_per_s_ = start_m_per_s;
    tick_ = 0;
    line_.fill(0.0);
  }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    if (tick_ >= broken_from_tick) return false;
    state.device_time_ns = tick_ * 1'000'000;
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      const Eigen::Vector3d& tip = lumped_hand_tips_m()[i];
      state.tip_position_m[i] = Eigen::Vector3d(tip.x(), tip.y(), 0.0) + position_m_ * axis;
      state.tip_velocity_m_per_s[i] = velocity_m_per_s_ * axis;
    }
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    const auto slot = static_cast<std::size_t>(tick_ % 16);
    line_[slot] = total_of(force_on_hand_n).dot(axis);
    const double force_n = line_[static_cast<std::size_t>((tick_ + 16 - delay_ticks) % 16)];
    velocity_m_per_s_ +=
        kPeriod_s / mass_kg * (force_n + press_n - damping_n_s_per_m * velocity_m_per_s_);
    position_m_ += kPeriod_s * velocity_m_per_s_;
    ++tick_;
    return true;
  }
  void close() noexcept override {}
  void halt() noexcept override {}

 private:
  double position_m_ = 0.0, velocity_m_per_s_ = 0.0;
  std::int64_t tick_ = 0;
  std::array<double, 16> line_{};
};

/// A command of damping for a hand that is below the surface everywhere.
core::HapticCommand deep_in(double damping_n_s_per_m) {
  core::HapticCommand command{.medium = {.damping_n_s_per_m = damping_n_s_per_m}};
  command.immersion.origin_z_m = 1.0;
  return command;
}

/// A mass whose force comes one tick late.
SampledMass pressed_on_a_plane() {
  SampledMass mass;
  mass.mass_kg = 0.02;
  mass.damping_n_s_per_m = 2.0;
  mass.delay_ticks = 1;
  mass.axis = Eigen::Vector3d::UnitZ();
  mass.start_m_per_s = -0.02;
  mass.press_n = -2.0;
  return mass;
}

double largest_damping_n_s_per_m(SampledMass& mass) {
  return largest_stable({.first = 0.02, .last = 1000.0, .resolution_ratio = 1.005},
                        [&](double damping_n_s_per_m) {
                          return settles(mass, deep_in(damping_n_s_per_m), kRate_hz);
                        })
      .value;
}

TEST(Stability, AMassWithSampledDampingIsStableUpToTwiceItsMassOverThePeriod) {
  // v' = (1 - b T / m) v is stable for b < 2 m / T.
  for (const double mass_kg : {3e-4, 5e-4}) {
    SampledMass mass;
    mass.mass_kg = mass_kg;
    const double limit = 2.0 * mass_kg / kPeriod_s;
    const double found = largest_damping_n_s_per_m(mass);
    EXPECT_LT(found, limit * 1.01) << mass_kg;
    EXPECT_GT(found, limit * 0.97) << mass_kg;
  }
}

TEST(Stability, ADelayOfTheForceLowersTheLimitAsLevinAndMayHaveIt) {
  // v' = v - b T / m v_d, with the velocity v_d of d ticks before, is stable for b < 2 sin(pi /
  // (4 d + 2)) m / T (Levin and May, Theoretical Population Biology 9, 1976).
  for (const int delay_ticks : {1, 2, 4}) {
    SampledMass mass;
    mass.delay_ticks = delay_ticks;
    const double limit =
        2.0 * std::sin(std::numbers::pi / (4.0 * delay_ticks + 2.0)) * mass.mass_kg / kPeriod_s;
    const double found = largest_damping_n_s_per_m(mass);
    EXPECT_LT(found, limit * 1.01) << delay_ticks;
    EXPECT_GT(found, limit * 0.95) << delay_ticks;
  }
}

TEST(Stability, AMassPressedOnADelayedPlaneNeedsDampingOfStiffnessTimesDelay) {
  // With the force one tick late, z^2 - (2 - b T / m) z + 1 - b T / m + k T^2 / m = 0, which is
  // stable for k < b / T.
  SampledMass mass = pressed_on_a_plane();
  const double limit = mass.damping_n_s_per_m / kPeriod_s;
  const double found =
      largest_stable({.first = 10.0, .last = 1e5}, [&](double stiffness_n_per_m) {
        return settles(mass, {.medium = core::solid({.stiffness_n_per_m = stiffness_n_per_m})},
                       kRate_hz);
      }).value;
  // The limit of the whole loop is lower: its passivity control does not know of the delay and
  // takes force away in the wrong ticks, which costs a quarter.
  EXPECT_LT(found, limit * 1.01);
  EXPECT_GT(found, limit * 0.7);
}

TEST(Stability, AForceThatGoesToAndFroIsNoRestHoweverLittleMoves) {
  SampledMass mass = pressed_on_a_plane();
  const core::HapticCommand too_stiff = {
      .medium = core::solid({.stiffness_n_per_m = 2.0 * mass.damping_n_s_per_m / kPeriod_s})};
  const SettlingCriterion by_force_alone = {
      .rest_speed_m_per_s = 1e9, .rest_ratio = 1e9, .limited_ratio = 1.0};
  EXPECT_FALSE(settles(mass, too_stiff, kRate_hz, by_force_alone));
  SettlingCriterion by_nothing = by_force_alone;
  by_nothing.force_swing_n = 1e9;
  EXPECT_TRUE(settles(mass, too_stiff, kRate_hz, by_nothing));
}

TEST(Stability, ALimiterThatHasToWorkOnAndOnIsNoRest) {
  SampledMass mass = pressed_on_a_plane();
  const core::HapticCommand far_too_stiff = {
      .medium = core::solid({.stiffness_n_per_m = 100.0 * mass.damping_n_s_per_m / kPeriod_s})};
  const SettlingCriterion by_the_limiter_alone = {
      .rest_speed_m_per_s = 1e9, .rest_ratio = 1e9, .force_swing_n = 1e9};
  EXPECT_FALSE(settles(mass, far_too_stiff, kRate_hz, by_the_limiter_alone));
  SettlingCriterion by_nothing = by_the_limiter_alone;
  by_nothing.limited_ratio = 1.0;
  EXPECT_TRUE(settles(mass, far_too_stiff, kRate_hz, by_nothing));
}

TEST(Stability, WhatKeepsMovingIsNotStable) {
  SampledMass mass;
  EXPECT_FALSE(settles(mass, deep_in(0.0), kRate_hz)) << "nothing slows it down";
}

TEST(Stability, AFaultIsNotStable) {
  SampledMass mass;
  mass.broken_from_tick = 500;
  EXPECT_FALSE(settles(mass, deep_in(0.1), kRate_hz));
}

TEST(StabilityLadder, ClimbsToTheFirstUnstableValueAndNoIslandBeyondCounts) {
  std::vector<double> asked;
  const StabilityLimit limit = largest_stable({.first = 1.0, .last = 64.0}, [&](double value) {
    asked.push_back(value);
    return value < 10.0 || value > 30.0;
  });
  EXPECT_LE(limit.value, 10.0);
  EXPECT_GT(limit.value, 10.0 / 1.03);
  EXPECT_FALSE(limit.is_beyond_ladder);
  for (const double value : asked) EXPECT_LE(value, 16.0);
}

TEST(StabilityLadder, SaysWhereItFoundNoLimitAndWhereNothingIsStable) {
  const StabilityLimit beyond =
      largest_stable({.first = 3.0, .last = 10.0}, [](double) { return true; });
  EXPECT_EQ(beyond.value, 10.0);
  EXPECT_TRUE(beyond.is_beyond_ladder);
  const StabilityLimit none =
      largest_stable({.first = 3.0, .last = 10.0}, [](double) { return false; });
  EXPECT_EQ(none.value, 0.0);
  EXPECT_FALSE(none.is_beyond_ladder);
}

TEST(StabilityLadder, OneThatLeadsNowhereIsRefused) {
  const auto yes = [](double) { return true; };
  EXPECT_THROW((void)largest_stable({.first = 0.0, .last = 10.0}, yes), core::Error);
  EXPECT_THROW((void)largest_stable({.first = 3.0, .last = 2.0}, yes), core::Error);
  EXPECT_THROW((void)largest_stable({.first = 3.0, .last = 9.0, .step_ratio = 1.0}, yes),
               core::Error);
  EXPECT_THROW((void)largest_stable({.first = 3.0, .last = 9.0, .resolution_ratio = 1.0}, yes),
               core::Error);
}

}  // namespace stability_test
}  // namespace jnd::device
