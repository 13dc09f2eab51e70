#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::analysis {

/// One column of a table, as the codebook tells it.
struct CsvColumn {
  const char* name;
  const char* unit;  ///< "" where there is none.
  const char* meaning;
};

/// How a table is written.
enum class TableStyle {
  kCsv,   ///< RFC 4180 with LF; what there is not is empty.
  kBids,  ///< Tabs; what there is not is n/a; a tab or line end in a text is a space.
  kBidsWithoutNames  ///< The same without its first line, as BIDS wants of motion.
};

/// Writes one table, independent of the locale: "." decimals, the shortest digits that read
/// back as the same number. Throws `Error` naming the file if it cannot be written. Not real
/// time.
class CsvTableWriter {
 public:
  CsvTableWriter(std::filesystem::path file, const std::vector<CsvColumn>& columns,
                 TableStyle style = TableStyle::kCsv);
  CsvTableWriter(std::filesystem::path file, const std::vector<std::string>& names,
                 TableStyle style);

  CsvTableWriter& cell(std::string_view text);
  CsvTableWriter& cell(const std::string& text) { return cell(std::string_view(text)); }
  CsvTableWriter& cell(const char* text) { return cell(std::string_view(text)); }
  CsvTableWriter& cell(std::int64_t number);
  CsvTableWriter& cell(double number);  ///< Not finite: as what there is not.
  /// A number that was stored as a multiple of 10^-decimals, as that decimal fraction.
  CsvTableWriter& fixed_cell(double number, int decimals);
  template <typename T>
  CsvTableWriter& cell(const std::optional<T>& value) {
    return value ? cell(*value) : nothing();
  }
  CsvTableWriter& nothing();  ///< What there is not.
  /// Throws `Error` if the row has not one cell a column, which would be our own fault.
  void end_row();
  /// Everything is in the file. Throws `Error` if it is not.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { (void)std::fclose(file); }
  };

  void put(std::string_view text);
  void flush();
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path file_;
  TableStyle style_;
  std::unique_ptr<std::FILE, Close> stream_;
  std::string buffer_;
  std::size_t num_columns_;
  std::size_t num_cells_ = 0;
};

}  // namespace jnd::analysis
