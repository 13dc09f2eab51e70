#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jnd::app {

/// Some lines of a text file, for whoever is told of a mistake in one of them.
struct FileExcerpt {
  struct Line {
    int number = 0;    ///< From 1.
    std::string text;  ///< Without tabs; cut, where it is long, around the place that is meant.
    bool is_meant = false;
    /// What of `text` stands before the place that is meant; the whole of it for none.
    std::string before;
  };
  std::vector<Line> lines;  ///< Empty where there is no such line.
};

/// The lines of a file, without their ends; none of one that cannot be read, or of more than a
/// megabyte. Not real time.
[[nodiscard]] std::vector<std::string> lines_of_file(const std::filesystem::path& file);

/// The line of this number with two on either side. `column`: from 1, in characters of UTF-8;
/// 0 for the line as a whole.
[[nodiscard]] FileExcerpt excerpt_at(const std::vector<std::string>& lines, int line,
                                     int column);

}  // namespace jnd::app
