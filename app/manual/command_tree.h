#pragma once

#include <string>
#include <vector>

#include "app/command_line/command.h"

namespace jnd::app {

/// What a shell offers where a value is expected.
enum class ValueKind {
  kNone,    ///< There is no value: the option is a flag.
  kNumber,  ///< A number, for which nothing can be offered.
  kPath,    ///< A file or a folder, or a name that no list contains.
  kFolder,
};

/// An option or a positional argument, as `--help` describes it.
struct ManualOption {
  std::vector<std::string> names;  ///< Such as "-h" and "--help"; for a positional one, "FILE".
  bool is_positional = false;
  bool is_required = false;
  bool repeats = false;
  ValueKind kind = ValueKind::kNone;
  std::string value;                 ///< Such as "COLUMN [num_yes]" or "TEXT"; "" for a flag.
  std::string allowed;               ///< Such as "0 to 65535"; "" if nothing is said.
  std::vector<std::string> choices;  ///< All possible values; empty if the value is free.
  /// What applies without the option; "" if nothing is said.
  std::string standard;
  std::vector<std::string> needs, excludes;
  std::string description;
  /// The list of `CommandWords` that may be used here besides files; "" for none.
  std::string words;
};

/// A command and its own commands, without those that the help hides.
struct ManualCommand {
  std::string name;                   ///< Such as "jnd fit weber".
  std::string description;            ///< One phrase.
  std::vector<ManualOption> options;  ///< Positional ones first, in their order.
  std::vector<ManualCommand> commands;
  std::vector<CommandExample> examples;

  /// The name without that of the program, such as "fit weber".
  [[nodiscard]] std::string words() const;
};

/// The tree that the command line is parsed by, as data. Nothing in it depends on the machine.
[[nodiscard]] ManualCommand command_tree(const CLI::App& program,
                                         const CommandExamples& examples);

/// The command itself, followed by all commands below it.
[[nodiscard]] std::vector<const ManualCommand*> all_commands(const ManualCommand& root);

/// Words that a shell offers besides files, one list for each kind of name.
struct CommandWords {
  std::vector<std::string> studies, laboratories, devices;
};

}  // namespace jnd::app
