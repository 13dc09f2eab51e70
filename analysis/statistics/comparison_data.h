#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/data/csv_table.h"

namespace jnd::analysis {

/// The columns a and b of the rows that agree in the grouping columns.
struct ComparedColumns {
  /// Columns and their values. It is empty if there are no grouping columns.
  std::vector<std::pair<std::string, std::string>> key;
  std::vector<double> a, b;
};

/// Reads the columns a and b. Groups come in the order of their first rows; without grouping
/// columns, one group holds all rows. If `paired` is true, every row needs both values.
/// Otherwise an empty cell ends a column of its group. Throws `core::Error` with the problems
/// in the form "FILE:LINE: column: expected this, found that".
[[nodiscard]] std::vector<ComparedColumns> read_compared(
    const CsvTable& table, const std::vector<std::string>& group_by, bool paired);

}  // namespace jnd::analysis
