// Tests of sensors that die while the hand rests, and of the switch in the hand of whoever owns
// the robot.
#include <gtest/gtest.h>

#include "haptic_loop_fixture.h"

namespace jnd::device {
namespace haptic_loop_stillness_test {

using core::Fault;

class HapticLoopStillness : public HapticLoopTest {
 protected:
  /// Presses the outer palm half a centimetre into a plane, and lets the hand rest there.
  void press_into_plane() {
    commands.publish({.sequence = 1,
                      .medium = core::solid({.stiffness_n_per_m = 2000.0}),
                      .immersion = {.origin_z_m = -0.2},
                      .ramp_s = 0.0});
    device.move_all({0.0, 0.0, -0.5});
    run(90);
    device.move_all(Eigen::Vector3d::Zero());
    run(10);
    ASSERT_GT(pressed_n(), 1.5);
  }
  [[nodiscard]] double pressed_n() const { return device.last_total_n().norm(); }
};

TEST_F(HapticLoopStillness, APositionThatFreezesInAPlaneLosesItsForceAndIsAFault) {
  press_into_plane();
  const double first_n = pressed_n();
  run(1900);
  EXPECT_EQ(pressed_n(), first_n);
  EXPECT_EQ(telemetry().warning, Fault::kNone);
  run(1100);
  EXPECT_LT(pressed_n(), 0.6 * first_n) << "first less force";
  EXPECT_EQ(telemetry().warning, Fault::kPositionFrozen);
  EXPECT_TRUE(telemetry().limited) << "the trial is marked";
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  run(2200);
  EXPECT_EQ(telemetry().fault, Fault::kPositionFrozen) << "then the fault";
  EXPECT_EQ(pressed_n(), 0.0);
}

TEST_F(HapticLoopStillness, AHandThatGivesWayKeepsItsForce) {
  press_into_plane();
  const double first_n = pressed_n();
  double before_n = first_n;
  for (int i = 0; i < 20'000; ++i) {
    // Friction holds the hand until the force has changed by half a newton; then the hand slips
    // a little.
    if (before_n - pressed_n() > 0.5) {
      for (Eigen::Vector3d& tip : device.state.tip_position_m) tip.z() -= 1e-4;
      before_n = pressed_n();
    } else if (pressed_n() > before_n) {
      before_n = pressed_n();
    }
    run(1);
    ASSERT_EQ(telemetry().fault, Fault::kNone) << i;
    ASSERT_GT(pressed_n(), 0.5) << i;
  }
}

TEST_F(HapticLoopStillness, ASimulationComesToRestExactly) {
  device.device_capabilities.simulated = true;
  make_loop({});
  press_into_plane();
  const double first_n = pressed_n();
  run(20'000);
  EXPECT_EQ(pressed_n(), first_n);
}

TEST_F(HapticLoopStillness, ASlowMotionWithoutAWayIsAFault) {
  command(core::viscous({.viscosity_pa_s = 8.0}));
  run(10);
  device.before_write = [this] {
    for (Eigen::Vector3d& tip : device.state.tip_position_m) tip.x() -= 0.001 * 0.02;
  };
  device.move_all({0.02, 0.0, 0.0});
  run(640);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  run(80);
  EXPECT_EQ(telemetry().fault, Fault::kPositionFrozen);
}

TEST_F(HapticLoopStillness, AnOpenSwitchEndsTheForceInItsOwnTick) {
  command(core::viscous({.viscosity_pa_s = 8.0}));
  device.move_all({0.2, 0.0, 0.0});
  run(50);
  ASSERT_GT(pressed_n(), 0.5);
  device.state.enabled = false;
  run(1);
  EXPECT_EQ(pressed_n(), 0.0);
  EXPECT_EQ(telemetry().fault, Fault::kNotEnabled);
  arm();
  run(50);
  EXPECT_EQ(telemetry().fault, Fault::kNotEnabled) << "not while it is open";
  device.state.enabled = true;
  run(50);
  EXPECT_EQ(pressed_n(), 0.0) << "closing it brings no force";
  arm();
  run(600);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_GT(pressed_n(), 0.5);
}

TEST_F(HapticLoopStillness, AnOpenSwitchIsNoFaultBeforeSomebodyAsksForForce) {
  starts_armed = false;
  make_loop({});
  device.state.enabled = false;
  run(10);
  EXPECT_EQ(telemetry().fault, Fault::kNotArmed);
  EXPECT_EQ(telemetry().num_faults, 0u);
}

}  // namespace haptic_loop_stillness_test
}  // namespace jnd::device
