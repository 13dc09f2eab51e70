#pragma once

#include <string>
#include <vector>

namespace jnd::app::gui {

struct AxisTick {
  double value = 0.0;
  /// The number with a true minus sign and as many decimals as the step needs.
  std::string label;
};

/// Both ends are finite, low < high, and both are positive on a logarithmic axis.
struct AxisRange {
  double low = 0.0;
  double high = 1.0;
};

/// A range that can be drawn, from any two ends in any order. Equal ends are moved apart. Ends
/// that are not finite, or not positive on a logarithmic axis, are replaced.
[[nodiscard]] AxisRange sound_range(double low, double high, bool logarithmic);

/// The multiples of 1, 2 or 5 times a power of ten that lie in the range, as many as possible
/// up to `max_count` >= 2. A narrow range has at least one.
[[nodiscard]] std::vector<AxisTick> linear_ticks(const AxisRange& range, int max_count);

/// Widens the range to the ticks just outside it.
[[nodiscard]] AxisRange widened_to_ticks(const AxisRange& range, int max_count);

/// Round numbers in the range, spread evenly over its logarithm: 1, 1.5, 2, 3, 4 and so on, or
/// decades; as many as possible up to `max_count` >= 2. If the range spans too little for that,
/// the ticks are those of `linear_ticks`.
[[nodiscard]] std::vector<AxisTick> logarithmic_ticks(const AxisRange& range, int max_count);

/// Three significant digits, for the value under the mouse: "0.0421", "13.6", "1240".
[[nodiscard]] std::string short_number(double value);

}  // namespace jnd::app::gui
