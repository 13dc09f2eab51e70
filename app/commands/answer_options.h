#pragma once

#include "app/curves/answer_request.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// Adds --csv, --yes, --yes-value, --trials and --where.
void add_answer_columns(CLI::App& command, AnswerRequest& options);

/// Adds the same options, --intensity and --group-by.
void add_answer_options(CLI::App& command, AnswerRequest& options);

}  // namespace jnd::app
