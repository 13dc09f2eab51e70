#include "device/motion_guide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace jnd::device {
namespace motion_guide_test {

constexpr double kPeriod_s = 0.001;

core::HapticState at_rest() {
  core::HapticState state;
  state.attached = core::kAllAttached;
  return state;
}

TEST(Sweep, HasEveryFrequencyMuchAlikeAndNoStep) {
  for (const int num_ticks : {64, 128, 512}) {
    double mean_amplitude = 0.0, least = 1e9, most = 0.0;
    for (int line = 1; line < num_ticks / 2; ++line) {
      std::complex<double> sum = 0.0;
      for (int tick = 0; tick < num_ticks; ++tick) {
        sum += sweep_at(tick, num_ticks) *
               std::polar(2.0 / num_ticks, -2.0 * std::numbers::pi * line * tick / num_ticks);
      }
      mean_amplitude += std::abs(sum) / (num_ticks / 2 - 1);
      least = std::min(least, std::abs(sum));
      most = std::max(most, std::abs(sum));
    }
    EXPECT_GT(least, 0.6 * mean_amplitude) << num_ticks;
    EXPECT_LT(most, 1.5 * mean_amplitude) << num_ticks;
    // One sweep continues into the next at its end.
    const double end = 0.5 * std::numbers::pi * num_ticks;
    EXPECT_NEAR(sweep_at(num_ticks, num_ticks), std::cos(end), 1e-9);
  }
}

TEST(MotionGuide, SweepsAtOnePointAlongOneAxis) {
  MotionGuide guide(core::kAreaShareRatio);
  guide.order(
      {.sweep_n = 3.0, .sweep_ticks = 128, .sweep_point = 2, .sweep_axis = 1, .is_on = true});
  const core::HapticState state = at_rest();
  for (int tick = 0; tick < 300; ++tick) {
    const core::PointVectors force_n = guide.force_n(state, kPeriod_s);
    for (std::size_t point = 0; point < force_n.size(); ++point) {
      const Eigen::Vector3d expected_n =
          point == 2 ? Eigen::Vector3d(0.0, 3.0 * sweep_at(tick, 128), 0.0)
                     : Eigen::Vector3d(Eigen::Vector3d::Zero());
      ASSERT_EQ(force_n[point], expected_n) << tick << " " << point;
    }
  }
}

TEST(MotionGuide, ASweepWhereThereIsNoPointIsNone) {
  core::ShareRatios shares{};
  shares[0] = 1.0;
  MotionGuide guide(shares);
  const core::HapticState state = at_rest();
  for (const int point : {-1, 1, 5, 99}) {
    guide.order({.sweep_n = 3.0, .sweep_point = point, .is_on = true});
    for (const Eigen::Vector3d& force_n : guide.force_n(state, kPeriod_s)) {
      EXPECT_EQ(force_n, Eigen::Vector3d(Eigen::Vector3d::Zero())) << point;
    }
  }
}

TEST(MotionGuide, ASweepOfNoTicksIsNone) {
  MotionGuide guide(core::kAreaShareRatio);
  for (const int num_ticks : {0, -4}) {
    guide.order({.sweep_n = 3.0, .sweep_ticks = num_ticks, .is_on = true});
    for (const Eigen::Vector3d& force_n : guide.force_n(at_rest(), kPeriod_s)) {
      EXPECT_EQ(force_n, Eigen::Vector3d(Eigen::Vector3d::Zero())) << num_ticks;
    }
  }
}

TEST(MotionGuide, ASmoothWayBeginsAndEndsAtRestAndIsHalfDoneAtHalfTime) {
  MotionGuide guide(core::kAreaShareRatio);
  const core::HapticState state = at_rest();
  // A spring alone shows where the reference is, and a damper alone how fast it moves: 0.1 m in
  // 0.5 s.
  for (const bool is_spring : {true, false}) {
    guide.order({.is_on = true});
    (void)guide.force_n(state, kPeriod_s);
    guide.order({.to_m = {0.1, 0.0, 0.0},
                 .speed_m_per_s = 0.2,
                 .is_smooth = true,
                 .stiffness_n_per_m = is_spring ? 100.0 : 1e-9,
                 .damping_n_s_per_m = is_spring ? 0.0 : 10.0,
                 .is_on = true});
    std::vector<double> force_n;
    for (int tick = 0; tick < 600; ++tick) {
      double whole_n = 0.0;
      for (const Eigen::Vector3d& at_point : guide.force_n(state, kPeriod_s)) {
        whole_n += at_point.x();
      }
      force_n.push_back(whole_n);
    }
    if (is_spring) {
      EXPECT_LT(force_n[0], 1e-6);
      EXPECT_NEAR(force_n[249], 100.0 * 0.05, 1e-9);
      EXPECT_NEAR(force_n[599], 100.0 * 0.1, 1e-9);
    } else {
      EXPECT_NEAR(force_n[249], 10.0 * 1.875 * 0.2, 1e-6) << "1.875 of the mean";
      EXPECT_NEAR(force_n[499], 0.0, 1e-6);
      EXPECT_NEAR(force_n[599], 0.0, 1e-6);
    }
  }
}

TEST(MotionGuide, WhatPushesWithoutASpringForgetsWhereItWas) {
  MotionGuide guide(core::kAreaShareRatio);
  core::HapticState state = at_rest();
  guide.order({.stiffness_n_per_m = 100.0, .is_on = true});
  (void)guide.force_n(state, kPeriod_s);
  // A force pushes the hand for a while and carries it away.
  guide.order({.pulse_n = {1.0, 0.0, 0.0}, .pulse_period_s = 1e6, .is_on = true});
  (void)guide.force_n(state, kPeriod_s);
  for (Eigen::Vector3d& place_m : state.tip_position_m) place_m.x() += 0.3;
  (void)guide.force_n(state, kPeriod_s);
  // The guide now holds the hand where it is, so nothing pulls it back at once.
  guide.order({.speed_m_per_s = 0.1, .stiffness_n_per_m = 100.0, .is_on = true});
  for (const Eigen::Vector3d& force_n : guide.force_n(state, kPeriod_s)) {
    EXPECT_LT(force_n.norm(), 0.01);
  }
}

}  // namespace motion_guide_test
}  // namespace jnd::device
