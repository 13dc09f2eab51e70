#pragma once

#include <Eigen/Core>

#include "app/commissioning/measuring_steps.h"

namespace jnd::app {

/// A small force for somebody to look at: does the device move where it is told to?
struct ForceTest {
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  ///< In the workspace, of length 1.
  double force_n = 0.5;                              ///< To and fro, (0, 2].
  /// From the device's own frame to the workspace, by its profile.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

struct ForceTestResult {
  /// Along it, half of the way from where it was fro to where it was to; negative: the other
  /// way.
  double moved_m = 0.0;
};

/// A device that nobody's hand is in is held by a soft spring and pushed to and fro, three
/// times, through the loop and its limiter. Throws `core::Error` where the test is no such test
/// and as the steps do. Not real time.
[[nodiscard]] ForceTestResult test_force(device::HapticDevice& device, device::Bench& bench,
                                         const MeasuringPlan& plan, const ForceTest& test,
                                         const StepProgress& progress);

}  // namespace jnd::app
