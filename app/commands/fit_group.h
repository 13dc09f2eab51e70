#pragma once

#include "app/command_line/command.h"

namespace jnd::app {

/// Adds `jnd fit hierarchical` and `jnd fit effects`, below `fit`.
void add_fit_group(CLI::App& fit, Invocation& invocation);

}  // namespace jnd::app
