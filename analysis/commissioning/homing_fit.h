#pragma once

#include <Eigen/Core>
#include <vector>

namespace jnd::analysis {

/// Whether a device finds its zero again, and what holds its tool when it has no force.
struct HomingFit {
  /// Where it said that its tool rests after each homing, device frame, the tool always at the
  /// same place.
  std::vector<Eigen::Vector3d> homed_m;
  double spread_m = 0.0;  ///< The largest distance between two of these.
  double moved_m = 0.0;   ///< How far the tool went when it was let go of without force.
};

/// From here on a tool that is let go of has moved, and not only given way.
inline constexpr double kHeld_m = 0.003;

/// Throws `core::Error` for fewer than two homings, or where a reading is not finite.
[[nodiscard]] HomingFit fit_homing(std::vector<Eigen::Vector3d> homed_m, double moved_m);

}  // namespace jnd::analysis
