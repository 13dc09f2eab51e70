#pragma once

#include <string>
#include <vector>

#include "analysis/report/figure.h"

namespace jnd::analysis {

/// Numbers that a test compares, of one group of rows.
struct ComparedValues {
  std::string name;  ///< "participant 3"; "" for all rows.
  std::vector<std::string> conditions;
  std::vector<std::vector<double>> values;  ///< Of each condition.
  /// Whether the i-th values of all conditions are of one person; all are then equally many.
  bool are_paired = false;
};

/// Every value, that of one person joined by a line where they are paired, with the mean of
/// each condition and its 95 % interval by Student's t. Up to 48 groups, each in a panel where
/// there are several. Throws `core::Error` where there is no group with a value.
[[nodiscard]] Figure value_figure(const std::vector<ComparedValues>& groups,
                                  const std::string& value_name);

/// The second condition over the first, a point a pair; with `has_line` the line of least
/// squares. Likewise otherwise.
[[nodiscard]] Figure scatter_figure(const std::vector<ComparedValues>& groups, bool has_line);

}  // namespace jnd::analysis
