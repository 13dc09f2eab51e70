#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/data/csv_table.h"

namespace jnd::analysis {

/// The columns a and b of the rows that agree in the grouping columns.
struct ComparedColumns {
  std::vector<std::pair<std::string, std::string>> key;  ///< Column and value; empty for all.
  std::vector<double> a, b;
};

/// Reads the columns a and b. Groups come in the order of their first rows; without grouping
/// columns there is one group, of all rows. `paired`: every row needs both; else an empty cell
/// ends a column of its group. Throws `core::Error` with the problems, each "FILE:LINE: column:
/// expected this, found that".
[[nodiscard]] std::vector<ComparedColumns> read_compared(
    const CsvTable& table, const std::vector<std::string>& group_by, bool paired);

}  // namespace jnd::analysis
