#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace jnd::analysis {

/// One column of a table, as the codebook tells it.
struct CsvColumn {
  const char* name;
  const char* unit;  ///< "" where there is none.
  const char* meaning;
};

/// Writes one CSV file (RFC 4180 with LF), independent of the locale. Throws `Error` naming the
/// file if it cannot be written. Not real time.
class CsvTableWriter {
 public:
  CsvTableWriter(std::filesystem::path file, const std::vector<CsvColumn>& columns);

  CsvTableWriter& cell(const std::string& text);
  CsvTableWriter& cell(std::int64_t number);
  CsvTableWriter& cell(double number);  ///< Not finite: empty.
  template <typename T>
  CsvTableWriter& cell(const std::optional<T>& value) {
    return value ? cell(*value) : cell(std::string());
  }
  /// Throws `Error` if the row has not one cell a column, which would be our own fault.
  void end_row();
  /// Everything is in the file. Throws `Error` if it is not.
  void finish();

 private:
  void put(const std::string& text);

  std::filesystem::path file_;
  std::ofstream stream_;
  std::size_t num_columns_;
  std::size_t num_cells_ = 0;
};

}  // namespace jnd::analysis
