#pragma once

#include <compare>
#include <exception>
#include <functional>
#include <map>
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

/// A call that shows what a command is for.
struct CommandExample {
  std::string call;     ///< "jnd validate my_study.json"
  std::string meaning;  ///< One phrase.
};

/// What the manual shows of each command, the program itself too.
using CommandExamples = std::map<const CLI::App*, std::vector<CommandExample>>;

/// What a parsed command line comes to: a subcommand sets `run` in its CLI11 callback, and main
/// calls it once parsing is over. It returns an exit code; it may throw `core::Error` (exit 1),
/// `UsageError` (exit 2) or `EnvironmentError` (exit 3), whose sentence main prints on stderr.
struct Invocation {
  std::function<int()> run;
  CommandExamples examples;
};

/// The groups of commands, in the order of `jnd --help`.
enum class HelpGroup {
  kFirstLook,
  kWriting,
  kRunning,
  kKeeping,  ///< A study, and acts on what is kept.
  kResults,
  kOtherData,  ///< Of other people.
  kApparatus,
  kProgram,
};

/// A command's place in the help: smaller numbers come first in its group.
struct HelpPlace {
  HelpGroup group;
  int number;
  auto operator<=>(const HelpPlace&) const = default;
};

/// Adds one subcommand. Each lives in app/commands/NAME.cpp as
///     HelpPlace place_of_NAME();
///     void add_NAME(CLI::App& program, Invocation& invocation);
/// and the build finds it there by the line of `add_NAME`. It keeps its options in a
/// std::shared_ptr captured by the callback, says its examples, and prints results on stdout;
/// with `--json`, one JSON document and nothing else.
using Registration = void (*)(CLI::App& program, Invocation& invocation);

/// Every subcommand, in the order of `jnd --help`; of equal places by the name.
[[nodiscard]] std::vector<Registration> registrations();

}  // namespace jnd::app
