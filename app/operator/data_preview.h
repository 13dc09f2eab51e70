#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/operator/background_task.h"

namespace jnd::app {

/// What a column of somebody's table contains, over all its rows.
struct PreviewColumn {
  std::string name;
  /// The different cells, in the order in which they first occur.
  std::vector<std::string> cells;
  bool has_more_cells = false;   ///< `cells` has only the first `kMost`.
  std::int64_t num_missing = 0;  ///< The rows whose cell is empty, NA or the like.
  bool is_numeric = true;        ///< Every cell that is not missing is a number.
  bool is_whole = true;          ///< Each of them is also an integer >= 0.
  /// Every cell that is not missing is a yes or a no to the reader of answers: 0, 1, true, no.
  bool is_yes_or_no = true;

  static constexpr std::size_t kMost = 60;
};

/// The beginning of somebody's table, and what its columns contain.
struct DataPreview {
  std::filesystem::path file;
  std::vector<PreviewColumn> columns;  ///< In the file's order.
  /// The first `kMostRows` rows; each has as many cells as there are columns.
  std::vector<std::vector<std::string>> rows;
  std::int64_t num_rows = 0;  ///< The number of rows below the header.
  bool decimal_comma = false;

  static constexpr std::size_t kMostRows = 500;

  /// The index of a column; the number of columns if there is none of this name.
  [[nodiscard]] std::size_t place_of(const std::string& column) const;
};

/// Reads the table as the fits do (`analysis::read_rows`). Throws `core::Error`, in the words
/// of that reader, if the file is no table. Not real time.
[[nodiscard]] DataPreview read_preview(const std::filesystem::path& file, WorkControl& control);

}  // namespace jnd::app
