#include "analysis/data/answer_rows.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "core/error.h"

namespace jnd::analysis {
namespace {

/// The most frequent separator outside of quotes in a header line.
char separator_of(std::string_view header) noexcept {
  std::array<std::size_t, 3> counts{};
  constexpr std::string_view kSeparators = "\t;,";
  bool in_quotes = false;
  for (const char letter : header) {
    if (letter == '"') in_quotes = !in_quotes;
    const auto place = kSeparators.find(letter);
    if (!in_quotes && place != std::string_view::npos) ++counts[place];
  }
  const auto* const most = std::ranges::max_element(counts);
  return *most == 0 ? ',' : kSeparators[static_cast<std::size_t>(most - counts.begin())];
}

/// Splits text as it arrives. It takes whole rows, and the rest when more text has arrived.
class RowScanner {
 public:
  explicit RowScanner(RowSink& to) : to_(to) {}

  /// Takes the whole rows of `text`, and returns how much of it that was. `is_last` says that
  /// no more text follows.
  std::size_t take(std::string_view text, bool is_last) {
    std::size_t from = 0;
    while (from < text.size() && !is_over_) {
      const std::size_t end = row_end(text, from, is_last);
      if (end == std::string_view::npos) break;
      std::string_view row = text.substr(from, end - from);
      while (row.ends_with('\n') || row.ends_with('\r')) row.remove_suffix(1);
      take_row(row, line_);
      line_ += static_cast<int>(std::ranges::count(text.substr(from, end - from), '\n'));
      from = end;
    }
    return is_over_ ? text.size() : from;
  }
  [[nodiscard]] bool has_header() const noexcept { return num_columns_ > 0; }

 private:
  /// The place after the line end of the row that begins at `from`; npos if the row is not
  /// complete.
  std::size_t row_end(std::string_view text, std::size_t from, bool is_last) {
    bool in_quotes = false;
    for (std::size_t i = from; i < text.size(); ++i) {
      const char letter = text[i];
      if (letter == '"') in_quotes = !in_quotes;
      if (letter == '\0') {
        to_.problems().report_form(line_,
                                   "expected text, found a binary file; save the table as CSV");
        to_.problems().throw_problems();
      }
      if (!in_quotes && letter == '\n') return i + 1;
      // Files of old Macs have only carriage returns.
      if (!in_quotes && letter == '\r' && i + 1 < text.size() && text[i + 1] != '\n') {
        return i + 1;
      }
    }
    if (!is_last) return std::string_view::npos;
    if (in_quotes) {
      to_.problems().report_form(line_, "expected a closing quote, found the end of the file");
      to_.problems().throw_problems();
    }
    return text.size();
  }

  void take_row(std::string_view row, int line) {
    if (without_spaces(row).empty()) return;
    if (num_columns_ == 0) {
      if (row.size() == 5 && row.starts_with("sep=")) {  // Excel writes this line.
        separator_ = row[4];
        return;
      }
      if (separator_ == '\0') separator_ = separator_of(row);
      split(row);
      num_columns_ = cells_.size();
      to_.set_header({cells_.begin(), cells_.end()}, line);
      return;
    }
    split(row);
    if (cells_.front() == "extraInfo") {  // PsychoPy's text tables end with this.
      is_over_ = true;
      return;
    }
    for (std::size_t i = num_columns_; i < cells_.size(); ++i) {
      if (cells_[i].empty()) continue;
      to_.problems().report_form(
          line, "expected " + std::to_string(num_columns_) + " cells, found " +
                    std::to_string(cells_.size()) +
                    (separator_ == ',' ? "; decimals need a point, not a comma, "
                                         "where commas separate cells"
                                       : ""));
      return;
    }
    to_.add_row(cells_, line, separator_ != ',');
  }

  void split(std::string_view row) {
    cells_.clear();
    owned_.clear();
    std::size_t from = 0;
    while (true) {
      const std::size_t quote = row.find_first_not_of(" \t", from);
      if (quote != std::string_view::npos && row[quote] == '"' && separator_ != '"') {
        from = quoted_cell(row, quote);
      } else {
        const std::size_t end = std::min(row.find(separator_, from), row.size());
        cells_.push_back(without_spaces(row.substr(from, end - from)));
        from = end;
      }
      if (from >= row.size()) return;
      ++from;  // Skips the separator.
      if (from == row.size()) {
        cells_.emplace_back();
        return;
      }
    }
  }

  /// Adds the cell that begins with this quote, and returns the place of its separator.
  std::size_t quoted_cell(std::string_view row, std::size_t quote) {
    std::size_t end = quote + 1;
    bool has_quotes = false;
    while (end < row.size()) {
      if (row[end] == '"') {
        if (end + 1 >= row.size() || row[end + 1] != '"') break;
        has_quotes = true;
        ++end;
      }
      ++end;
    }
    const std::string_view inside = row.substr(quote + 1, end - quote - 1);
    if (!has_quotes) {
      cells_.push_back(inside);
    } else {
      auto text = std::make_unique<std::string>();
      for (std::size_t i = 0; i < inside.size(); ++i) {
        *text += inside[i];
        if (inside[i] == '"') ++i;
      }
      cells_.push_back(*text);
      owned_.push_back(std::move(text));
    }
    return std::min(row.find(separator_, std::min(end, row.size())), row.size());
  }

  RowSink& to_;
  std::size_t num_columns_ = 0;
  char separator_ = '\0';
  int line_ = 1;
  bool is_over_ = false;
  std::vector<std::string_view> cells_;
  /// Owns the text of cells that contain quotes.
  std::vector<std::unique_ptr<std::string>> owned_;
};

// --- JSON

/// A value as the cell of a table; "" for null.
std::string cell_of(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  return value.dump();
}

/// The keys of an object. Those of nested objects follow a point.
void flatten(const nlohmann::json& object, const std::string& before,
             std::vector<std::pair<std::string, std::string>>& to) {
  for (const auto& [key, value] : object.items()) {
    to.emplace_back(before + key, cell_of(value));
    if (value.is_object()) flatten(value, before + key + '.', to);
  }
}

void parse_json_rows(std::string_view text, RowSink& sink) {
  const std::string& name = sink.problems().name();
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  if (!document.is_array()) {
    throw core::Error(name + ": expected a JSON list of trials as jsPsych writes it, found " +
                      (document.is_discarded() ? "text that is no JSON" : "another document"));
  }
  std::vector<std::vector<std::pair<std::string, std::string>>> rows;
  std::vector<std::string> header;
  std::unordered_map<std::string, std::size_t> places;
  for (const nlohmann::json& trial : document) {
    if (!trial.is_object()) continue;
    rows.emplace_back();
    flatten(trial, "", rows.back());
    for (const auto& [key, cell] : rows.back()) {
      if (places.try_emplace(key, header.size()).second) header.push_back(key);
    }
  }
  if (header.empty()) throw core::Error(name + ": expected trials in the list, found none");
  sink.set_header(header, 1);
  std::vector<std::string_view> cells;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    cells.assign(header.size(), {});
    for (const auto& [key, cell] : rows[row]) cells[places.at(key)] = cell;
    sink.add_row(cells, static_cast<int>(row) + 1, false);
  }
}

bool is_json(std::string_view start) noexcept {
  const auto first = start.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && (start[first] == '[' || start[first] == '{');
}

std::string_view without_mark(std::string_view text) noexcept {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::ifstream opened(const std::filesystem::path& file) {
  std::ifstream in;
  if (!std::filesystem::is_directory(file)) in.open(file, std::ios::binary);
  if (!in.is_open()) {
    const char* found = std::filesystem::is_directory(file) ? "a folder"
                        : std::filesystem::exists(file)     ? "nothing that can be read"
                                                            : "no such file";
    throw core::Error(file.string() + ": expected a table of answers, found " + found);
  }
  return in;
}

constexpr std::size_t kChunkBytes = 1 << 18;

/// Passes the file in chunks to `take(text, is_last)`, which returns how much it took.
template <typename Take>
void feed(std::ifstream& in, const std::string& name, const Take& take) {
  constexpr std::size_t kLongestRow = 1 << 26;
  std::string buffer;
  bool is_first = true;
  while (true) {
    const std::size_t kept = buffer.size();
    buffer.resize(kept + kChunkBytes);
    in.read(buffer.data() + kept, static_cast<std::streamsize>(kChunkBytes));
    if (in.bad()) throw core::Error(name + ": expected a file that can be read to its end");
    buffer.resize(kept + static_cast<std::size_t>(in.gcount()));
    const bool is_last = in.eof();
    std::string_view text = buffer;
    if (is_first) text = without_mark(text);
    const std::size_t mark = is_first ? buffer.size() - text.size() : 0;
    is_first = false;
    const std::size_t taken = take(text, is_last);
    buffer.erase(0, mark + taken);
    if (is_last) return;
    if (buffer.size() > kLongestRow) {
      throw core::Error(name + ": expected rows of less than 64 MB; is a quote left open?");
    }
  }
}

void require_header(const RowScanner& scanner, const std::string& name) {
  if (scanner.has_header()) return;
  throw core::Error(name +
                    ":1: expected a header line that names the columns, found an empty file");
}

}  // namespace

void parse_rows(std::string_view text, RowSink& sink) {
  text = without_mark(text);
  if (is_json(text)) return parse_json_rows(text, sink);
  RowScanner scanner(sink);
  scanner.take(text, true);
  require_header(scanner, sink.problems().name());
}

void read_rows(const std::filesystem::path& file, RowSink& sink) {
  std::ifstream in = opened(file);
  std::string start(64, '\0');
  in.read(start.data(), 64);
  start.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  in.seekg(0);
  if (is_json(without_mark(start))) {
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return parse_rows(text, sink);
  }
  RowScanner scanner(sink);
  feed(in, file.string(),
       [&](std::string_view text, bool is_last) { return scanner.take(text, is_last); });
  require_header(scanner, file.string());
}

}  // namespace jnd::analysis
