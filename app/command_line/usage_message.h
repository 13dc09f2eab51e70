#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace jnd::app {

/// What is wrong with a command line that CLI11 refused, as one sentence of ours: which word of
/// which subcommand, what was expected there, what was found, and what to do.
[[nodiscard]] std::string usage_message(const CLI::App& program, const CLI::ParseError& error);

/// Throws `UsageError` where an option without a value swallowed the option after it, as in
/// `--to --json`, which CLI11 takes for a folder of that name.
void refuse_options_as_values(const CLI::App& program);

/// The text with control characters shown as `?`, for a message that has to stay one line.
[[nodiscard]] std::string one_line(std::string text);

}  // namespace jnd::app
