#include "analysis/statistics/long_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"

namespace jnd::analysis {
namespace {

bool is_missing_cell(const std::string& cell) {
  static const std::set<std::string> kMissing = {"",     "NA",  "N/A", "na",
                                                 "null", "NaN", "nan", "None"};
  return kMissing.contains(cell);
}

struct Row {
  std::string condition, person;
  double value = 0.0;
};

std::vector<std::string> in_order(const std::vector<Row>& rows, std::string Row::*of) {
  std::vector<std::string> found;
  std::set<std::string> known;
  for (const Row& row : rows) {
    if (known.insert(row.*of).second) found.push_back(row.*of);
  }
  return found;
}

/// Who has a value under each of these conditions, by the mean of their values.
void complete_people(LongGroup& group, const std::vector<Row>& rows) {
  std::map<std::pair<std::string, std::string>, std::vector<double>> cells;
  for (const Row& row : rows) cells[{row.person, row.condition}].push_back(row.value);
  group.num_averaged = static_cast<int>(
      std::ranges::count_if(cells, [](const auto& cell) { return cell.second.size() > 1; }));
  group.complete.conditions = group.conditions;
  for (const std::string& person : in_order(rows, &Row::person)) {
    std::vector<double> means;
    for (const std::string& condition : group.conditions) {
      const auto cell = cells.find({person, condition});
      if (cell == cells.end()) break;
      double sum = 0.0;
      for (const double value : cell->second) sum += value;
      means.push_back(sum / static_cast<double>(cell->second.size()));
    }
    if (means.size() < group.conditions.size()) {
      group.incomplete.push_back(person);
      continue;
    }
    group.complete.people.push_back(person);
    group.complete.values.push_back(std::move(means));
  }
}

LongGroup group_of(std::vector<std::pair<std::string, std::string>> key,
                   const std::vector<Row>& rows, const LongColumns& columns) {
  LongGroup group{.key = std::move(key)};
  group.conditions = columns.levels.empty() ? in_order(rows, &Row::condition) : columns.levels;
  for (const std::string& condition : group.conditions) {
    std::vector<double>& values = group.values.emplace_back();
    for (const Row& row : rows) {
      if (row.condition == condition) values.push_back(row.value);
    }
  }
  if (!columns.pair.empty()) complete_people(group, rows);
  return group;
}

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

/// Throws where a level that is asked for is nobody's condition.
void require_levels(const CsvTable& table, std::size_t by_at, const LongColumns& columns) {
  std::vector<std::string> known;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& cell = table.cell(row, by_at);
    if (!is_missing_cell(cell) && !std::ranges::count(known, cell)) known.push_back(cell);
  }
  for (const std::string& level : columns.levels) {
    if (std::ranges::count(known, level)) continue;
    throw core::Error(table.name() + ": " + columns.by + ": expected one of " + listed(known) +
                      " for --levels, found \"" + level + "\"");
  }
}

}  // namespace

LongTable read_long(const CsvTable& table, const LongColumns& columns) {
  CsvReader reader(table);
  const auto value_at = reader.column(columns.value), by_at = reader.column(columns.by);
  const auto pair_at = columns.pair.empty() ? std::nullopt : reader.column(columns.pair);
  std::vector<std::size_t> group_at;
  for (const std::string& column : columns.group_by) {
    if (const auto at = reader.column(column)) group_at.push_back(*at);
  }
  reader.throw_problems();
  require_levels(table, *by_at, columns);
  LongTable result;
  std::vector<std::pair<std::vector<std::pair<std::string, std::string>>, std::vector<Row>>>
      groups;
  if (columns.group_by.empty()) groups.emplace_back();
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& cell = table.cell(row, *value_at);
    Row one{.condition = table.cell(row, *by_at),
            .person = pair_at ? table.cell(row, *pair_at) : ""};
    if (is_missing_cell(cell) || is_missing_cell(one.condition) ||
        (pair_at && is_missing_cell(one.person))) {
      ++result.num_missing;
      continue;
    }
    if (!columns.levels.empty() && !std::ranges::count(columns.levels, one.condition)) continue;
    const char* const end = cell.data() + cell.size();
    const auto [last, error] = std::from_chars(cell.data(), end, one.value);
    if (error != std::errc() || last != end || !std::isfinite(one.value)) {
      reader.report(row, columns.value, "a number, or NA");
      continue;
    }
    std::vector<std::pair<std::string, std::string>> key;
    for (std::size_t i = 0; i < group_at.size(); ++i) {
      key.emplace_back(columns.group_by[i], table.cell(row, group_at[i]));
    }
    auto group = std::ranges::find_if(groups, [&](const auto& g) { return g.first == key; });
    if (group == groups.end()) {
      groups.emplace_back(std::move(key), std::vector<Row>());
      group = std::prev(groups.end());
    }
    group->second.push_back(std::move(one));
  }
  reader.throw_problems();
  for (auto& [key, rows] : groups) {
    result.groups.push_back(group_of(std::move(key), rows, columns));
  }
  return result;
}

ComparedColumns two_conditions(const LongGroup& group, bool are_paired,
                               const std::string& name) {
  if (group.conditions.size() != 2) {
    throw core::Error(name + ": expected two conditions, found " +
                      std::to_string(group.conditions.size()) +
                      (group.conditions.empty() ? "" : " (" + listed(group.conditions) + ")") +
                      "; choose two by --levels A,B, or test all by --test anova or friedman");
  }
  ComparedColumns columns{.key = group.key, .a = {}, .b = {}};
  if (!are_paired) {
    columns.a = group.values[0];
    columns.b = group.values[1];
    return columns;
  }
  for (const std::vector<double>& values : group.complete.values) {
    columns.a.push_back(values[0]);
    columns.b.push_back(values[1]);
  }
  return columns;
}

}  // namespace jnd::analysis
