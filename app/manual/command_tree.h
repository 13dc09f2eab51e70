#pragma once

#include <string>
#include <vector>

#include "app/command_line/command.h"

namespace jnd::app {

/// What a shell offers where a value is due.
enum class ValueKind {
  kNone,    ///< There is no value: a flag.
  kNumber,  ///< Nothing can be offered.
  kPath,    ///< A file or a folder, or a name that no list holds.
  kFolder,
};

/// An option or a positional argument, as `--help` tells of it.
struct ManualOption {
  std::vector<std::string> names;  ///< "-h", "--help"; of a positional one, "FILE".
  bool is_positional = false;
  bool is_required = false;
  bool repeats = false;
  ValueKind kind = ValueKind::kNone;
  std::string value;                 ///< "COLUMN [num_yes]", "TEXT"; "" for a flag.
  std::string allowed;               ///< "0 to 65535"; "" if nothing is said.
  std::vector<std::string> choices;  ///< All there are; none if it is free.
  std::string standard;              ///< What holds without it; "" if nothing is said.
  std::vector<std::string> needs, excludes;
  std::string description;
  /// The list of `CommandWords` that may stand here besides files; "" for none.
  std::string words;
};

/// A command with its own commands, without those that help hides.
struct ManualCommand {
  std::string name;                   ///< "jnd fit weber"
  std::string description;            ///< One phrase.
  std::vector<ManualOption> options;  ///< Positional ones first, in their order.
  std::vector<ManualCommand> commands;
  std::vector<CommandExample> examples;

  /// Without the name of the program: "fit weber".
  [[nodiscard]] std::string words() const;
};

/// The tree that the command line is parsed by, as data. Nothing in it depends on the machine.
[[nodiscard]] ManualCommand command_tree(const CLI::App& program,
                                         const CommandExamples& examples);

/// The command and all below it, itself first.
[[nodiscard]] std::vector<const ManualCommand*> all_commands(const ManualCommand& root);

/// Words that a shell offers besides files, a list for each kind of name.
struct CommandWords {
  std::vector<std::string> studies, laboratories, devices;
};

}  // namespace jnd::app
