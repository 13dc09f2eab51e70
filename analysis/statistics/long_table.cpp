#include "analysis/statistics/long_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "analysis/data/answer_rows.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

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

/// Fills in the people who have a value under each condition, with the mean of their values.
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

/// `conditions` are those of the whole table, so that a and b are the same in every group.
LongGroup group_of(std::vector<std::pair<std::string, std::string>> key,
                   const std::vector<Row>& rows, const std::vector<std::string>& conditions,
                   const LongColumns& columns) {
  LongGroup group{.key = std::move(key)};
  group.conditions = columns.levels;
  if (columns.levels.empty()) {
    std::ranges::copy_if(conditions, std::back_inserter(group.conditions),
                         [&](const std::string& condition) {
                           return std::ranges::count(rows, condition, &Row::condition) > 0;
                         });
  }
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

/// Collects the rows of each group as they are read.
class LongCollector : public RowSink {
 public:
  LongCollector(std::string name, const LongColumns& columns)
      : RowSink(std::move(name)), columns_(columns) {
    if (columns_.group_by.empty()) groups_.emplace_back();
  }

  void set_header(std::vector<std::string> header, int line) override {
    const auto place = [&](const std::string& column) {
      return problems().place_of(column, header, line);
    };
    value_ = place(columns_.value);
    by_ = place(columns_.by);
    if (!columns_.pair.empty()) pair_ = place(columns_.pair);
    for (const std::string& column : columns_.group_by) group_by_.push_back(place(column));
    problems().throw_problems();
  }

  void add_row(const std::vector<std::string_view>& cells, int line,
               bool decimal_comma) override {
    const auto cell = [&cells](std::size_t at) {
      return at < cells.size() ? cells[at] : std::string_view();
    };
    Row row{.condition = std::string(cell(by_)),
            .person = pair_ ? std::string(cell(*pair_)) : ""};
    if (is_missing(cell(value_)) || is_missing_name(row.condition) ||
        (pair_ && is_missing_name(row.person))) {
      ++num_missing_;
      return;
    }
    if (!std::ranges::count(known_, row.condition)) known_.push_back(row.condition);
    if (!columns_.levels.empty() && !std::ranges::count(columns_.levels, row.condition)) return;
    row.value = number_of(cell(value_), decimal_comma);
    if (std::isnan(row.value)) {
      problems().report(line, columns_.value, "a number, or NA", cell(value_));
      return;
    }
    Key key;
    for (std::size_t i = 0; i < group_by_.size(); ++i) {
      key.emplace_back(columns_.group_by[i], cell(group_by_[i]));
    }
    auto group =
        std::ranges::find_if(groups_, [&](const auto& one) { return one.first == key; });
    if (group == groups_.end()) {
      groups_.emplace_back(std::move(key), std::vector<Row>());
      group = std::prev(groups_.end());
    }
    group->second.push_back(std::move(row));
  }

  [[nodiscard]] LongTable finish() {
    problems().throw_problems();
    for (const std::string& level : columns_.levels) {
      if (std::ranges::count(known_, level)) continue;
      throw core::Error(problems().name() + ": " + columns_.by + ": expected one of " +
                        listed(known_) + " for --levels, found \"" + level + "\"");
    }
    LongTable table{.groups = {}, .num_missing = num_missing_};
    for (auto& [key, rows] : groups_) {
      table.groups.push_back(group_of(std::move(key), rows, known_, columns_));
    }
    return table;
  }

 private:
  using Key = std::vector<std::pair<std::string, std::string>>;

  const LongColumns& columns_;
  std::size_t value_ = 0, by_ = 0;
  std::optional<std::size_t> pair_;
  std::vector<std::size_t> group_by_;
  std::vector<std::string> known_;  ///< The conditions in the order of their first rows.
  std::vector<std::pair<Key, std::vector<Row>>> groups_;
  std::int64_t num_missing_ = 0;
};

}  // namespace

LongTable read_long(const std::filesystem::path& file, const LongColumns& columns) {
  LongCollector collector(file.string(), columns);
  read_rows(file, collector);
  return collector.finish();
}

LongTable parse_long(std::string_view text, const std::string& name,
                     const LongColumns& columns) {
  LongCollector collector(name, columns);
  parse_rows(text, collector);
  return collector.finish();
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
