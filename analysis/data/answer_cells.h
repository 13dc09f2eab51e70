#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::analysis {

// The meaning of cells in tables of answers, whatever program wrote them.

[[nodiscard]] std::string_view without_spaces(std::string_view text) noexcept;

/// Whether the texts are equal apart from case. `lower` has no capitals.
[[nodiscard]] bool same_word(std::string_view cell, std::string_view lower) noexcept;

/// Whether a number or an answer is missing: empty, NA, NaN, null or None.
[[nodiscard]] bool is_missing(std::string_view cell) noexcept;

/// Whether the name of a person, group or condition is missing: empty or NA. "none" may be such
/// a name.
[[nodiscard]] bool is_missing_name(std::string_view cell) noexcept;

/// Whether a column has a name by which other programs mark right answers: correct, corr, acc,
/// key_resp.corr. In a forced choice some answers are right by chance.
[[nodiscard]] bool is_called_right(std::string_view column) noexcept;

/// A cell in the form in which messages show it.
[[nodiscard]] std::string shown_cell(std::string_view cell);

/// The columns as "a, b, c", shortened if there are many.
[[nodiscard]] std::string shown_columns(const std::vector<std::string>& header);

/// The number in a text; NaN if it is no finite number. `decimal_comma` says whether 1,5 is a
/// number.
[[nodiscard]] double number_of(std::string_view text, bool decimal_comma) noexcept;

/// Whether both are the same text or the same number.
[[nodiscard]] bool is_same_cell(std::string_view cell, std::string_view wanted,
                                bool decimal_comma) noexcept;

/// How many of how many trials were a yes.
struct CountedAnswers {
  std::int64_t num_yes = 0, num_trials = 1;
};

/// The columns of a row's answers, and their words.
struct AnswerWords {
  std::string yes;
  /// The cell that means yes. Every other cell means no.
  std::optional<std::string> yes_value;
  std::optional<std::string> trials;  ///< If absent, each row is one trial.
};

/// Collects the problems of a table, each as "NAME:LINE: column: expected this, found that".
class TableProblems {
 public:
  explicit TableProblems(std::string name) : name_(std::move(name)) {}

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  void report(int line, const std::string& column, const std::string& rule,
              std::string_view cell);
  void report_form(int line, const std::string& what);
  /// The index of this column in the header. If it is missing, it reports a problem and returns
  /// 0.
  std::size_t place_of(const std::string& column, const std::vector<std::string>& header,
                       int line);
  /// Throws `core::Error` with the first 20 problems, one on each line, if there are any.
  void throw_problems() const;

 private:
  void add(std::string problem);

  std::string name_;
  std::vector<std::string> problems_;
  std::size_t num_problems_ = 0;
};

/// The answers in these cells. If they are invalid, it reports a problem and returns nothing.
/// `trials` is ignored if `words` has no such column.
[[nodiscard]] std::optional<CountedAnswers> counted_answers(const AnswerWords& words,
                                                            std::string_view yes,
                                                            std::string_view trials,
                                                            bool decimal_comma, int line,
                                                            TableProblems& problems);

}  // namespace jnd::analysis
