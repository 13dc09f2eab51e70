#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jnd::app {

/// Some lines of a text file, for somebody who is told of a mistake in one of them.
struct FileExcerpt {
  struct Line {
    int number = 0;  ///< Counted from 1.
    /// Without tabs. A long line is cut around the place that is meant.
    std::string text;
    bool is_meant = false;
    /// The part of `text` before the place that is meant; the whole of it if no place is.
    std::string before;
  };
  std::vector<Line> lines;  ///< Empty if there is no such line.
};

/// The lines of a file, without their ends; none if the file cannot be read or has more than a
/// megabyte. Not real time.
[[nodiscard]] std::vector<std::string> lines_of_file(const std::filesystem::path& file);

/// The line with this number, and two on either side. `column` counts characters of UTF-8 from
/// 1; 0 means the whole line.
[[nodiscard]] FileExcerpt excerpt_at(const std::vector<std::string>& lines, int line,
                                     int column);

}  // namespace jnd::app
