#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/operator/background_task.h"

namespace jnd::app {

/// What a column of somebody's table holds, over all its rows.
struct PreviewColumn {
  std::string name;
  std::vector<std::string> cells;  ///< Different ones, in the order of their first rows.
  bool has_more_cells = false;     ///< `cells` are the first `kMost` alone.
  std::int64_t num_missing = 0;    ///< Rows that have nothing, NA or their like in it.
  bool is_numeric = true;          ///< Every cell that is there is a number.
  bool is_whole = true;            ///< And one without decimals, >= 0.
  /// Every cell that is there is a yes or a no to the reader of answers: 0, 1, true, no.
  bool is_yes_or_no = true;

  static constexpr std::size_t kMost = 60;
};

/// The beginning of somebody's table, and what its columns hold.
struct DataPreview {
  std::filesystem::path file;
  std::vector<PreviewColumn> columns;          ///< As the file has them.
  std::vector<std::vector<std::string>> rows;  ///< The first `kMostRows`, as long as `columns`.
  std::int64_t num_rows = 0;                   ///< Below the header.
  bool decimal_comma = false;

  static constexpr std::size_t kMostRows = 500;

  /// Its place; that behind the last one where there is none.
  [[nodiscard]] std::size_t place_of(const std::string& column) const;
};

/// Reads the table as the fits do (`analysis::read_rows`). Throws `core::Error` with its
/// sentences for what is no table. Not real time.
[[nodiscard]] DataPreview read_preview(const std::filesystem::path& file, WorkControl& control);

}  // namespace jnd::app
