#include <cmath>
#include <string>
#include <vector>

#include "analysis/data/csv_table.h"
#include "analysis/fits/fit_data.h"
#include "core/error.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
using namespace jnd::analysis;

std::string quoted_row(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) {
    row += row.empty() ? "\"" : ",\"";
    for (const char letter : cell)
      row += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    row += '"';
  }
  return row + '\n';
}

/// Expects that the table is the same after every cell was written in quotes.
void check_round_trip(const CsvTable& table) {
  std::string text = quoted_row(table.columns());
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < table.columns().size(); ++i)
      cells.push_back(table.cell(row, i));
    text += quoted_row(cells);
  }
  const CsvTable again = CsvTable::parse(text, "x.csv");
  fuzz::property(again.columns() == table.columns(), "columns read back");
  fuzz::property(again.num_rows() == table.num_rows(), "rows read back");
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    for (std::size_t i = 0; i < table.columns().size(); ++i) {
      fuzz::property(again.cell(row, i) == table.cell(row, i), "cells read back");
    }
  }
}

template <typename Read>
void check_rows(const CsvTable& table, const std::vector<std::string>& group_by, Read read) {
  try {
    std::size_t num_rows = 0;
    for (const auto& group : read(table, group_by)) {
      num_rows += group.rows.size();
      fuzz::property(group.lines.size() == group.rows.size(), "every row has its line");
      for (const auto& row : group.rows) {
        fuzz::property(std::isfinite(row.intensity) && row.intensity >= 0.0,
                       "an intensity is finite and >= 0");
      }
    }
    fuzz::property(num_rows == table.num_rows(), "every row is in a group");
  } catch (const core::Error& error) {
    fuzz::check_lines(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const CsvTable table = CsvTable::parse(fuzz::text_of(data, size), "x.csv");
    check_round_trip(table);
    for (const std::vector<std::string>& group_by :
         {std::vector<std::string>{}, std::vector<std::string>{"participant"}}) {
      check_rows(table, group_by, read_answer_counts);
      check_rows(table, group_by, read_magnitudes);
    }
    CsvReader reader(table);
    static_cast<void>(reader.numbers_until_empty("a"));
    static_cast<void>(reader.numbers_until_empty("b"));
    reader.throw_problems();
  } catch (const core::Error& error) {
    fuzz::check_lines(error.what());
  }
  return 0;
}
