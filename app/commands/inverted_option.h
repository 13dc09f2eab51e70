#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace jnd::app {

/// Adds `--inverted in|out`, which says whether people who answer the wrong way round are
/// included.
void add_inverted_option(CLI::App& command, std::string& given);

}  // namespace jnd::app
