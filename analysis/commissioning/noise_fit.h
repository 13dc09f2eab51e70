#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// What a device reports for a point that does not move, in the device's own frame, in which
/// its encoders have their steps.
struct NoiseFit {
  Measured position_sd_m;  ///< The standard deviation on one axis, from all three together.
  /// The least step between two readings, from all axes together; 0 if no readings differ.
  double position_resolution_m = 0.0;
  Measured velocity_sd_m_per_s;
  /// The first readings of the position, at most 250, minus the mean of all. They are for
  /// display.
  std::vector<Eigen::Vector3d> first_readings_m;
};

/// There is one reading per tick. The intervals of standard deviations come from chi-squared.
/// Throws `core::Error` for fewer than a hundred readings.
[[nodiscard]] NoiseFit fit_noise(const std::vector<Eigen::Vector3d>& position_m,
                                 const std::vector<Eigen::Vector3d>& velocity_m_per_s);

}  // namespace jnd::analysis
