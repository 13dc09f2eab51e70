#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/storage/database.h"
#include "core/storage/study_rows.h"
#include "core/stored_column.h"

namespace jnd::core {

// Statements for the rows of study.sqlite, made from the tables of their columns, so that
// writing and reading use the same order.

/// Returns "session, sequence, ...".
template <typename Row>
[[nodiscard]] const std::string& column_names() {
  static const std::string kNames = [] {
    std::string names;
    for_each_column<Row>([&](const auto& column, const auto&) {
      names += (names.empty() ? "" : ", ") + std::string(column.name);
    });
    return names;
  }();
  return kNames;
}

/// Returns "INSERT INTO table (columns) VALUES (?, ...)".
template <typename Row>
[[nodiscard]] std::string insert_into(const std::string& table) {
  std::string marks;
  for_each_column<Row>([&](const auto&, const auto&) { marks += marks.empty() ? "?" : ", ?"; });
  return "INSERT INTO " + table + " (" + column_names<Row>() + ") VALUES (" + marks + ")";
}

/// Returns "SELECT columns FROM table". More of a statement may follow.
template <typename Row>
[[nodiscard]] std::string select_from(const std::string& table) {
  return "SELECT " + column_names<Row>() + " FROM " + table;
}

template <typename Value>
void bind_value(const Value& value, Statement& statement) {
  if constexpr (std::same_as<Value, std::uint64_t>) {
    statement.bind(std::to_string(value));
  } else if constexpr (std::integral<Value>) {
    statement.bind(std::int64_t{value});
  } else {
    statement.bind(value);
  }
}

// Reads a column of the statement's current row. NULL gives 0 if the field cannot be empty.
inline void read_value(const Statement& rows, int column, std::int64_t& value) {
  value = rows.integer(column);
}
inline void read_value(const Statement& rows, int column, int& value) {
  value = static_cast<int>(rows.integer(column));
}
inline void read_value(const Statement& rows, int column, bool& value) {
  value = rows.integer(column) != 0;
}
inline void read_value(const Statement& rows, int column, double& value) {
  value = rows.number(column);
}
inline void read_value(const Statement& rows, int column, std::string& value) {
  value = rows.text(column);
}
inline void read_value(const Statement& rows, int column, std::uint64_t& value) {
  const std::string text = rows.text(column);
  std::from_chars(text.data(), text.data() + text.size(), value);
}
inline void read_value(const Statement& rows, int column, std::optional<std::int64_t>& value) {
  value = rows.optional_integer(column);
}
inline void read_value(const Statement& rows, int column, std::optional<double>& value) {
  value = rows.optional_number(column);
}

/// Runs a statement of `insert_into` with this row.
template <typename Row>
void insert(const Row& row, Statement& statement) {
  for_each_column<Row>(
      [&](const auto&, const auto& value_in) { bind_value(value_in(row), statement); });
  statement.run();
}

/// Returns the current row of a statement of `select_from`.
template <typename Row>
[[nodiscard]] Row read_row(const Statement& rows) {
  Row row;
  int place = 0;
  for_each_column<Row>(
      [&](const auto&, const auto& value_in) { read_value(rows, place++, value_in(row)); });
  return row;
}

/// Returns all rows that are left.
template <typename Row>
[[nodiscard]] std::vector<Row> read_rows(Statement& rows) {
  std::vector<Row> all;
  while (rows.step()) all.push_back(read_row<Row>(rows));
  return all;
}

}  // namespace jnd::core
