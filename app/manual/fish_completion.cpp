#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/manual/completions.h"

namespace jnd::app {
namespace {

constexpr const char* kFishFunctions = R"fish(
function __jnd_command --description 'The command of jnd that stands on the line'
    set -l words (commandline -opc)
    set -e words[1]
    set -l command ''
    for word in $words
        set -l longer (string trim -- "$command $word")
        if contains -- "$longer" $__jnd_commands
            set command $longer
        end
    end
    echo $command
end
function __jnd_in --description 'Whether this command of jnd stands on the line'
    set -l command (__jnd_command)
    test "$command" = "$argv"
end
complete -c jnd -f
)fish";

/// A text in quotes for fish, where a backslash escapes a quote or a backslash.
std::string fish_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') quoted += '\\';
    quoted += letter == '\n' ? ' ' : letter;
  }
  return quoted + "'";
}

/// What the value is chosen from, as switches of `complete`.
std::string fish_value(const ManualOption& option, const CommandWords& words) {
  if (option.kind == ValueKind::kNone) return "";
  const auto& offered =
      option.choices.empty() ? words_named(words, option.words) : option.choices;
  std::string text = option.is_positional ? "" : " -r";
  const bool takes_files = option.choices.empty() && option.kind != ValueKind::kNumber;
  text += takes_files ? " -F" : " -f";
  if (!offered.empty()) {
    text += " -a " + fish_quoted(fmt::format("{}", fmt::join(offered, " ")));
  }
  return text;
}

std::string fish_line(const ManualCommand& command, const ManualOption& option,
                      const CommandWords& words) {
  std::string names;
  for (const std::string& name : option.names) {
    if (option.is_positional) continue;
    names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return fmt::format("complete -c jnd -n {}{}{} -d {}\n",
                     fish_quoted("__jnd_in " + command.words()), names,
                     fish_value(option, words), fish_quoted(option.description));
}

}  // namespace

std::string fish_completion(const ManualCommand& root, const CommandWords& words) {
  std::string script = "# Completion of jnd for fish, from the same tables as `jnd --help`.\n";
  script += "set -g __jnd_commands";
  for (const ManualCommand* command : all_commands(root)) {
    if (!command->words().empty()) script += " " + fish_quoted(command->words());
  }
  script += kFishFunctions;
  for (const ManualCommand* command : all_commands(root)) {
    for (const ManualCommand& below : command->commands) {
      script += fmt::format("complete -c jnd -n {} -a {} -d {}\n",
                            fish_quoted("__jnd_in " + command->words()), last_word(below),
                            fish_quoted(below.description));
    }
    for (const ManualOption& option : command->options) {
      script += fish_line(*command, option, words);
    }
  }
  return script;
}

}  // namespace jnd::app
