#pragma once

#include <string>

#include "app/commands/answer_options.h"

/// What scripts that repeat a fit have in common.
namespace jnd::app {

/// As R and Python both read it.
[[nodiscard]] std::string quoted(const std::string& text);

/// The column of the answers, and that of how many trials a row is; "" where it is one.
[[nodiscard]] std::string yes_column(const AnswerRequest& options);
[[nodiscard]] std::string trials_column(const AnswerRequest& options);

/// Lines of R that read the table as this program does: `data`, cells as text, the rows of
/// --where alone, and `number`, which makes numbers of cells.
[[nodiscard]] std::string r_table_text(const AnswerRequest& options);

/// Lines of R that make `n` and `yes`, how many trials and how many yes, of `data`.
[[nodiscard]] std::string r_answers_text(const AnswerRequest& options);

}  // namespace jnd::app
