#pragma once

#include <Eigen/Core>

namespace jnd::device {

/// What somebody does at a device while it is measured. A simulated device that can be measured
/// has one (`HapticDevice::bench`), which does it in the device's next tick; at a real one a
/// person is asked for each of these. Used by one thread, which need not be the loop's.
class Bench {
 public:
  virtual ~Bench() = default;

  /// Nobody's hand is in the device any more, and nothing else touches it.
  virtual void take_hand_out() = 0;
  /// It is homed anew as its maker says, and its tool rests where it rested before. Of a device
  /// that is closed.
  virtual void home() = 0;
  /// Nothing moves the tool, whatever acts on it, until it is let go.
  virtual void clamp() = 0;
  /// Whoever holds the tool is ready for its force, which grows from zero where it is held.
  virtual void expect_force() {}
  /// The first contact point is at this place of the workspace, and is held there.
  virtual void touch(const Eigen::Vector3d& mark_m) = 0;
  /// Neither clamped nor held at a mark; the device holds it by its own force.
  virtual void let_go() = 0;
  /// The same where it has no force, its brakes as they are without.
  virtual void let_go_without_force() = 0;
  /// A weight of this mass hangs from the tool; 0: none.
  virtual void hang(double load_kg) = 0;
};

}  // namespace jnd::device
