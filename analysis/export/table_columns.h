#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "analysis/export/table_writer.h"
#include "core/stored_column.h"

namespace jnd::analysis {

/// A column of a table: its description in the codebook, and what a row puts there. So one line
/// defines a column for CSV, BIDS, HDF5 and the codebook. `Cells` holds the data of a row.
template <typename Cells>
struct Column {
  CsvColumn column;
  std::function<void(TableWriter& to, const Cells& it)> put;
};
template <typename Cells>
using Columns = std::vector<Column<Cells>>;

template <typename Cells>
[[nodiscard]] std::vector<CsvColumn> told(const Columns<Cells>& columns) {
  std::vector<CsvColumn> all;
  for (const Column<Cells>& one : columns) all.push_back(one.column);
  return all;
}

/// Writes the cells of a row, starting at the column `first`.
template <typename Cells>
TableWriter& put(TableWriter& table, const Columns<Cells>& columns, const Cells& it,
                 std::size_t first = 0) {
  for (std::size_t i = first; i < columns.size(); ++i) columns[i].put(table, it);
  return table;
}

/// The type of a column for such a field. Numbers that may be missing are real.
template <typename Value>
constexpr ColumnType type_of_column() {
  if (std::same_as<Value, std::string> || std::same_as<Value, std::uint64_t>) {
    return ColumnType::kText;
  }
  return std::integral<Value> ? ColumnType::kCount : ColumnType::kReal;
}

template <typename Value>
void put_value(TableWriter& to, const Value& value) {
  if constexpr (std::same_as<Value, std::uint64_t>) {
    to.cell(std::to_string(value));
  } else if constexpr (std::same_as<Value, int>) {
    to.cell(std::int64_t{value});
  } else {
    to.cell(value);
  }
}

/// The columns of a stored row that data sets have. `row_of(it)` returns the row.
template <typename Cells, typename RowOf>
[[nodiscard]] Columns<Cells> stored_columns(RowOf row_of) {
  using StoredRow = std::remove_cvref_t<std::invoke_result_t<RowOf, const Cells&>>;
  Columns<Cells> all;
  core::for_each_column<StoredRow>([&](const auto& column, auto value_in) {
    if (*column.words == '\0') return;
    using Value = std::remove_cvref_t<decltype(value_in(std::declval<const StoredRow&>()))>;
    all.push_back({{column.name, column.unit, column.words, type_of_column<Value>()},
                   [row_of, value_in](TableWriter& to, const Cells& it) {
                     put_value(to, value_in(row_of(it)));
                   }});
  });
  return all;
}

}  // namespace jnd::analysis
