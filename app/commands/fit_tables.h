#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "analysis/data/csv_table.h"
#include "analysis/fits/fit_data.h"
#include "analysis/fits/fit_json.h"
#include "analysis/statistics/fit_status.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/curves/fit_words.h"

/// What `jnd fit weber` and `jnd fit power` share: a table, each group of which is fitted.
namespace jnd::app {

struct TableOptions {
  std::string csv;
  std::vector<std::string> group_by;
  std::string figure;  ///< "" for none.
  bool json = false;
};

/// Such as "participant 3, condition A"; "" for a group of all rows.
[[nodiscard]] inline std::string heading_of(
    const std::vector<std::pair<std::string, std::string>>& key) {
  std::string heading;
  for (const auto& [column, value] : key) {
    heading += (heading.empty() ? "" : ", ") + column + " " + group_words(value);
  }
  return heading;
}

/// Tells on stderr, in one sentence, that fits have no value, whatever stdout shows.
inline void print_lacking(const TableOptions& options, const char* what,
                          std::size_t num_lacking, std::size_t num_groups,
                          const std::string& reason) {
  if (num_groups == 0) {
    fmt::print(stderr, "jnd: {}: expected rows below the header, found none\n", options.csv);
  } else if (num_groups == 1) {
    fmt::print(stderr, "jnd: {}: expected answers that have a {}, found none: {}\n",
               options.csv, what, reason);
  } else if (num_lacking > 0) {
    fmt::print(stderr, "jnd: {}: expected a {} in every group, found none in {} of {}: {}\n",
               options.csv, what, num_lacking, num_groups, reason);
  }
}

/// Fits and prints every group, and tells whether each of them has a value. `fit` makes a
/// result from a group, and `print` shows it to people.
template <typename Group, typename Fit, typename Print>
int fit_groups(const std::vector<Group>& groups, const TableOptions& options, const char* what,
               const Fit& fit, const Print& print) {
  std::size_t num_lacking = 0;
  std::string reason;  // The reason of the first group that has no value.
  using Json = nlohmann::ordered_json;
  Json results = Json::array();
  for (const Group& group : groups) {
    const auto result = fit(group);
    if (result.status != analysis::FitStatus::kOk && num_lacking++ == 0) reason = result.reason;
    if (options.json) {
      Json json;
      for (const auto& [column, value] : group.key) json["group"][column] = value;
      json.update(to_json(result));
      results.push_back(std::move(json));
      continue;
    }
    const std::string heading = heading_of(group.key);
    if (!heading.empty()) fmt::print("{}\n", heading);
    print(result, group);
  }
  if (options.json) {
    const Json document =
        options.group_by.empty() ? results.at(0) : Json{{"groups", std::move(results)}};
    fmt::print("{}\n", json_text(document));
  }
  if (num_lacking == 0 && !groups.empty()) return kDone;
  print_lacking(options, what, num_lacking, groups.size(), reason);
  return kHasProblems;
}

/// The rows of the file. Throws `core::Error` if something is wrong with the file, because then
/// the data have problems.
template <typename Read>
auto read_groups(const TableOptions& options, const Read& read) {
  return read(analysis::CsvTable::read(options.csv), options.group_by);
}

/// How many different values of a column a group adds up; 0 if the groups are separated by that
/// column.
template <typename Row>
std::size_t num_pooled(const analysis::CsvTable& table, const analysis::DataGroup<Row>& group,
                       const TableOptions& options, const char* column) {
  const bool is_grouped = std::find(options.group_by.begin(), options.group_by.end(), column) !=
                          options.group_by.end();
  return is_grouped ? 0 : analysis::different_cells(table, column, group).size();
}

/// Such as "--group-by condition,participant".
inline std::string grouped_also_by(const TableOptions& options, const char* column) {
  return fmt::format("--group-by {}{}{}", fmt::join(options.group_by, ","),
                     options.group_by.empty() ? "" : ",", column);
}

inline void add_table_options(CLI::App& command, TableOptions& options, const char* columns) {
  command.add_option("--csv", options.csv, std::string("table with the columns ") + columns)
      ->required();
  command
      .add_option("--group-by", options.group_by, "columns; one fit for each of their values")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("COLUMN[,COLUMN,..]");
}

}  // namespace jnd::app
