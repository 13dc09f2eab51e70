#include "app/manual/command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

namespace jnd::app {
namespace {

/// Splits a text at colons, except colons within braces.
std::vector<std::string> parts_of(const std::string& type) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char letter : type) {
    depth += letter == '{' ? 1 : letter == '}' ? -1 : 0;
    if (letter == ':' && depth == 0) {
      parts.emplace_back();
    } else {
      parts.back() += letter;
    }
  }
  return parts;
}

std::vector<std::string> words_between_commas(const std::string& list) {
  std::vector<std::string> words(1);
  for (const char letter : list) {
    if (letter == ',') {
      words.emplace_back();
    } else {
      words.back() += letter;
    }
  }
  return words;
}

/// Sorts the options by name, because the order in the set depends on their places in memory.
std::vector<std::string> sorted_names(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  return names;
}

bool is_number(const std::string& type) {
  return type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
}

/// Reads the value's kind. CLI11 appends what the validators say to the type, each after a
/// colon.
void read_type(const CLI::Option& option, ManualOption& told) {
  const std::vector<std::string> parts = parts_of(option.get_type_name());
  told.value = parts.front();
  told.kind = is_number(told.value) ? ValueKind::kNumber : ValueKind::kPath;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    if (part.size() > 2 && part.front() == '{' && part.back() == '}') {
      told.choices = words_between_commas(part.substr(1, part.size() - 2));
    } else if (part == "DIR" || part == "FILE") {
      told.value = part;
      if (part == "DIR") told.kind = ValueKind::kFolder;
    } else {
      told.allowed += (told.allowed.empty() ? "" : ", ") + part;
    }
  }
}

/// Reads the text that replaces the type; it may itself say that the option is required.
void read_own_text(const CLI::Option& option, ManualOption& told) {
  std::string text = option.get_option_text();
  if (text.empty()) return;
  const std::string kRequired = " REQUIRED";
  if (text.ends_with(kRequired)) {
    text.resize(text.size() - kRequired.size());
    told.is_required = true;
  }
  told.value = text;
}

/// The name of the option's list in `CommandWords`; "" for none.
std::string list_of(const ManualOption& told) {
  const std::string& name = told.names.back();
  if (name == "--laboratory") return "laboratories";
  if (name == "--device" || name == "device") return "devices";
  if (name == "--from") return "studies";
  const bool is_study =
      told.is_positional && told.description.find("shipped stud") != std::string::npos;
  return is_study ? "studies" : "";
}

ManualOption told_of(const CLI::Option& option) {
  ManualOption told;
  told.is_positional = !option.nonpositional();
  if (told.is_positional) {
    told.names.push_back(option.get_name(true, false));
  } else {
    for (const std::string& name : option.get_snames()) told.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) told.names.push_back("--" + name);
  }
  told.description = option.get_description();
  told.is_required = option.get_required();
  told.repeats = option.get_expected_max() == CLI::detail::expected_max_vector_size;
  told.needs = sorted_names(option.get_needs());
  told.excludes = sorted_names(option.get_excludes());
  if (option.get_items_expected_max() == 0) return told;
  read_type(option, told);
  read_own_text(option, told);
  told.standard = option.get_default_str();
  // CLI11 gives the number of this machine's processors, which differs on other machines.
  if (told.names.back() == "--jobs") told.standard = "one for each processor";
  told.words = list_of(told);
  return told;
}

ManualCommand told_of(const CLI::App& app, const std::string& name,
                      const CommandExamples& examples) {
  ManualCommand told{.name = name, .description = app.get_description()};
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : app.get_options()) {
      if (option->get_group().empty() || option->nonpositional() == positional) continue;
      told.options.push_back(told_of(*option));
    }
  }
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_group().empty()) continue;
    told.commands.push_back(told_of(*command, name + " " + command->get_name(), examples));
  }
  if (const auto own = examples.find(&app); own != examples.end()) told.examples = own->second;
  return told;
}

void collect(const ManualCommand& command, std::vector<const ManualCommand*>& all) {
  all.push_back(&command);
  for (const ManualCommand& below : command.commands) collect(below, all);
}

}  // namespace

std::string ManualCommand::words() const {
  const std::size_t space = name.find(' ');
  return space == std::string::npos ? "" : name.substr(space + 1);
}

ManualCommand command_tree(const CLI::App& program, const CommandExamples& examples) {
  return told_of(program, program.get_name(), examples);
}

std::vector<const ManualCommand*> all_commands(const ManualCommand& root) {
  std::vector<const ManualCommand*> all;
  collect(root, all);
  return all;
}

}  // namespace jnd::app
