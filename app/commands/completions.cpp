#include "app/manual/completions.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/session/shipped_files.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

/// The names of the shipped files in a folder, sorted: NAME.json, but no schemas.
std::vector<std::string> shipped_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() == ".json" && file.stem().extension() != ".schema") {
      names.push_back(file.stem().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

CommandWords offered_words() {
  CommandWords words;
  words.studies = shipped_names(shipped_folder() / "protocols");
  words.laboratories = shipped_names(shipped_folder() / "data" / "laboratories");
  for (const device::DeviceEntry& entry : device::devices()) {
    words.devices.push_back(std::string(entry.name) + (entry.argument.empty() ? "" : ":"));
  }
  return words;
}

int print_completions(const CLI::App& program, const CommandExamples& examples,
                      const std::string& shell) {
  const ManualCommand root = command_tree(program, examples);
  const CommandWords words = offered_words();
  fmt::print("{}", shell == "bash"  ? bash_completion(root, words)
                   : shell == "zsh" ? zsh_completion(root, words)
                                    : fish_completion(root, words));
  return kDone;
}

}  // namespace

HelpPlace place_of_completions() { return {HelpGroup::kProgram, 20}; }

void add_completions(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "completions", "Prints a script by which a shell completes commands and options");
  invocation.examples[command] = {
      {"source <(jnd completions bash)", "completes commands and options in this shell"}};
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->callback([&program, &invocation, shell] {
    invocation.run = [&program, &invocation, shell] {
      return print_completions(program, invocation.examples, *shell);
    };
  });
}

}  // namespace jnd::app
