#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/power_fit.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// Magnitudes of one group with the law fitted to them, S = S0 + k (I - I0)^a.
struct DrawnPowerLaw {
  std::string name;  ///< "participant 3"; "" for all rows.
  std::vector<Magnitude> rows;
  std::optional<double> k, a;  ///< None where there is no law.
  double intensity_threshold = 0.0, magnitude_offset = 0.0;
};

/// Magnitudes over intensities on logarithmic axes, where all of them that are not 0 are above
/// it, with the laws: up to six groups in one plot, up to 48 in panels. Throws `core::Error`
/// where there is no row to draw.
[[nodiscard]] Figure power_law_figure(const std::vector<DrawnPowerLaw>& laws);

}  // namespace jnd::analysis
