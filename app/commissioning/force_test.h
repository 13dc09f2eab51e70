#pragma once

#include <Eigen/Core>

#include "app/commissioning/measuring_steps.h"

namespace jnd::app {

/// A small force, for somebody to see whether the device moves in the right direction.
struct ForceTest {
  /// A unit vector in the workspace.
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  double force_n = 0.5;  ///< The force to and fro, in (0, 2].
  /// The rotation from the device's own frame to the workspace, by its profile.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

struct ForceTestResult {
  /// Half of the way, along the force, from the device's place under the backward force to its
  /// place under the forward force. A negative value means the opposite direction.
  double moved_m = 0.0;
};

/// Holds a device without a hand by a soft spring and pushes it to and fro three times, through
/// the loop and its limiter. Throws `core::Error` if the parameters of the test are wrong, and
/// whatever the steps of a measurement throw. Not real time.
[[nodiscard]] ForceTestResult test_force(device::HapticDevice& device, device::Bench& bench,
                                         const MeasuringPlan& plan, const ForceTest& test,
                                         const StepProgress& progress);

}  // namespace jnd::app
