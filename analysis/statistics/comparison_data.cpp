#include "analysis/statistics/comparison_data.h"

#include <algorithm>

namespace jnd::analysis {
namespace {

struct Group {
  std::vector<std::pair<std::string, std::string>> key;
  std::vector<std::size_t> rows;
};

std::vector<Group> groups_of(const CsvTable& table, const std::vector<std::string>& group_by) {
  std::vector<Group> groups;
  if (group_by.empty()) groups.emplace_back();
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    std::vector<std::pair<std::string, std::string>> key;
    for (const std::string& column : group_by) {
      key.emplace_back(column, table.cell(row, table.find(column).value()));
    }
    auto group = std::ranges::find(groups, key, &Group::key);
    if (group == groups.end()) {
      groups.push_back({std::move(key), {}});
      group = std::prev(groups.end());
    }
    group->rows.push_back(row);
  }
  return groups;
}

std::vector<double> at(const std::vector<double>& values,
                       const std::vector<std::size_t>& rows) {
  std::vector<double> found;
  for (const std::size_t row : rows) found.push_back(values[row]);
  return found;
}

}  // namespace

std::vector<ComparedColumns> read_compared(const CsvTable& table,
                                           const std::vector<std::string>& group_by,
                                           bool paired) {
  CsvReader reader(table);
  for (const std::string& column : group_by) reader.column(column);
  if (!group_by.empty()) {
    for (const char* column : {"a", "b"}) reader.column(column);
    reader.throw_problems();
  }
  std::vector<ComparedColumns> compared;
  if (paired) {
    const std::vector<double> a = reader.numbers("a"), b = reader.numbers("b");
    reader.throw_problems();
    for (Group& group : groups_of(table, group_by)) {
      compared.push_back({std::move(group.key), at(a, group.rows), at(b, group.rows)});
    }
    return compared;
  }
  for (Group& group : groups_of(table, group_by)) {
    compared.push_back({std::move(group.key), reader.numbers_until_empty("a", group.rows),
                        reader.numbers_until_empty("b", group.rows)});
  }
  reader.throw_problems();
  return compared;
}

}  // namespace jnd::analysis
