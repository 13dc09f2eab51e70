#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// What a device says of a point that does not move, in the device's own frame, for there its
/// encoders have their steps.
struct NoiseFit {
  Measured position_sd_m;  ///< On one axis, all three together.
  /// The least step between two readings, all axes together; 0 where no reading differs.
  double position_resolution_m = 0.0;
  Measured velocity_sd_m_per_s;
  /// The first readings of the position, at most 250, less the mean of all, to look at.
  std::vector<Eigen::Vector3d> first_readings_m;
};

/// One reading a tick. Intervals of standard deviations by chi square. Throws `core::Error` for
/// fewer than a hundred.
[[nodiscard]] NoiseFit fit_noise(const std::vector<Eigen::Vector3d>& position_m,
                                 const std::vector<Eigen::Vector3d>& velocity_m_per_s);

}  // namespace jnd::analysis
