#pragma once

#include <Eigen/Core>

namespace jnd::device {

/// What somebody does at a device while it is measured. A simulated device that can be measured
/// has one (`HapticDevice::bench`), which acts in the device's next tick. At a real device a
/// person is asked for each of these. One thread may use it, which need not be the loop's.
class Bench {
 public:
  virtual ~Bench() = default;

  /// Takes every hand out of the device. Nothing else touches it.
  virtual void take_hand_out() = 0;
  /// Homes the device again as its maker says, with its tool resting where it rested before.
  /// The device must be closed.
  virtual void home() = 0;
  /// Keeps the tool from moving, whatever acts on it, until it is let go.
  virtual void clamp() = 0;
  /// Whoever holds the tool is ready for its force, which grows from zero where it is held.
  virtual void expect_force() {}
  /// The first contact point is at this place of the workspace, and is held there.
  virtual void touch(const Eigen::Vector3d& mark_m) = 0;
  /// Releases the tool, which the device then holds by its own force.
  virtual void let_go() = 0;
  /// Does the same for a device without force, whose brakes are then as they are without it.
  virtual void let_go_without_force() = 0;
  /// Hangs a weight of this mass on the tool; 0 takes it off.
  virtual void hang(double load_kg) = 0;
};

}  // namespace jnd::device
