#include "analysis/charts/axis_range.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {

AxisRange axis_range(const std::vector<double>& values, bool logarithmic) {
  std::vector<double> kept;
  for (const double value : values) {
    if (std::isfinite(value) && (!logarithmic || value > 0.0)) kept.push_back(value);
  }
  if (kept.empty()) return logarithmic ? AxisRange{0.1, 10.0} : AxisRange{};
  const auto [least, most] = std::minmax_element(kept.begin(), kept.end());
  if (logarithmic) return {*least / 1.25, *most * 1.25};
  const double width = *most - *least;
  const double air = width > 0.0 ? 0.05 * width : std::max(0.05 * std::abs(*most), 0.01);
  return {*least - air, *most + air};
}

}  // namespace jnd::analysis
