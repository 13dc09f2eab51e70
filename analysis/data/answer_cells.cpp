#include "analysis/data/answer_cells.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostTableProblems = 20;
/// Above this a double does not hold every whole number.
constexpr double kLargestTally = 1e15;

bool is_count(double value) noexcept {
  return value >= 0.0 && value == std::floor(value) && value <= kLargestTally;
}

std::optional<bool> answer_of(const AnswerWords& words, std::string_view cell,
                              bool decimal_comma) {
  if (words.yes_value) return is_same_cell(cell, *words.yes_value, decimal_comma);
  if (cell == "1") return true;
  if (cell == "0" || cell == "-1") return false;
  const double value = number_of(cell, decimal_comma);
  if (value == 1.0) return true;
  if (value == 0.0 || value == -1.0) return false;
  if (same_word(cell, "true") || same_word(cell, "yes")) return true;
  if (same_word(cell, "false") || same_word(cell, "no")) return false;
  return std::nullopt;
}

}  // namespace

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

bool is_missing_name(std::string_view cell) noexcept {
  return cell.empty() || (cell.size() == 2 && same_word(cell, "na"));
}

bool is_called_right(std::string_view column) noexcept {
  static constexpr std::array<std::string_view, 8> kCalledRight = {
      "correct", "iscorrect", "is_correct", "corr", "acc", "accuracy", "right", "hit"};
  const std::string_view last = column.substr(column.rfind('.') + 1);
  return std::ranges::any_of(kCalledRight,
                             [last](std::string_view name) { return same_word(last, name); });
}

std::string shown_cell(std::string_view cell) {
  constexpr std::size_t kLongest = 60;
  const std::string part(cell.substr(0, kLongest));
  return nlohmann::json(part + (cell.size() > kLongest ? "..." : ""))
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

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

std::string shown_columns(const std::vector<std::string>& header) {
  std::string all;
  for (const std::string& column : header) {
    if (column.empty()) continue;
    all += (all.empty() ? "" : ", ") + column;
    if (all.size() > 300) return all + ", ...";
  }
  return all;
}

bool is_same_cell(std::string_view cell, std::string_view wanted, bool decimal_comma) noexcept {
  if (cell == wanted) return true;
  const double one = number_of(cell, decimal_comma), other = number_of(wanted, true);
  return one == other;  // This is never true for NaN.
}

void TableProblems::report(int line, const std::string& column, const std::string& rule,
                           std::string_view cell) {
  add(name_ + ':' + std::to_string(line) + ": " + column + ": expected " + rule + ", found " +
      shown_cell(cell));
}

void TableProblems::report_form(int line, const std::string& what) {
  add(name_ + ':' + std::to_string(line) + ": " + what);
}

std::size_t TableProblems::place_of(const std::string& column,
                                    const std::vector<std::string>& header, int line) {
  const auto found = std::ranges::find(header, column);
  if (found != header.end()) {
    if (const auto num = std::ranges::count(header, column); num > 1) {
      report_form(line, column + ": expected one column of this name, found " +
                            std::to_string(num) + "; rename all but one of them");
    }
    return static_cast<std::size_t>(found - header.begin());
  }
  report_form(line, column + ": expected a column of this name, found the columns " +
                        shown_columns(header));
  return 0;
}

void TableProblems::throw_problems() const {
  if (problems_.empty()) return;
  std::string text;
  for (const std::string& problem : problems_) text += (text.empty() ? "" : "\n") + problem;
  if (num_problems_ > problems_.size()) {
    text += "\n... and " + std::to_string(num_problems_ - problems_.size()) + " more";
  }
  throw core::Error(text);
}

void TableProblems::add(std::string problem) {
  ++num_problems_;
  if (problems_.size() < kMostTableProblems) problems_.push_back(std::move(problem));
}

std::optional<CountedAnswers> counted_answers(const AnswerWords& words, std::string_view yes,
                                              std::string_view trials, bool decimal_comma,
                                              int line, TableProblems& problems) {
  CountedAnswers counted;
  if (words.trials) {
    const double num = number_of(trials, decimal_comma);
    if (!is_count(num)) {
      problems.report(line, *words.trials, "a whole number >= 0", trials);
      return std::nullopt;
    }
    counted.num_trials = static_cast<std::int64_t>(num);
  }
  if (words.trials && !words.yes_value && counted.num_trials != 1) {
    const double num = number_of(yes, decimal_comma);
    if (!is_count(num) || num > static_cast<double>(counted.num_trials)) {
      problems.report(line, words.yes,
                      "a whole number from 0 to the " + std::to_string(counted.num_trials) +
                          " of " + *words.trials,
                      yes);
      return std::nullopt;
    }
    counted.num_yes = static_cast<std::int64_t>(num);
    return counted;
  }
  const std::optional<bool> is_yes = answer_of(words, yes, decimal_comma);
  if (!is_yes) {
    problems.report(line, words.yes,
                    "0 or 1, true or false, or -1 or 1; --yes-value names what is a yes", yes);
    return std::nullopt;
  }
  counted.num_yes = *is_yes ? counted.num_trials : 0;
  return counted;
}

}  // namespace jnd::analysis
