#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "experiments/participants/laboratory.h"

namespace jnd::app {

/// Adds `--effect LEVELS:AMOUNTS`, which may be given several times and says how conditions
/// affect simulated people.
void add_effect_option(CLI::App& command, std::vector<std::string>& given);

/// A laboratory file, or a shipped one, with these effects added to its own. Throws
/// `UsageError` for an effect that is written wrongly, and `Error` as `read_laboratory` does.
[[nodiscard]] experiments::Laboratory laboratory_with_effects(
    const std::string& laboratory, const std::vector<std::string>& effects);

}  // namespace jnd::app
