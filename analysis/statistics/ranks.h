#pragma once

#include <cstdint>
#include <vector>

namespace jnd::analysis {

/// The ranks of a sample, counted from 1. Ties share the mean of their ranks (midranks). The
/// ranks are stored doubled, so they are whole numbers and their sums can be counted.
struct Ranks {
  /// The doubled rank of each value, in the order of the values.
  std::vector<std::int64_t> doubled;
  double tie_correction = 0.0;  ///< The sum of t^3 - t over all ties of t values.

  [[nodiscard]] bool has_ties() const noexcept { return tie_correction > 0.0; }
};

/// Neighbours that differ by no more than the larger of their `roundings` are tied, because
/// rounding can make equal differences differ that much. `values` are finite. `roundings` are
/// >= 0, one for each value, or empty if the values are exact.
[[nodiscard]] Ranks ranks_of(const std::vector<double>& values,
                             const std::vector<double>& roundings = {});

}  // namespace jnd::analysis
