#pragma once

#include <string>
#include <vector>

#include "analysis/report/figure.h"

namespace jnd::analysis {

/// The numbers that a test compares, from one group of rows.
struct ComparedValues {
  std::string name;  ///< For example "participant 3"; "" for all rows.
  std::vector<std::string> conditions;
  std::vector<std::vector<double>> values;  ///< The values of each condition.
  /// Whether the i-th values of all conditions belong to one person. All conditions then have
  /// the same number of values.
  bool are_paired = false;
};

/// Draws every value, with the mean of each condition and its 95 % interval by Student's t.
/// Lines join the values of one person if they are paired. There are up to 48 groups; if there
/// are several, each has a panel. Throws `core::Error` if no group has a value.
[[nodiscard]] Figure value_figure(const std::vector<ComparedValues>& groups,
                                  const std::string& value_name);

/// Draws the second condition over the first, with one point for each pair. With `has_line` it
/// adds the least-squares line. Limits and errors are as for `value_figure`.
[[nodiscard]] Figure scatter_figure(const std::vector<ComparedValues>& groups, bool has_line);

}  // namespace jnd::analysis
