#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace jnd::app {

/// Exit codes of the program, a contract.
enum ExitCode : int {
  kDone = 0,
  kHasProblems = 1,  ///< The thing asked about has problems.
  kWrongUsage = 2,
  kEnvironmentLacks = 3,  ///< A display, a device, a right is missing.
  kOwnFault = 4,
};

/// A wrong use that only shows after parsing: the sentence goes to stderr, exit 2.
class UsageError : public std::exception {
 public:
  explicit UsageError(std::string message) : message_(std::move(message)) {}
  [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

/// Something of this machine is missing: the sentence goes to stderr, exit 3.
class EnvironmentError : public UsageError {
 public:
  using UsageError::UsageError;
};

/// What a parsed command line comes to: a subcommand sets `run` in its CLI11 callback, and main
/// calls it once parsing is over. It returns an exit code; it may throw `core::Error` (exit 1),
/// `UsageError` (exit 2) or `EnvironmentError` (exit 3), whose sentence main prints on stderr.
struct Invocation {
  std::function<int()> run;
};

/// Adds one subcommand. Each lives in app/commands/NAME.cpp as
///     void add_NAME(CLI::App& program, Invocation& invocation);
/// keeps its options in a std::shared_ptr captured by the callback, and prints results on
/// stdout; with `--json`, one JSON document and nothing else.
using Registration = void (*)(CLI::App& program, Invocation& invocation);

/// Every subcommand, in the order of `jnd --help`: app/commands/registry.cpp.
[[nodiscard]] const std::vector<Registration>& registrations();

}  // namespace jnd::app
