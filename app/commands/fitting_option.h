#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace jnd::app {

/// Adds `--fitting KEY=VALUE`, which is given once for each thing that was fitted to the
/// person.
void add_fitting_option(CLI::App& command, std::vector<std::string>& given);

/// The pairs that were given. Throws `UsageError` for anything that is no pair, and for a key
/// that is no name or was given twice.
[[nodiscard]] std::map<std::string, std::string> fitting_given(
    const std::vector<std::string>& given);

}  // namespace jnd::app
