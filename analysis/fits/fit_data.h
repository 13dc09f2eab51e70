#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/data/csv_table.h"
#include "analysis/fits/power_fit.h"
#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// The rows of a table that agree in the grouping columns.
template <typename Row>
struct DataGroup {
  /// Columns and their values. It is empty if there are no grouping columns.
  std::vector<std::pair<std::string, std::string>> key;
  std::vector<Row> rows;
  std::vector<int> lines;  ///< The line of the file on which each row starts.
};

/// Reads the columns intensity, num_yes and num_trials. Groups come in the order of their first
/// rows; without grouping columns, one group holds all rows. Throws `core::Error` with every
/// problem in the form "FILE:LINE: column: expected this, found that". Problems are a missing
/// column, a cell that is not a number, a count that is not whole, more yes than trials, and an
/// intensity < 0.
[[nodiscard]] std::vector<DataGroup<AnswerCount>> read_answer_counts(
    const CsvTable& table, const std::vector<std::string>& group_by = {});

/// The different cells that a group's rows have in a column. Rows without trials are left out.
/// The set is empty if there is no such column.
template <typename Row>
[[nodiscard]] std::set<std::string> different_cells(const CsvTable& table,
                                                    const std::string& column,
                                                    const DataGroup<Row>& group) {
  const std::optional<std::size_t> place = table.find(column);
  std::set<std::string> cells;
  if (!place) return cells;
  std::size_t line = 0;
  for (std::size_t i = 0; i < group.rows.size(); ++i) {
    // The rows of a group keep the table's order.
    while (table.line(line) != group.lines[i]) ++line;
    if constexpr (requires { group.rows[i].num_trials; }) {
      if (group.rows[i].num_trials == 0) continue;
    }
    cells.insert(table.cell(line, *place));
  }
  return cells;
}

/// Reads the columns intensity and magnitude in the same way as `read_answer_counts`.
[[nodiscard]] std::vector<DataGroup<Magnitude>> read_magnitudes(
    const CsvTable& table, const std::vector<std::string>& group_by = {});

}  // namespace jnd::analysis
