#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// A CSV file with one header line. Commas separate cells, and quotes enclose cells with
/// commas, quotes or line ends (RFC 4180). Lines end in LF or CRLF, with or without a byte
/// order mark. Empty lines are skipped, and spaces around unquoted cells are removed. Cells
/// stay text until they are read as something else.
class CsvTable {
 public:
  /// Throws `core::Error` if the file cannot be read, and as `parse` does.
  [[nodiscard]] static CsvTable read(const std::filesystem::path& file);

  /// Throws `core::Error` with every problem of the text's form, as "NAME:LINE: expected this,
  /// found that": no header, semicolons in place of commas, rows of another length, open
  /// quotes.
  [[nodiscard]] static CsvTable parse(std::string_view text, std::string name);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t num_rows() const noexcept { return rows_.size(); }
  [[nodiscard]] const std::string& cell(std::size_t row, std::size_t column) const {
    return rows_[row].cells[column];
  }
  /// The line of the file on which a row starts, from 1.
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

/// Reads columns of a table as numbers. It collects problems instead of stopping at the first.
class CsvReader {
 public:
  explicit CsvReader(const CsvTable& table) : table_(table) {}

  /// The index of a column. If it is missing, it reports a problem that names the existing
  /// columns.
  std::optional<std::size_t> column(std::string_view name);

  /// Every cell of a column as a finite number. An invalid cell becomes NaN and is reported.
  /// The result is empty if the column is missing.
  [[nodiscard]] std::vector<double> numbers(std::string_view name);

  /// The numbers down to the first empty cell, after which all must be empty.
  [[nodiscard]] std::vector<double> numbers_until_empty(std::string_view name);
  /// The same for some rows, ascending. An empty cell ends the column for them.
  [[nodiscard]] std::vector<double> numbers_until_empty(std::string_view name,
                                                        const std::vector<std::size_t>& rows);

  /// Reports a problem "NAME:LINE: column: expected RULE, found CELL".
  void report(std::size_t row, std::string_view column, std::string_view rule);

  /// Throws `core::Error` with the problems in the order of the file, one on each line. If
  /// there are more than twenty, it shows the first twenty.
  void throw_problems() const;

 private:
  [[nodiscard]] double number(std::size_t row, std::size_t column);

  const CsvTable& table_;
  std::vector<std::pair<int, std::string>> problems_;  ///< The problems with their lines.
};

}  // namespace jnd::analysis
