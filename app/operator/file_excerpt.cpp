#include "app/operator/file_excerpt.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "app/language/words.h"

namespace jnd::app {
namespace {

constexpr std::uintmax_t kMostBytes = 1'000'000;
constexpr int kLinesAround = 2;
/// A line is cut to so many characters, so that the place that is meant can be seen.
constexpr std::size_t kMostCharacters = 120;
constexpr std::size_t kCharactersBefore = 70;

bool is_first_byte(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }

/// Where the character with this number, counted from 0, begins; the end of the text if there
/// is none.
std::size_t byte_of(const std::string& text, std::size_t character) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_first_byte(text[i]) && number++ == character) return i;
  }
  return text.size();
}

FileExcerpt::Line cut_line(const std::string& whole, int number, std::size_t meant) {
  const std::size_t first =
      meant != std::string::npos && meant > kCharactersBefore ? meant - kCharactersBefore : 0;
  const std::size_t begin = byte_of(whole, first);
  const std::size_t end = byte_of(whole, first + kMostCharacters);
  std::string front = first > 0 ? as_is("…") : "";
  FileExcerpt::Line line{.number = number};
  const auto without_tabs = [](std::string text) {
    std::ranges::replace(text, '\t', ' ');
    return text;
  };
  line.text = front + without_tabs(whole.substr(begin, end - begin)) +
              (end < whole.size() ? as_is("…") : "");
  line.before = line.text;
  if (meant != std::string::npos) {
    line.before = front + without_tabs(whole.substr(begin, byte_of(whole, meant) - begin));
  }
  return line;
}

}  // namespace

std::vector<std::string> lines_of_file(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::file_size(file, error) > kMostBytes || error) return {};
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.ends_with('\r')) line.pop_back();
    lines.push_back(std::move(line));
  }
  return lines;
}

FileExcerpt excerpt_at(const std::vector<std::string>& lines, int line, int column) {
  const int count = static_cast<int>(lines.size());
  FileExcerpt excerpt;
  if (line < 1 || line > count) return excerpt;
  for (int number = std::max(1, line - kLinesAround);
       number <= std::min(count, line + kLinesAround); ++number) {
    const bool is_meant = number == line;
    const std::size_t meant =
        is_meant && column > 0 ? static_cast<std::size_t>(column - 1) : std::string::npos;
    excerpt.lines.push_back(
        cut_line(lines[static_cast<std::size_t>(number - 1)], number, meant));
    excerpt.lines.back().is_meant = is_meant;
  }
  return excerpt;
}

}  // namespace jnd::app
