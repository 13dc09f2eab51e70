#pragma once

#include <vector>

namespace jnd::analysis {

/// The ends of an axis that holds the values with a small margin. `low` < `high`.
struct AxisRange {
  double low = 0.0, high = 1.0;
};
/// The range of the values. With `logarithmic`, values <= 0 are left out, and the margin is a
/// factor of 1.25 at either end.
[[nodiscard]] AxisRange axis_range(const std::vector<double>& values, bool logarithmic = false);

}  // namespace jnd::analysis
