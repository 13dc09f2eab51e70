#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/export/table_writer.h"

namespace jnd::analysis {

/// The format of a table.
enum class TableStyle {
  kCsv,  ///< RFC 4180 with LF. Missing values are empty.
  /// Tabs separate cells. Missing values are n/a, and tabs and line ends in a text become
  /// spaces.
  kBids,
  kBidsWithoutNames  ///< The same without the first line, as BIDS requires for motion.
};

/// How codebooks describe the texts of `CsvTableWriter`.
inline constexpr char kTextsOfTables[] =
    "A text that begins with =, +, -, @, a tab or a carriage return and is no number has an "
    "apostrophe before it, so that no spreadsheet runs it as a formula; where one of these "
    "follows apostrophes at the beginning of a text, the first apostrophe is not part of it";

/// Writes one table, independent of the locale: "." decimals, and the shortest digits that read
/// back as the same number. A text that a spreadsheet would run as a formula gets an apostrophe
/// before it. So does such a text that already begins with apostrophes, so that removing the
/// first one is always right. Throws `Error` that names the file if it cannot be written.
/// Not real time.
class CsvTableWriter final : public TableWriter {
 public:
  CsvTableWriter(std::filesystem::path file, const std::vector<CsvColumn>& columns,
                 TableStyle style = TableStyle::kCsv);
  CsvTableWriter(std::filesystem::path file, const std::vector<std::string>& names,
                 TableStyle style);

  /// Writes a number that was stored as a multiple of 10^-decimals as that decimal fraction. If
  /// it is off by more than `tolerance` of a step, all its digits are written.
  CsvTableWriter& fixed_cell(double number, int decimals, double tolerance = 1e-3);
  void end_row() override;
  /// Completes the file. Throws `Error` if something was not written.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { (void)std::fclose(file); }
  };

  void put_text(std::string_view text) override;
  void put_count(std::int64_t number) override;
  void put_real(double number) override;
  void put_nothing() override;
  void put_plain_text(std::string_view text);
  void put(std::string_view text);
  void put_quoted(std::string_view text);
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
