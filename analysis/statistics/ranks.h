#pragma once

#include <cstdint>
#include <vector>

namespace jnd::analysis {

/// Ranks of a sample from 1, ties sharing the mean of theirs (midranks). They are held doubled,
/// for then they are whole numbers, and sums of them can be counted.
struct Ranks {
  std::vector<std::int64_t> doubled;  ///< Of each value, in the order of the values.
  double tie_correction = 0.0;        ///< Sum of t^3 - t over ties of t values.

  [[nodiscard]] bool has_ties() const noexcept { return tie_correction > 0.0; }
};

/// Neighbours that differ by no more than the larger of their `roundings` are tied: that is
/// what rounding makes of equal differences. `values` are finite; `roundings` >= 0, one a
/// value, or none where values are as they were measured.
[[nodiscard]] Ranks ranks_of(const std::vector<double>& values,
                             const std::vector<double>& roundings = {});

}  // namespace jnd::analysis
