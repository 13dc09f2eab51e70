#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace jnd::analysis {

enum class ColumnType {
  kText,
  kCount,  ///< Whole numbers, one in every row.
  kReal,   ///< Numbers, including whole ones that some rows lack.
};

/// One column of a table, as the codebook describes it.
struct CsvColumn {
  const char* name;
  const char* unit;  ///< "" if there is none.
  const char* meaning;
  ColumnType type = ColumnType::kText;
};

/// Receives a table cell by cell and row by row. Throws `Error` if it cannot be written.
/// Not real time.
class TableWriter {
 public:
  virtual ~TableWriter() = default;

  TableWriter& cell(std::string_view text) { return put_text(text), *this; }
  TableWriter& cell(const std::string& text) { return cell(std::string_view(text)); }
  TableWriter& cell(const char* text) { return cell(std::string_view(text)); }
  TableWriter& cell(std::int64_t number) { return put_count(number), *this; }
  /// NaN is written as missing.
  TableWriter& cell(double number) { return put_real(number), *this; }
  TableWriter& cell(bool flag) { return cell(std::int64_t{flag}); }  ///< Written as 1 or 0.
  template <typename T>
  TableWriter& cell(const std::optional<T>& value) {
    return value ? cell(*value) : nothing();
  }
  TableWriter& nothing() { return put_nothing(), *this; }  ///< Writes a missing value.
  /// Ends the row. Throws `Error` if the row does not have one cell for each column, which is
  /// an error in the program.
  virtual void end_row() = 0;

 private:
  virtual void put_text(std::string_view text) = 0;
  virtual void put_count(std::int64_t number) = 0;
  virtual void put_real(double number) = 0;
  virtual void put_nothing() = 0;
};

}  // namespace jnd::analysis
