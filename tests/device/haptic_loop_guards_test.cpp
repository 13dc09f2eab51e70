// Tests what the guards do to the force before and after they are certain, and what they only
// count.
#include <gtest/gtest.h>

#include "haptic_loop_fixture.h"

namespace jnd::device {
namespace haptic_loop_guards_test {

using core::Fault;

constexpr double kEdge_m = 0.5;

class HapticLoopGuards : public HapticLoopTest {
 protected:
  HapticLoopGuards() { make_loop({}, bounded()); }

  static HapticLoop::Parameters bounded(bool shadows = false) {
    HapticLoop::Parameters parameters{.workspace = {.half_width_x_m = kEdge_m}};
    parameters.shadows_guards = shadows;
    return parameters;
  }
  /// Strokes in a fluid towards the edge, until the middle of the hand is 2.5 cm away from it.
  void stroke_towards_the_edge() {
    command(core::viscous({.viscosity_pa_s = 10.0}));
    device.move_all({0.5, 0.0, 0.0});
    run(950);
    ASSERT_GT(felt_n(), 1.0);
  }
  [[nodiscard]] double felt_n() const { return device.last_total_n().norm(); }
  [[nodiscard]] std::uint32_t warnings(Fault guard) {
    return telemetry().guards.num_warnings[core::guard_place(guard)];
  }
  [[nodiscard]] std::uint32_t shadowed(Fault guard) {
    return telemetry().guards.num_shadowed[core::guard_place(guard)];
  }
};

TEST_F(HapticLoopGuards, TheEdgeOfTheSpaceWarnsThenFades) {
  stroke_towards_the_edge();
  EXPECT_EQ(telemetry().warning, Fault::kNone);
  run(20);
  EXPECT_EQ(telemetry().warning, Fault::kOutsideWorkspace);
  EXPECT_EQ(warnings(Fault::kOutsideWorkspace), 1U) << "once, as long as it lasts";
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  const double before_n = felt_n();
  int num_ticks = 0;
  while (telemetry().fault == Fault::kNone && ++num_ticks < 200) run(1);
  ASSERT_EQ(telemetry().fault, Fault::kOutsideWorkspace);
  for (int tick = 1; tick < 30; ++tick) {
    run(1);
    EXPECT_NEAR(felt_n(), before_n * (1.0 - tick / 30.0), 0.02 * before_n) << tick << " ms";
  }
  run(2);  // One more tick is needed, because thirty times a thirtieth is not quite one.
  EXPECT_EQ(felt_n(), 0.0);
  run(1000);
  EXPECT_EQ(felt_n(), 0.0) << "it is latched";
  EXPECT_EQ(telemetry().num_faults, 1U);
}

TEST_F(HapticLoopGuards, WhatIsCertainEndsAFadeAtOnce) {
  stroke_towards_the_edge();
  while (telemetry().fault == Fault::kNone) run(1);
  run(5);
  ASSERT_GT(felt_n(), 0.0);
  stop.press();
  run(1);
  EXPECT_EQ(felt_n(), 0.0);
}

TEST_F(HapticLoopGuards, AFadeDoesNotHideWhatIsCertain) {
  // A sensor is stuck while the hand moves at 2 m/s. At first, more than one guard finds this
  // implausible. In the middle of the fade, the sensor has stood still for too long.
  device.device_capabilities.max_stale_s = 0.020;
  make_loop({});
  device.move_all({2.0, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 1.0}));
  run(100);
  const core::PointVectors stuck_m = device.state.tip_position_m;
  const auto run_stuck = [&](int num_ticks) {
    for (int tick = 0; tick < num_ticks; ++tick) {
      device.state.tip_position_m = stuck_m;
      run(1);
    }
  };
  run_stuck(20);
  ASSERT_TRUE(core::fades(telemetry().fault));
  ASSERT_GT(felt_n(), 0.5) << "it fades";
  run_stuck(3);
  EXPECT_EQ(felt_n(), 0.0);
}

TEST_F(HapticLoopGuards, ADisarmedDeviceDoesNotFade) {
  stroke_towards_the_edge();
  while (telemetry().fault == Fault::kNone) run(1);
  loop->disarm();
  run(1);
  EXPECT_EQ(felt_n(), 0.0);
}

TEST_F(HapticLoopGuards, InShadowTheyOnlyCount) {
  make_loop({}, bounded(/*shadows=*/true));
  stroke_towards_the_edge();
  run(300);  // The hand is far outside of the workspace.
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_GT(felt_n(), 1.0);
  EXPECT_EQ(shadowed(Fault::kOutsideWorkspace), 1U) << "once, as long as it lasts";
  device.move_all({-0.5, 0.0, 0.0});
  run(600);
  device.move_all({0.5, 0.0, 0.0});
  run(600);
  EXPECT_EQ(shadowed(Fault::kOutsideWorkspace), 2U);
}

TEST_F(HapticLoopGuards, InShadowTheyCountNothingBeforeThereMayBeForce) {
  starts_armed = false;
  make_loop({}, bounded(/*shadows=*/true));
  device.move_all({0.5, 0.0, 0.0});
  run(1500);
  EXPECT_EQ(shadowed(Fault::kOutsideWorkspace), 0U);
  EXPECT_EQ(warnings(Fault::kOutsideWorkspace), 0U);
}

}  // namespace haptic_loop_guards_test
}  // namespace jnd::device
