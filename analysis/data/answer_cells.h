#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::analysis {

// What cells of tables of answers mean, whoever wrote them.

[[nodiscard]] std::string_view without_spaces(std::string_view text) noexcept;

/// Whether these are the same letters; `lower` has no capitals.
[[nodiscard]] bool same_word(std::string_view cell, std::string_view lower) noexcept;

/// Empty, NA, NaN, null or None: as a number or an answer.
[[nodiscard]] bool is_missing(std::string_view cell) noexcept;

/// Empty or NA: as the name of a person, a group or a condition, of which "none" may be one.
[[nodiscard]] bool is_missing_name(std::string_view cell) noexcept;

/// Whether a column is called as other programs call whether an answer was right: correct,
/// corr, acc, key_resp.corr. In a forced choice chance alone makes some of them so.
[[nodiscard]] bool is_called_right(std::string_view column) noexcept;

/// As a message shows it.
[[nodiscard]] std::string shown_cell(std::string_view cell);

/// "a, b, c", cut where there are many.
[[nodiscard]] std::string shown_columns(const std::vector<std::string>& header);

/// NaN for what is no finite number. `decimal_comma`: whether 1,5 is one.
[[nodiscard]] double number_of(std::string_view text, bool decimal_comma) noexcept;

/// The same text, or the same number.
[[nodiscard]] bool is_same_cell(std::string_view cell, std::string_view wanted,
                                bool decimal_comma) noexcept;

/// How many of how many trials were a yes.
struct CountedAnswers {
  std::int64_t num_yes = 0, num_trials = 1;
};

/// The columns that a row's answers stand in, and their words.
struct AnswerWords {
  std::string yes;
  std::optional<std::string> yes_value;  ///< The cell that is a yes; every other one is a no.
  std::optional<std::string> trials;     ///< Each row is one trial where absent.
};

/// Every problem of a table, each "NAME:LINE: column: expected this, found that".
class TableProblems {
 public:
  explicit TableProblems(std::string name) : name_(std::move(name)) {}

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  void report(int line, const std::string& column, const std::string& rule,
              std::string_view cell);
  void report_form(int line, const std::string& what);
  /// Place of this column in the header; a problem, and 0, where it is missing.
  std::size_t place_of(const std::string& column, const std::vector<std::string>& header,
                       int line);
  /// Throws `core::Error` with the first 20 of them, one a line, if there are any.
  void throw_problems() const;

 private:
  void add(std::string problem);

  std::string name_;
  std::vector<std::string> problems_;
  std::size_t num_problems_ = 0;
};

/// What these cells answer; nothing, and a problem, where they answer nothing. `trials` is not
/// read where `words` has no such column.
[[nodiscard]] std::optional<CountedAnswers> counted_answers(const AnswerWords& words,
                                                            std::string_view yes,
                                                            std::string_view trials,
                                                            bool decimal_comma, int line,
                                                            TableProblems& problems);

}  // namespace jnd::analysis
