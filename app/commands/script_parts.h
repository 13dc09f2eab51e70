#pragma once

#include <string>

#include "app/commands/answer_options.h"

/// What scripts that repeat a fit have in common.
namespace jnd::app {

/// A text in quotes that both R and Python read.
[[nodiscard]] std::string quoted(const std::string& text);

/// The columns of the answers and of the number of trials in a row; the latter is "" if each
/// row is one trial.
[[nodiscard]] std::string yes_column(const AnswerRequest& options);
[[nodiscard]] std::string trials_column(const AnswerRequest& options);

/// Lines of R that read the table as this program does. They define `data`, with cells as text
/// and only the rows of --where, and `number`, which turns cells into numbers.
[[nodiscard]] std::string r_table_text(const AnswerRequest& options);

/// Lines of R that compute from `data` the number of trials, `n`, and the number of yes
/// answers, `yes`.
[[nodiscard]] std::string r_answers_text(const AnswerRequest& options);

}  // namespace jnd::app
