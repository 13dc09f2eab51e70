#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace jnd::app {

/// Adds `--fitting KEY=VALUE`, once for each thing that was fitted to the person.
void add_fitting_option(CLI::App& command, std::vector<std::string>& given);

/// What was given. Throws `UsageError` for what is no pair, and a key that is no name or was
/// given twice.
[[nodiscard]] std::map<std::string, std::string> fitting_given(
    const std::vector<std::string>& given);

}  // namespace jnd::app
