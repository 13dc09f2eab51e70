#pragma once

#include "app/command_line/command.h"

namespace jnd::app {

/// Adds `jnd fit detection` and `jnd fit same-different`, below `fit`.
void add_fit_detection(CLI::App& fit, Invocation& invocation);

}  // namespace jnd::app
