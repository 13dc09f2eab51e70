#pragma once

#include "app/command_line/command.h"

namespace jnd::app {

/// Adds `jnd fit psychometric`, below `fit`.
void add_fit_psychometric(CLI::App& fit, Invocation& invocation);

}  // namespace jnd::app
