#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/power_fit.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// The magnitudes of one group with the fitted law S = S0 + k (I - I0)^a.
struct DrawnPowerLaw {
  std::string name;  ///< For example "participant 3"; "" for all rows.
  std::vector<Magnitude> rows;
  std::optional<double> k, a;  ///< Absent if there is no law.
  double intensity_threshold = 0.0, magnitude_offset = 0.0;
};

/// Draws magnitudes over intensities with the laws. The axes are logarithmic if no value is
/// below 0. Up to six groups are in one plot, and up to 48 in panels. Throws `core::Error` if
/// there is no row to draw.
[[nodiscard]] Figure power_law_figure(const std::vector<DrawnPowerLaw>& laws);

}  // namespace jnd::analysis
