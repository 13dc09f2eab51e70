#include "analysis/export/csv_table_writer.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace jnd::analysis {

CsvTableWriter::CsvTableWriter(std::filesystem::path file,
                               const std::vector<CsvColumn>& columns)
    : file_(std::move(file)), stream_(file_, std::ios::binary), num_columns_(columns.size()) {
  for (const CsvColumn& column : columns) cell(std::string(column.name));
  end_row();
}

CsvTableWriter& CsvTableWriter::cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    put(text);
    return *this;
  }
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  put(quoted + '"');
  return *this;
}

CsvTableWriter& CsvTableWriter::cell(std::int64_t number) {
  put(std::to_string(number));
  return *this;
}

CsvTableWriter& CsvTableWriter::cell(double number) {
  if (!std::isfinite(number)) {
    put("");
    return *this;
  }
  char digits[32];
  char* const end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  put(std::string(digits, end));
  return *this;
}

void CsvTableWriter::put(const std::string& text) {
  if (num_cells_++ > 0) stream_ << ',';
  stream_ << text;
}

void CsvTableWriter::end_row() {
  if (num_cells_ != num_columns_) {
    throw core::Error(file_.string() + ": expected " + std::to_string(num_columns_) +
                      " cells in a row, found " + std::to_string(num_cells_));
  }
  stream_ << '\n';
  num_cells_ = 0;
}

void CsvTableWriter::finish() {
  stream_.flush();
  if (!stream_) {
    throw core::Error(file_.string() +
                      ": expected to write this file, found that it cannot be "
                      "written or the disk is full");
  }
}

}  // namespace jnd::analysis
