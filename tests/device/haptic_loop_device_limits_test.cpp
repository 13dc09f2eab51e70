// Tests that the loop keeps within the limits of a device that can do less than the loop.
#include "haptic_loop_fixture.h"

namespace jnd::device {
namespace haptic_loop_device_limits_test {

using core::Fault;

class HapticLoopDeviceLimits : public HapticLoopTest {};

TEST_F(HapticLoopDeviceLimits, TheForceChangesNoFasterThanTheDeviceFollows) {
  device.device_capabilities.max_slew_n_per_s = 100.0;
  make_loop({});
  device.move_all({0.3, 0.0, 0.0});
  command(core::viscous({.viscosity_pa_s = 20.0}));
  run(50);
  core::PointVectors last_n = core::zero_vectors();
  double most_n = 0.0;
  for (const core::PointVectors& sent_n : device.received) {
    for (std::size_t i = 0; i < sent_n.size(); ++i) {
      EXPECT_LE((sent_n[i] - last_n[i]).norm(), 0.1 + 1e-9);
      most_n = std::max(most_n, sent_n[i].norm());
    }
    last_n = sent_n;
  }
  EXPECT_GT(most_n, 1.0);
}

TEST_F(HapticLoopDeviceLimits, AHandFasterThanTheDeviceIsSoundAtIsAFault) {
  device.device_capabilities.max_speed_m_per_s = 0.2;
  make_loop({});
  command(core::viscous({.viscosity_pa_s = 1.0}));
  device.move_all({0.1, 0.0, 0.0});
  run(20);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  device.move_all({0.3, 0.0, 0.0});
  run(2);
  EXPECT_EQ(telemetry().fault, Fault::kOverVelocity);
}

TEST_F(HapticLoopDeviceLimits, TheSpaceIsThatOfTheDeviceWithinThatOfTheLoop) {
  device.device_capabilities.workspace.half_width_y_m = 0.070;
  make_loop({});
  command(core::free_space());
  device.move_all({0.0, 0.1, 0.0});
  run(20);
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  run(80);
  EXPECT_EQ(telemetry().fault, Fault::kOutsideWorkspace);
}

}  // namespace haptic_loop_device_limits_test
}  // namespace jnd::device
