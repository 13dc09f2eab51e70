#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "analysis/data/compared_blocks.h"

namespace jnd::app {

/// "group_d,group_e". Throws `UsageError` for anything but two names.
[[nodiscard]] analysis::BlockNames compared_names(const std::string& text);

/// Adds `--compare FIRST,SECOND`, which may be given several times.
void add_compare_option(CLI::App& command, std::vector<std::string>& given);
[[nodiscard]] std::vector<analysis::BlockNames> compared_names(
    const std::vector<std::string>& given);

}  // namespace jnd::app
