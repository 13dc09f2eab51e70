#pragma once

#include <string>
#include <vector>

namespace jnd::app::gui {

struct AxisTick {
  double value = 0.0;
  std::string label;  ///< With a true minus sign; as many decimals as the step needs.
};

/// Finite, low < high; both positive where it is for a logarithmic axis.
struct AxisRange {
  double low = 0.0;
  double high = 1.0;
};

/// What can be drawn of two ends in either order, whatever they are: equal ends are moved
/// apart, ends that are no number, or not positive on a logarithmic axis, are replaced.
[[nodiscard]] AxisRange sound_range(double low, double high, bool logarithmic);

/// Multiples of 1, 2 or 5 times a power of ten within the range, as many as possible up to
/// `max_count` >= 2; for a range that only few fit into, at least one.
[[nodiscard]] std::vector<AxisTick> linear_ticks(const AxisRange& range, int max_count);

/// Out to the ticks around the range.
[[nodiscard]] AxisRange widened_to_ticks(const AxisRange& range, int max_count);

/// Round numbers within the range, spread over its logarithm: 1, 1.5, 2, 3, 4 or decades, as
/// many as possible up to `max_count` >= 2; those of `linear_ticks` where it spans too little
/// for that.
[[nodiscard]] std::vector<AxisTick> logarithmic_ticks(const AxisRange& range, int max_count);

/// Three significant digits, for the value under the mouse: "0.0421", "13.6", "1240".
[[nodiscard]] std::string short_number(double value);

}  // namespace jnd::app::gui
