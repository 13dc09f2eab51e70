#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace jnd::app {

/// What is wrong with a command line that CLI11 refused, as one sentence of ours: which word of
/// which subcommand is wrong, what was expected, what was found, and what to do.
[[nodiscard]] std::string usage_message(const CLI::App& program, const CLI::ParseError& error);

/// Throws `UsageError` if an option that needs a value swallowed the option after it, as in
/// `--to --json`, which CLI11 takes for a folder of that name.
void refuse_options_as_values(const CLI::App& program);

/// The text with control characters replaced by `?`, for a message that has to be one line.
[[nodiscard]] std::string one_line(std::string text);

}  // namespace jnd::app
