#pragma once

#include "app/command_line/command.h"

namespace jnd::app {

/// Adds `jnd fit glmm`, below `fit`.
void add_fit_glmm(CLI::App& fit, Invocation& invocation);

}  // namespace jnd::app
