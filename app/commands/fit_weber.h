#pragma once

#include "app/command_line/command.h"

namespace jnd::app {

/// Adds `jnd fit weber`, below `fit`.
void add_fit_weber(CLI::App& fit, Invocation& invocation);

}  // namespace jnd::app
