#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// A CSV file with one header line: commas between cells, quotes around cells that hold commas,
/// quotes or line ends (RFC 4180). LF or CRLF, with or without a byte order mark; empty lines
/// are skipped, spaces around unquoted cells dropped. Cells stay text until asked for.
class CsvTable {
 public:
  /// Throws `core::Error`: the file cannot be read, or as `parse` says.
  [[nodiscard]] static CsvTable read(const std::filesystem::path& file);

  /// Throws `core::Error` with every problem of the form of the text, each "NAME:LINE: expected
  /// this, found that": no header, semicolons for commas, rows of another length, open quotes.
  [[nodiscard]] static CsvTable parse(std::string_view text, std::string name);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t num_rows() const noexcept { return rows_.size(); }
  [[nodiscard]] const std::string& cell(std::size_t row, std::size_t column) const {
    return rows_[row].cells[column];
  }
  /// Line of the file that a row starts on, from 1.
  [[nodiscard]] int line(std::size_t row) const { return rows_[row].line; }
  [[nodiscard]] std::optional<std::size_t> find(std::string_view column) const;

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };

  std::string name_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

/// Reads columns of a table as numbers, collecting problems instead of stopping at the first.
class CsvReader {
 public:
  explicit CsvReader(const CsvTable& table) : table_(table) {}

  /// Place of a column; a problem that names the columns there are if it is missing.
  std::optional<std::size_t> column(std::string_view name);

  /// Every cell of a column as a finite number; NaN, and a problem, where it is none. Empty if
  /// the column is missing.
  [[nodiscard]] std::vector<double> numbers(std::string_view name);

  /// The numbers down to the first empty cell, after which all must be empty.
  [[nodiscard]] std::vector<double> numbers_until_empty(std::string_view name);
  /// The same of some rows, ascending: an empty cell ends the column for them.
  [[nodiscard]] std::vector<double> numbers_until_empty(std::string_view name,
                                                        const std::vector<std::size_t>& rows);

  /// A problem "NAME:LINE: column: expected RULE, found CELL".
  void report(std::size_t row, std::string_view column, std::string_view rule);

  /// Throws `core::Error` with the problems in the order of the file, one a line, the first
  /// twenty if there are more.
  void throw_problems() const;

 private:
  [[nodiscard]] double number(std::size_t row, std::size_t column);

  const CsvTable& table_;
  std::vector<std::pair<int, std::string>> problems_;  ///< With the line of each.
};

}  // namespace jnd::analysis
