// A stimulus that goes on in steps, as a magnitude that a person produces, is one stimulus:
// what may be given back and what was counted carries on.

#include <gtest/gtest.h>

#include "haptic_loop_fixture.h"

namespace jnd::device {
namespace haptic_loop_steps_test {

using core::Fault;

class LoopOfSteps : public HapticLoopTest {
 protected:
  static HapticLoop::Parameters parameters() {
    HapticLoop::Parameters parameters;
    parameters.port_energy.max_credit_j = 0.05;
    parameters.velocity_check.max_error_m = 100.0;
    return parameters;
  }
  LoopOfSteps() {
    device.device_capabilities.simulated = true;
    device.device_capabilities.tells_acting_force = true;
    make_loop({}, parameters());
  }
  /// A step every 50 ms; each of the same stimulus, or each another.
  Fault after_steps(const core::MediumAmounts& medium, bool is_one_stimulus,
                    void (*move)(ScriptedDevice& device, int tick)) {
    for (int tick = 0; tick < 1000 && telemetry().fault == Fault::kNone; ++tick) {
      if (tick % 50 == 0) {
        core::HapticCommand step{.sequence = ++sequence,
                                 .medium = medium,
                                 .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                                 .ramp_s = 0.0};
        if (is_one_stimulus) step.stimulus = 1;
        commands.publish(step);
      }
      move(device, tick);
      run(1);
    }
    return telemetry().fault;
  }
};

/// Upwards, though the velocity says nothing of it: only the watch over the port sees that.
void float_up(ScriptedDevice& device, int) {
  device.move_all(Eigen::Vector3d::Zero());
  for (Eigen::Vector3d& tip_m : device.state.tip_position_m) tip_m.z() += 0.0001;
}

void shake(ScriptedDevice& device, int tick) {
  if (tick % 10 == 0) device.move_all({tick % 20 == 0 ? 0.3 : -0.3, 0.0, 0.0});
}

TEST_F(LoopOfSteps, GiveBackOnceWhatOneStimulusMay) {
  for (Eigen::Vector3d& tip_m : device.state.tip_position_m) tip_m.z() -= 0.5;
  EXPECT_EQ(after_steps(core::buoyant(8.0), true, float_up), Fault::kEnergyGiven);
}

TEST_F(LoopOfSteps, OfStimuliEachGivesItsOwn) {
  for (Eigen::Vector3d& tip_m : device.state.tip_position_m) tip_m.z() -= 0.5;
  EXPECT_EQ(after_steps(core::buoyant(8.0), false, float_up), Fault::kNone);
}

TEST_F(LoopOfSteps, DoNotMakeSwingsForgotten) {
  EXPECT_EQ(after_steps(core::viscous({.viscosity_pa_s = 10.0}), true, shake),
            Fault::kForceOscillates);
}

TEST_F(LoopOfSteps, BeginAnewOnceTheLoopIsArmedAgain) {
  for (Eigen::Vector3d& tip_m : device.state.tip_position_m) tip_m.z() -= 0.5;
  const auto step = [this](const core::MediumAmounts& medium) {
    commands.publish({.sequence = ++sequence,
                      .medium = medium,
                      .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                      .ramp_s = 0.0,
                      .stimulus = 1});
    run(5);
  };
  step(core::buoyant(8.0));
  step(core::free_space());
  stop.press();
  run(1);
  ASSERT_TRUE(stop.release(stop.num_presses()));
  run(600);
  arm();
  run(600);
  ASSERT_EQ(telemetry().fault, Fault::kNone);
  device.move_all({0.0, 0.0, 0.01});
  step(core::buoyant(8.0));
  run(20);
  EXPECT_GT(device.last_total_n().z(), 4.0) << "it lifts a hand that it was put around";
}

}  // namespace haptic_loop_steps_test
}  // namespace jnd::device
