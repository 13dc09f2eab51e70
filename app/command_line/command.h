#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace jnd::app {

/// The program's exit codes, on which others rely.
enum ExitCode : int {
  kDone = 0,
  kHasProblems = 1,  ///< What the command was asked about has problems.
  kWrongUsage = 2,
  /// A display, a device or a right is missing.
  kEnvironmentLacks = 3,
  kOwnFault = 4,
};

/// A wrong use that shows only after parsing. The sentence goes to stderr, with exit code 2.
class UsageError : public std::exception {
 public:
  explicit UsageError(std::string message) : message_(std::move(message)) {}
  [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

/// This machine lacks something. The sentence goes to stderr, with exit code 3.
class EnvironmentError : public UsageError {
 public:
  using UsageError::UsageError;
};

/// What a parsed command line leads to. A subcommand sets `run` in its CLI11 callback, and main
/// calls it after parsing. It returns an exit code, and may throw `core::Error` (exit 1),
/// `UsageError` (exit 2) or `EnvironmentError` (exit 3), whose sentence main prints on stderr.
struct Invocation {
  std::function<int()> run;
};

/// Adds one subcommand. Each is in app/commands/NAME.cpp as
///     void add_NAME(CLI::App& program, Invocation& invocation);
/// keeps its options in a std::shared_ptr that the callback captures, and prints results on
/// stdout; with `--json`, one JSON document and nothing else.
using Registration = void (*)(CLI::App& program, Invocation& invocation);

/// Every subcommand, in the order of `jnd --help`; see app/commands/registry.cpp.
[[nodiscard]] const std::vector<Registration>& registrations();

}  // namespace jnd::app
