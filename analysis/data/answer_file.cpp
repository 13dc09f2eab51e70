#include "analysis/data/answer_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_map>

#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostAnswerProblems = 20;
constexpr std::size_t kMostPooled = 1000;
constexpr double kLargestTally = 1e15;  ///< Beyond, double does not hold every whole number.

std::string_view without_spaces(std::string_view text) noexcept {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool same_word(std::string_view cell, std::string_view lower) noexcept {
  return std::ranges::equal(cell, lower, [](char one, char other) {
    return std::tolower(static_cast<unsigned char>(one)) == other;
  });
}

bool is_missing(std::string_view cell) noexcept {
  if (cell.empty()) return true;
  if (cell.size() > 4) return false;
  return same_word(cell, "na") || same_word(cell, "nan") || same_word(cell, "null") ||
         same_word(cell, "none");
}

/// As a message shows it.
std::string shown_cell(std::string_view cell) {
  constexpr std::size_t kLongest = 60;
  const std::string part(cell.substr(0, kLongest));
  return nlohmann::json(part + (cell.size() > kLongest ? "..." : ""))
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// NaN for what is no number.
double number_of(std::string_view text, bool decimal_comma) noexcept {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  std::array<char, 64> copy{};
  if (decimal_comma && text.find(',') != std::string_view::npos) {
    if (text.size() > copy.size() || std::ranges::count(text, ',') != 1 ||
        text.find('.') != std::string_view::npos) {
      return kNone;
    }
    std::ranges::replace_copy(text, copy.begin(), ',', '.');
    text = {copy.data(), text.size()};
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? value : kNone;
}

/// Answers by intensity, found again by a table of places.
class Tallies {
 public:
  void add(double intensity, std::int64_t num_yes, std::int64_t num_trials) {
    if (intensity == 0.0) intensity = 0.0;  // Of -0, too.
    if (2 * (tallies_.size() + 1) > places_.size()) grow();
    std::uint32_t& place = places_[slot_of(intensity)];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(tallies_.size());
      tallies_.push_back({intensity, 0, 0});
    }
    tallies_[place].num_yes += num_yes;
    tallies_[place].num_trials += num_trials;
  }
  [[nodiscard]] std::vector<AnswerTally> take() {
    places_ = {};
    return std::move(tallies_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  [[nodiscard]] std::size_t slot_of(double intensity) const {
    auto bits = std::bit_cast<std::uint64_t>(intensity);
    bits = (bits ^ (bits >> 31)) * 0x9E3779B97F4A7C15ULL;
    std::size_t slot = (bits ^ (bits >> 29)) & (places_.size() - 1);
    while (places_[slot] != kNone && tallies_[places_[slot]].intensity != intensity) {
      slot = (slot + 1) & (places_.size() - 1);
    }
    return slot;
  }
  void grow() {
    places_.assign(std::max<std::size_t>(64, 2 * places_.size()), kNone);
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      places_[slot_of(tallies_[i].intensity)] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<AnswerTally> tallies_;
  std::vector<std::uint32_t> places_;
};

/// Takes rows of cells, whatever they are written as.
class AnswerCollector {
 public:
  AnswerCollector(std::string name, const AnswerColumns& columns)
      : name_(std::move(name)), columns_(columns) {}

  void set_header(std::vector<std::string> header, int line) {
    file_.columns = std::move(header);
    intensity_ = place_of(columns_.intensity, line);
    yes_ = place_of(columns_.yes, line);
    if (columns_.trials) trials_ = place_of(*columns_.trials, line);
    for (const std::string& name : columns_.group_by) {
      group_by_.push_back(place_of(name, line));
    }
    for (const auto& [name, cell] : columns_.where) where_.push_back(place_of(name, line));
    if (!problems_.empty()) throw_problems();
    for (std::size_t i = 0; i < file_.columns.size(); ++i) {
      const std::string& name = file_.columns[i];
      const bool tells_apart =
          std::ranges::any_of(kTellingApart, [&](const char* word) { return name == word; });
      const auto is_at = [i](std::size_t place) { return place == i; };
      if (tells_apart && std::ranges::none_of(group_by_, is_at) &&
          std::ranges::none_of(where_, is_at)) {
        pooled_.push_back(i);
      }
    }
    pooled_cells_.resize(pooled_.size());
  }
  [[nodiscard]] bool has_header() const noexcept { return !file_.columns.empty(); }
  [[nodiscard]] std::size_t num_columns() const noexcept { return file_.columns.size(); }

  /// `decimal_comma`: whether commas do not separate cells.
  void add_row(const std::vector<std::string_view>& cells, int line, bool decimal_comma) {
    ++file_.num_rows;
    const auto cell = [&](std::size_t place) {
      return place < cells.size() ? cells[place] : std::string_view();
    };
    for (std::size_t i = 0; i < where_.size(); ++i) {
      if (!equals(cell(where_[i]), columns_.where[i].second, decimal_comma)) {
        ++file_.num_elsewhere;
        return;
      }
    }
    if (skips(cell(intensity_), columns_.intensity) || skips(cell(yes_), columns_.yes)) return;
    if (trials_ && skips(cell(*trials_), *columns_.trials)) return;
    for (std::size_t i = 0; i < group_by_.size(); ++i) {
      if (skips(cell(group_by_[i]), columns_.group_by[i])) return;
    }
    const double intensity = number_of(cell(intensity_), decimal_comma);
    if (std::isnan(intensity)) {
      report(line, columns_.intensity, "a number", cell(intensity_));
      return;
    }
    if (intensity < 0.0 && !columns_.signed_intensities) {
      report(line, columns_.intensity, "a number >= 0 on a logarithmic axis", cell(intensity_));
      return;
    }
    std::int64_t num_trials = 1, num_yes = 0;
    if (trials_) {
      const double trials = number_of(cell(*trials_), decimal_comma);
      if (!is_count(trials)) {
        report(line, *columns_.trials, "a whole number >= 0", cell(*trials_));
        return;
      }
      num_trials = static_cast<std::int64_t>(trials);
    }
    if (trials_ && !columns_.yes_value && num_trials != 1) {
      const double yes = number_of(cell(yes_), decimal_comma);
      if (!is_count(yes) || yes > static_cast<double>(num_trials)) {
        report(line, columns_.yes,
               "a whole number from 0 to the " + std::to_string(num_trials) + " of " +
                   *columns_.trials,
               cell(yes_));
        return;
      }
      num_yes = static_cast<std::int64_t>(yes);
    } else {
      const std::optional<bool> is_yes = answer_of(cell(yes_), decimal_comma);
      if (!is_yes) {
        report(line, columns_.yes,
               "0 or 1, true or false, or -1 or 1; --yes-value names what is a yes",
               cell(yes_));
        return;
      }
      num_yes = *is_yes ? num_trials : 0;
    }
    for (std::size_t i = 0; i < pooled_.size(); ++i) {
      if (pooled_cells_[i].size() < kMostPooled) pooled_cells_[i].emplace(cell(pooled_[i]));
    }
    tallies_of(cells).add(intensity, num_yes, num_trials);
  }

  void report_form(int line, const std::string& what) {
    add_problem(name_ + ':' + std::to_string(line) + ": " + what);
  }

  [[nodiscard]] AnswerFile finish() {
    throw_problems();
    if (columns_.group_by.empty() && tallies_.empty()) tallies_.emplace_back();
    if (columns_.group_by.empty() && file_.groups.empty()) file_.groups.emplace_back();
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      file_.groups[i].tallies = tallies_[i].take();
    }
    for (std::size_t i = 0; i < pooled_.size(); ++i) {
      if (pooled_cells_[i].size() > 1) {
        file_.num_pooled[file_.columns[pooled_[i]]] = pooled_cells_[i].size();
      }
    }
    return std::move(file_);
  }

  void throw_problems() const {
    if (problems_.empty()) return;
    std::string text;
    for (const std::string& problem : problems_) {
      text += (text.empty() ? "" : "\n") + problem;
    }
    if (num_problems_ > problems_.size()) {
      text += "\n... and " + std::to_string(num_problems_ - problems_.size()) + " more";
    }
    throw core::Error(text);
  }

 private:
  static constexpr std::array<const char*, 9> kTellingApart = {
      "participant", "participant_id", "subject",  "Subject", "subj", "observer",
      "obs",         "condition",      "Condition"};

  static bool is_count(double value) noexcept {
    return value >= 0.0 && value == std::floor(value) && value <= kLargestTally;
  }
  static bool equals(std::string_view cell, const std::string& wanted, bool decimal_comma) {
    if (cell == wanted) return true;
    const double one = number_of(cell, decimal_comma), other = number_of(wanted, true);
    return one == other;  // Never of NaN.
  }

  std::size_t place_of(const std::string& name, int line) {
    const auto found = std::ranges::find(file_.columns, name);
    if (found != file_.columns.end()) {
      return static_cast<std::size_t>(found - file_.columns.begin());
    }
    std::string all;
    for (const std::string& column : file_.columns) {
      if (column.empty()) continue;
      all += (all.empty() ? "" : ", ") + column;
      if (all.size() > 300) {
        all += ", ...";
        break;
      }
    }
    add_problem(name_ + ':' + std::to_string(line) + ": " + name +
                ": expected a column of this name, found the columns " + all);
    return 0;
  }

  bool skips(std::string_view cell, const std::string& column) {
    if (!is_missing(cell)) return false;
    ++file_.num_missing[column];
    return true;
  }

  [[nodiscard]] std::optional<bool> answer_of(std::string_view cell, bool decimal_comma) const {
    if (columns_.yes_value) return equals(cell, *columns_.yes_value, decimal_comma);
    if (cell == "1") return true;
    if (cell == "0" || cell == "-1") return false;
    const double value = number_of(cell, decimal_comma);
    if (value == 1.0) return true;
    if (value == 0.0 || value == -1.0) return false;
    if (same_word(cell, "true") || same_word(cell, "yes")) return true;
    if (same_word(cell, "false") || same_word(cell, "no")) return false;
    return std::nullopt;
  }

  Tallies& tallies_of(const std::vector<std::string_view>& cells) {
    if (group_by_.empty()) {
      if (tallies_.empty()) {
        tallies_.emplace_back();
        file_.groups.emplace_back();
      }
      return tallies_[0];
    }
    key_.clear();
    for (const std::size_t place : group_by_) {
      if (place < cells.size()) key_ += cells[place];
      key_ += '\x1F';
    }
    const auto [found, is_new] = group_places_.try_emplace(key_, tallies_.size());
    if (is_new) {
      tallies_.emplace_back();
      AnswerGroup group;
      for (std::size_t i = 0; i < group_by_.size(); ++i) {
        group.key.emplace_back(columns_.group_by[i],
                               group_by_[i] < cells.size() ? cells[group_by_[i]] : "");
      }
      file_.groups.push_back(std::move(group));
    }
    return tallies_[found->second];
  }

  void report(int line, const std::string& column, const std::string& rule,
              std::string_view cell) {
    add_problem(name_ + ':' + std::to_string(line) + ": " + column + ": expected " + rule +
                ", found " + shown_cell(cell));
  }
  void add_problem(std::string problem) {
    ++num_problems_;
    if (problems_.size() < kMostAnswerProblems) problems_.push_back(std::move(problem));
  }

  std::string name_;
  const AnswerColumns& columns_;
  AnswerFile file_;
  std::size_t intensity_ = 0, yes_ = 0;
  std::optional<std::size_t> trials_;
  std::vector<std::size_t> group_by_, where_, pooled_;
  std::vector<std::set<std::string>> pooled_cells_;
  std::vector<Tallies> tallies_;
  std::unordered_map<std::string, std::size_t> group_places_;
  std::string key_;
  std::vector<std::string> problems_;
  std::size_t num_problems_ = 0;
};

/// The separator that a header line has most of outside of quotes.
char separator_of(std::string_view header) noexcept {
  std::array<std::size_t, 3> counts{};
  constexpr std::string_view kSeparators = "\t;,";
  bool in_quotes = false;
  for (const char letter : header) {
    if (letter == '"') in_quotes = !in_quotes;
    const auto place = kSeparators.find(letter);
    if (!in_quotes && place != std::string_view::npos) ++counts[place];
  }
  const auto most = std::ranges::max_element(counts);
  return *most == 0 ? ',' : kSeparators[static_cast<std::size_t>(most - counts.begin())];
}

/// Takes text apart as it comes: whole rows of what it is fed, the rest when more comes.
class RowScanner {
 public:
  explicit RowScanner(AnswerCollector& to) : to_(to) {}

  /// Takes the whole rows of `text`, and tells how much they are of it. `is_last`: no more
  /// comes.
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
  [[nodiscard]] int line() const noexcept { return line_; }

 private:
  /// Behind the line end of the row that begins at `from`; npos where it is not whole.
  std::size_t row_end(std::string_view text, std::size_t from, bool is_last) {
    bool in_quotes = false;
    for (std::size_t i = from; i < text.size(); ++i) {
      const char letter = text[i];
      if (letter == '"') in_quotes = !in_quotes;
      if (letter == '\0') {
        to_.report_form(line_, "expected text, found a binary file; save the table as CSV");
        to_.throw_problems();
      }
      if (!in_quotes && letter == '\n') return i + 1;
      // A file of old Macs has carriage returns alone.
      if (!in_quotes && letter == '\r' && i + 1 < text.size() && text[i + 1] != '\n') {
        return i + 1;
      }
    }
    if (!is_last) return std::string_view::npos;
    if (in_quotes) {
      to_.report_form(line_, "expected a closing quote, found the end of the file");
      to_.throw_problems();
    }
    return text.size();
  }

  void take_row(std::string_view row, int line) {
    if (without_spaces(row).empty()) return;
    if (!to_.has_header()) {
      if (row.size() == 5 && row.starts_with("sep=")) {  // As Excel writes it.
        separator_ = row[4];
        return;
      }
      if (separator_ == '\0') separator_ = separator_of(row);
      split(row);
      to_.set_header({cells_.begin(), cells_.end()}, line);
      return;
    }
    split(row);
    if (cells_.front() == "extraInfo") {  // What PsychoPy's text tables end with.
      is_over_ = true;
      return;
    }
    for (std::size_t i = to_.num_columns(); i < cells_.size(); ++i) {
      if (cells_[i].empty()) continue;
      to_.report_form(line, "expected " + std::to_string(to_.num_columns()) + " cells, found " +
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
      ++from;  // The separator.
      if (from == row.size()) {
        cells_.emplace_back();
        return;
      }
    }
  }

  /// Adds the cell that begins with this quote; tells where its separator is.
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

  AnswerCollector& to_;
  char separator_ = '\0';
  int line_ = 1;
  bool is_over_ = false;
  std::vector<std::string_view> cells_;
  std::vector<std::unique_ptr<std::string>> owned_;  ///< What cells with quotes within are of.
};

// --- JSON

/// A value as the cell of a table; "" for null.
std::string cell_of(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  return value.dump();
}

/// The keys of an object, those within objects after a point.
void flatten(const nlohmann::json& object, const std::string& before,
             std::vector<std::pair<std::string, std::string>>& to) {
  for (const auto& [key, value] : object.items()) {
    to.emplace_back(before + key, cell_of(value));
    if (value.is_object()) flatten(value, before + key + '.', to);
  }
}

AnswerFile parse_json_answers(std::string_view text, const std::string& name,
                              const AnswerColumns& columns) {
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
  AnswerCollector collector(name, columns);
  collector.set_header(header, 1);
  std::vector<std::string_view> cells;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    cells.assign(header.size(), {});
    for (const auto& [key, cell] : rows[row]) cells[places.at(key)] = cell;
    collector.add_row(cells, static_cast<int>(row) + 1, false);
  }
  return collector.finish();
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

/// Feeds the file to `take(text, is_last)`, which tells how much it took, chunk by chunk.
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

void require_header(const AnswerCollector& collector, const std::string& name) {
  if (collector.has_header()) return;
  throw core::Error(name +
                    ":1: expected a header line that names the columns, found an empty file");
}

}  // namespace

AnswerFile parse_answers(std::string_view text, const std::string& name,
                         const AnswerColumns& columns) {
  text = without_mark(text);
  if (is_json(text)) return parse_json_answers(text, name, columns);
  AnswerCollector collector(name, columns);
  RowScanner scanner(collector);
  scanner.take(text, true);
  require_header(collector, name);
  return collector.finish();
}

AnswerFile read_answer_file(const std::filesystem::path& file, const AnswerColumns& columns) {
  std::ifstream in = opened(file);
  std::string start(64, '\0');
  in.read(start.data(), 64);
  start.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  in.seekg(0);
  if (is_json(without_mark(start))) {
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return parse_answers(text, file.string(), columns);
  }
  AnswerCollector collector(file.string(), columns);
  RowScanner scanner(collector);
  feed(in, file.string(),
       [&](std::string_view text, bool is_last) { return scanner.take(text, is_last); });
  require_header(collector, file.string());
  return collector.finish();
}

}  // namespace jnd::analysis
