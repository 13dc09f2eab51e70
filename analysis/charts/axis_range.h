#pragma once

#include <vector>

namespace jnd::analysis {

/// Ends of an axis that holds these values with a little air; `low` < `high`.
struct AxisRange {
  double low = 0.0, high = 1.0;
};
/// With `logarithmic` values <= 0 are left out; in decades' halves around the rest.
[[nodiscard]] AxisRange axis_range(const std::vector<double>& values, bool logarithmic = false);

}  // namespace jnd::analysis
