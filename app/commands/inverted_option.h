#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace jnd::app {

/// Adds `--inverted in|out`: what becomes of people who answer the wrong way round.
void add_inverted_option(CLI::App& command, std::string& given);

}  // namespace jnd::app
