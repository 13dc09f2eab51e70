#include "analysis/data/csv_table.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>

#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostProblems = 20;

std::string_view trimmed(std::string_view text) noexcept {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Whether the text contains Delete or a control character from U+0080 to U+009F, which JSON
/// may contain unescaped.
bool has_high_control(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (text[i] == '\x7F' || (text[i] == '\xC2' && next < 0xA0)) return true;
  }
  return false;
}

/// A cell in the form in which messages show it: in quotes, short, with control characters as
/// in JSON, and in UTF-8 whatever its bytes are.
std::string in_quotes(std::string_view cell, std::size_t most_bytes = 60) {
  for (std::size_t kept = std::min(cell.size(), most_bytes);; kept /= 2) {
    // The cut must not be inside a UTF-8 character.
    while (kept > 0 && kept < cell.size() &&
           (static_cast<unsigned char>(cell[kept]) & 0xC0) == 0x80) {
      --kept;
    }
    const std::string part =
        std::string(cell.substr(0, kept)) + (kept < cell.size() ? "..." : "");
    std::string shown = nlohmann::json(part).dump(-1, ' ', has_high_control(part),
                                                  nlohmann::json::error_handler_t::replace);
    if (shown.size() <= most_bytes + 20) return shown;
  }
}

[[noreturn]] void throw_all(const std::vector<std::string>& problems) {
  std::string text;
  for (std::size_t place = 0; place < std::min(problems.size(), kMostProblems); ++place) {
    if (place > 0) text += '\n';
    text += problems[place];
  }
  if (problems.size() > kMostProblems) {
    text += "\n... and " + std::to_string(problems.size() - kMostProblems) + " more";
  }
  throw core::Error(text);
}

/// Splits the text one row at a time.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }
  [[nodiscard]] int line() const noexcept { return line_; }

  /// The cells of the next row; empty for an empty line. `problem` says what is wrong with its
  /// quotes, or is "".
  std::vector<std::string> row(std::string& problem) {
    problem.clear();
    std::vector<std::string> cells;
    std::string cell;
    bool was_quoted = false;
    while (true) {
      if (!at_end() && rest_.front() == '"' && trimmed(cell).empty() && !was_quoted) {
        bool closed = true;
        cell = quoted_text(closed);
        if (!closed) problem = "expected a closing quote, found the end of the file";
        was_quoted = true;
        continue;
      }
      const bool row_ends = at_end() || rest_.front() == '\n' || rest_.front() == '\r';
      if (row_ends || rest_.front() == ',') {
        const bool empty_line =
            row_ends && cells.empty() && !was_quoted && trimmed(cell).empty();
        if (!empty_line) cells.emplace_back(was_quoted ? cell : trimmed(cell));
        if (row_ends) {
          skip_line_end();
          return cells;
        }
        cell.clear();
        was_quoted = false;
      } else if (!was_quoted) {
        cell += rest_.front();
      } else if (rest_.front() != ' ' && rest_.front() != '\t') {
        problem = "expected a comma or a line end after the closing quote of " +
                  in_quotes(cell) + ", found " + in_quotes(rest_.substr(0, 1));
      }
      rest_.remove_prefix(1);
    }
  }

 private:
  std::string quoted_text(bool& closed) {
    rest_.remove_prefix(1);
    std::string text;
    while (!at_end()) {
      const char letter = rest_.front();
      rest_.remove_prefix(1);
      if (letter == '\n') ++line_;
      if (letter != '"') {
        text += letter;
      } else if (!at_end() && rest_.front() == '"') {
        text += '"';
        rest_.remove_prefix(1);
      } else {
        return text;
      }
    }
    closed = false;
    return text;
  }

  void skip_line_end() noexcept {
    if (at_end()) return;
    const bool carriage_return = rest_.front() == '\r';
    rest_.remove_prefix(1);
    if (carriage_return && !at_end() && rest_.front() == '\n') rest_.remove_prefix(1);
    ++line_;
  }

  std::string_view rest_;
  int line_ = 1;
};

/// A number with a decimal point, independent of the locale; NaN if the text is no number.
double parsed_number(std::string_view text) noexcept {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

/// The number of letters to insert, delete or replace to turn one word into the other, ignoring
/// case.
std::size_t edit_distance(std::string_view one, std::string_view other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : one) {
    std::size_t diagonal = row[0]++;
    for (std::size_t place = 0; place < other.size(); ++place) {
      const bool same = std::tolower(static_cast<unsigned char>(letter)) ==
                        std::tolower(static_cast<unsigned char>(other[place]));
      const std::size_t changed = diagonal + (same ? 0 : 1);
      diagonal = row[place + 1];
      row[place + 1] = std::min({changed, row[place] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// The column that `name` may have meant: one that contains most of it, or is spelled
/// similarly; "" if there is none.
std::string nearest_column(std::string_view name, const std::vector<std::string>& columns) {
  std::string nearest;
  std::size_t least = name.size() / 2 + 1;
  for (const std::string& column : columns) {
    if (column.size() > 80) continue;
    const std::size_t distance = edit_distance(name, column);
    if (distance < least && distance < column.size()) {
      least = distance;
      nearest = column;
    }
  }
  return nearest;
}

bool has_decimal_comma(std::string text) {
  if (std::count(text.begin(), text.end(), ',') != 1) return false;
  std::replace(text.begin(), text.end(), ',', '.');
  return std::isfinite(parsed_number(text));
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (!in.is_open() || in.bad() || std::filesystem::is_directory(file)) {
    const char* found = std::filesystem::is_directory(file) ? "a folder"
                        : std::filesystem::exists(file)     ? "nothing that can be read"
                                                            : "no such file";
    throw core::Error(file.string() + ": expected a CSV file, found " + found);
  }
  return parse(text.str(), file.string());
}

CsvTable CsvTable::parse(std::string_view text, std::string name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  CsvTable table;
  table.name_ = std::move(name);
  std::vector<std::string> problems;
  const auto report = [&](int line, const std::string& what) {
    problems.push_back(table.name_ + ':' + std::to_string(line) + ": " + what);
  };
  if (text.find('\0') != std::string_view::npos) {
    report(1, "expected text, found a binary file; save the table as CSV");
    throw_all(problems);
  }
  Scanner scanner(text);
  while (!scanner.at_end()) {
    const int line = scanner.line();
    std::string problem;
    std::vector<std::string> cells = scanner.row(problem);
    if (!problem.empty()) {
      report(line, problem);
      if (!table.columns_.empty()) continue;  // The cells of such a row are ignored.
    }
    if (cells.empty()) continue;
    if (!table.columns_.empty()) {
      if (cells.size() != table.columns_.size()) {
        report(line, "expected " + std::to_string(table.columns_.size()) + " cells, found " +
                         std::to_string(cells.size()) +
                         (cells.size() > table.columns_.size()
                              ? "; decimals need a point, not a comma"
                              : ""));
      } else {
        table.rows_.push_back({line, std::move(cells)});
      }
      continue;
    }
    if (cells.size() == 1 && cells[0].find_first_of(";\t") != std::string::npos) {
      report(line, std::string("expected commas between the columns, found ") +
                       (cells[0].find(';') != std::string::npos ? "semicolons" : "tabs") +
                       "; decimals need a point");
      break;
    }
    std::set<std::string_view> seen;
    for (const std::string& column : cells) {
      if (!seen.insert(column).second) {
        report(line, "expected every column once, found " + in_quotes(column) + " again");
      }
    }
    table.columns_ = std::move(cells);
  }
  if (problems.empty() && table.columns_.empty()) {
    report(1, "expected a header line that names the columns, found an empty file");
  }
  if (!problems.empty()) throw_all(problems);
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::optional<std::size_t> CsvReader::column(std::string_view name) {
  const std::optional<std::size_t> found = table_.find(name);
  if (found) return found;
  constexpr std::size_t kLongest = 100;
  std::string columns;
  for (const std::string& column : table_.columns()) {
    if (!columns.empty()) columns += ", ";
    if (columns.size() > kLongest) {
      columns += "... (" + std::to_string(table_.columns().size()) + " columns)";
      break;
    }
    const std::string quoted = in_quotes(column, 30);
    columns += std::string_view(quoted).substr(1, quoted.size() - 2);
  }
  const std::string nearest = nearest_column(name, table_.columns());
  problems_.emplace_back(
      1, table_.name() + ":1: " + std::string(name) +
             ": expected a column of this name, found the columns " + columns +
             (nearest.empty() ? "" : "; rename " + in_quotes(nearest) + " if that is meant"));
  return std::nullopt;
}

void CsvReader::report(std::size_t row, std::string_view column, std::string_view rule) {
  const std::string& cell = table_.cell(row, table_.find(column).value());
  const int line = table_.line(row);
  problems_.emplace_back(line, table_.name() + ':' + std::to_string(line) + ": " +
                                   std::string(column) + ": expected " + std::string(rule) +
                                   ", found " +
                                   (cell.empty() ? "an empty cell" : in_quotes(cell)));
}

double CsvReader::number(std::size_t row, std::size_t column) {
  const std::string& cell = table_.cell(row, column);
  const double value = parsed_number(trimmed(cell));
  if (std::isfinite(value)) return value;
  report(
      row, table_.columns()[column],
      has_decimal_comma(cell) ? "a number with a point for the decimals" : "a finite number");
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> CsvReader::numbers(std::string_view name) {
  std::vector<double> values;
  const std::optional<std::size_t> place = column(name);
  for (std::size_t row = 0; place && row < table_.num_rows(); ++row) {
    values.push_back(number(row, *place));
  }
  return values;
}

std::vector<double> CsvReader::numbers_until_empty(std::string_view name) {
  std::vector<std::size_t> all(table_.num_rows());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return numbers_until_empty(name, all);
}

std::vector<double> CsvReader::numbers_until_empty(std::string_view name,
                                                   const std::vector<std::size_t>& rows) {
  std::vector<double> values;
  const std::optional<std::size_t> place = column(name);
  if (!place) return values;
  bool ended = false;
  for (const std::size_t row : rows) {
    if (table_.cell(row, *place).empty()) {
      ended = true;
    } else if (ended) {
      report(row, name, "an empty cell, because an empty cell above ended the column");
    } else {
      values.push_back(number(row, *place));
    }
  }
  return values;
}

void CsvReader::throw_problems() const {
  if (problems_.empty()) return;
  std::vector<std::pair<int, std::string>> by_line = problems_;
  std::stable_sort(by_line.begin(), by_line.end(),
                   [](const auto& one, const auto& other) { return one.first < other.first; });
  std::vector<std::string> problems;
  for (auto& [line, problem] : by_line) problems.push_back(std::move(problem));
  throw_all(problems);
}

}  // namespace jnd::analysis
