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
  std::vector<std::pair<std::string, std::string>> key;  ///< Column and value; empty for all.
  std::vector<Row> rows;
  std::vector<int> lines;  ///< Line of the file each row starts on.
};

/// Reads the columns intensity, num_yes, num_trials. Groups come in the order of their first
/// rows; without grouping columns there is one group, of all rows. Throws `core::Error` with
/// every problem, each "FILE:LINE: column: expected this, found that": a column missing, a cell
/// that is no number, a count that is not whole, more yes than trials, an intensity < 0.
[[nodiscard]] std::vector<DataGroup<AnswerCount>> read_answer_counts(
    const CsvTable& table, const std::vector<std::string>& group_by = {});

/// What different cells of a column a group's rows have, those without trials left out; none
/// without such a column.
template <typename Row>
[[nodiscard]] std::set<std::string> different_cells(const CsvTable& table,
                                                    const std::string& column,
                                                    const DataGroup<Row>& group) {
  const std::optional<std::size_t> place = table.find(column);
  std::set<std::string> cells;
  if (!place) return cells;
  std::size_t line = 0;
  for (std::size_t i = 0; i < group.rows.size(); ++i) {
    while (table.line(line) != group.lines[i]) ++line;  // A group keeps the table's order.
    if constexpr (requires { group.rows[i].num_trials; }) {
      if (group.rows[i].num_trials == 0) continue;
    }
    cells.insert(table.cell(line, *place));
  }
  return cells;
}

/// As `read_answer_counts`, for the columns intensity, magnitude.
[[nodiscard]] std::vector<DataGroup<Magnitude>> read_magnitudes(
    const CsvTable& table, const std::vector<std::string>& group_by = {});

}  // namespace jnd::analysis
