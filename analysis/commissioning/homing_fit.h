#pragma once

#include <Eigen/Core>
#include <vector>

namespace jnd::analysis {

/// Whether a device finds its zero again, and what holds its tool when there is no force.
struct HomingFit {
  /// Where the device said that its tool rests after each homing, in the device frame. The tool
  /// is always at the same place.
  std::vector<Eigen::Vector3d> homed_m;
  double spread_m = 0.0;  ///< The largest distance between two of these.
  double moved_m = 0.0;   ///< How far the tool moved when it was released without force.
};

/// A released tool that moved at least this far has moved, and not only yielded.
inline constexpr double kHeld_m = 0.003;

/// Throws `core::Error` for fewer than two homings, or if a reading is not finite.
[[nodiscard]] HomingFit fit_homing(std::vector<Eigen::Vector3d> homed_m, double moved_m);

}  // namespace jnd::analysis
