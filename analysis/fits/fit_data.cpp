#include "analysis/fits/fit_data.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace jnd::analysis {
namespace {

/// Above this a double does not hold every whole number.
constexpr double kLargestCount = 1e15;

/// Reports the cells of a column that break a rule. Cells that are not numbers have been
/// reported before.
template <typename Rule>
void check(CsvReader& reader, const std::string& column, const std::vector<double>& values,
           const char* words, const Rule& holds) {
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isnan(values[row]) && !holds(values[row])) reader.report(row, column, words);
  }
}

std::vector<double> counts(CsvReader& reader, const std::string& column) {
  std::vector<double> values = reader.numbers(column);
  check(reader, column, values, "a whole number >= 0",
        [](double value) { return value >= 0.0 && value == std::floor(value); });
  check(reader, column, values, "a whole number of at most 1e15",
        [](double value) { return value <= kLargestCount || value != std::floor(value); });
  return values;
}

std::vector<double> intensities(CsvReader& reader) {
  std::vector<double> values = reader.numbers("intensity");
  check(reader, "intensity", values, "a number >= 0",
        [](double value) { return value >= 0.0; });
  return values;
}

/// Sorts rows into groups by their cells in the grouping columns.
template <typename Row>
std::vector<DataGroup<Row>> grouped(const CsvTable& table,
                                    const std::vector<std::string>& group_by,
                                    const std::vector<Row>& rows) {
  std::vector<DataGroup<Row>> groups;
  if (group_by.empty()) groups.emplace_back();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<std::pair<std::string, std::string>> key;
    for (const std::string& column : group_by) {
      key.emplace_back(column, table.cell(row, table.find(column).value()));
    }
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const DataGroup<Row>& other) { return other.key == key; });
    if (group == groups.end()) {
      groups.push_back({std::move(key), {}, {}});
      group = std::prev(groups.end());
    }
    group->rows.push_back(rows[row]);
    group->lines.push_back(table.line(row));
  }
  return groups;
}

}  // namespace

std::vector<DataGroup<AnswerCount>> read_answer_counts(
    const CsvTable& table, const std::vector<std::string>& group_by) {
  CsvReader reader(table);
  for (const std::string& column : group_by) reader.column(column);
  const std::vector<double> intensity = intensities(reader);
  const std::vector<double> num_yes = counts(reader, "num_yes");
  const std::vector<double> num_trials = counts(reader, "num_trials");
  for (std::size_t row = 0; row < std::min(num_yes.size(), num_trials.size()); ++row) {
    // An invalid count has been reported before, and may be too large to print as an integer.
    if (num_yes[row] > num_trials[row] && num_trials[row] >= 0.0 &&
        num_trials[row] <= kLargestCount) {
      reader.report(
          row, "num_yes",
          "at most num_trials = " + std::to_string(static_cast<long long>(num_trials[row])));
    }
  }
  reader.throw_problems();
  std::vector<AnswerCount> rows;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    rows.push_back({intensity[row], static_cast<std::int64_t>(num_yes[row]),
                    static_cast<std::int64_t>(num_trials[row])});
  }
  return grouped(table, group_by, rows);
}

std::vector<DataGroup<Magnitude>> read_magnitudes(const CsvTable& table,
                                                  const std::vector<std::string>& group_by) {
  CsvReader reader(table);
  for (const std::string& column : group_by) reader.column(column);
  const std::vector<double> intensity = intensities(reader);
  const std::vector<double> magnitude = reader.numbers("magnitude");
  reader.throw_problems();
  std::vector<Magnitude> rows;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    rows.push_back({intensity[row], magnitude[row]});
  }
  return grouped(table, group_by, rows);
}

}  // namespace jnd::analysis
