#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "analysis/data/compared_blocks.h"

namespace jnd::app {

/// Reads two names, such as "group_d,group_e". Throws `UsageError` for anything else.
[[nodiscard]] analysis::BlockNames compared_names(const std::string& text);

/// Adds `--compare FIRST,SECOND`, which may be given several times.
void add_compare_option(CLI::App& command, std::vector<std::string>& given);
[[nodiscard]] std::vector<analysis::BlockNames> compared_names(
    const std::vector<std::string>& given);

}  // namespace jnd::app
