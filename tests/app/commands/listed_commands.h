#pragma once

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.h"

namespace jnd::app {

/// A command as `--help` prints it.
struct ListedCommand {
  std::vector<std::string> words;      ///< For example {"fit", "weber"}.
  std::vector<std::string> options;    ///< For example "--csv" and "-h".
  std::vector<std::string> arguments;  ///< For example "DIR".
};

inline void add_listed(const std::vector<std::string>& words, std::vector<ListedCommand>& all) {
  std::vector<std::string> asked = words;
  asked.emplace_back("--help");
  std::istringstream help(test_support::run_program(asked).out);
  ListedCommand command{.words = words, .options = {}, .arguments = {}};
  std::vector<std::string> below;
  std::string section;
  static const std::regex kOptions("  (-[A-Za-z0-9,-]+)(?: .*)?");
  static const std::regex kWord("  ([A-Za-z][A-Za-z0-9_-]*)(?: .*)?");
  for (std::string line; std::getline(help, line);) {
    std::smatch match;
    if (!line.empty() && line.back() == ':' && line.front() != ' ') section = line;
    if (section == "Options:" && std::regex_match(line, match, kOptions)) {
      std::istringstream names(match[1]);
      for (std::string name; std::getline(names, name, ',');) command.options.push_back(name);
    }
    if (!std::regex_match(line, match, kWord)) continue;
    if (section == "Positionals:") command.arguments.push_back(match[1]);
    if (section == "Subcommands:") below.push_back(match[1]);
  }
  all.push_back(command);
  for (const std::string& name : below) {
    std::vector<std::string> longer = words;
    longer.push_back(name);
    add_listed(longer, all);
  }
}

/// Returns every command of the program with all that it takes. They are read from the help
/// text that people see, and not from the tables behind it.
inline const std::vector<ListedCommand>& listed_commands() {
  static const std::vector<ListedCommand> kAll = [] {
    std::vector<ListedCommand> all;
    add_listed({}, all);
    return all;
  }();
  return kAll;
}

}  // namespace jnd::app
