#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_line/shell_word.h"
#include "app/manual/completions.h"

namespace jnd::app {
namespace {

constexpr const char* kZshBeginning = R"zsh(#compdef jnd
# Completion of jnd for zsh, from the same tables as `jnd --help`.
)zsh";

// Finds the command among the words, and completes what follows it as the command's arguments.
constexpr const char* kZshSearch = R"zsh(_jnd() {
  local command='' longer
  integer i depth=1
  for ((i = 2; i < CURRENT; i++)); do
    longer="$command${command:+ }${words[i]}"
    if (( ${_jnd_commands[(Ie)$longer]} )); then
      command=$longer
      depth=$i
    fi
  done
  words=(jnd "${(@)words[depth + 1,-1]}")
  (( CURRENT -= depth - 1 ))
  case "$command" in
)zsh";

constexpr const char* kZshEnd = R"zsh(  esac
}
if [[ $funcstack[1] == _jnd ]]; then _jnd "$@"; else compdef _jnd jnd; fi
)zsh";

/// Escapes colons and brackets, which have a meaning within brackets.
std::string zsh_safe(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') safe += '\\';
    safe += letter;
  }
  return safe;
}

/// What follows the second colon of an argument.
std::string zsh_action(const ManualOption& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  if (!option.words.empty()) return "_jnd_" + option.words;
  switch (option.kind) {
    case ValueKind::kNumber:
      return " ";
    case ValueKind::kFolder:
      return "_files -/";
    default:
      return "_files";
  }
}

std::string zsh_arguments(const ManualCommand& command) {
  std::string text;
  int position = 0;
  const auto add = [&text](const std::string& spec) {
    text += " \\\n        " + shell_quoted(spec);
  };
  for (const ManualOption& option : command.options) {
    if (option.is_positional) {
      ++position;
      const std::string where = option.repeats ? "*" : std::to_string(position);
      add(fmt::format("{}:{}:{}", where, zsh_safe(option.names.back()), zsh_action(option)));
      continue;
    }
    for (const std::string& name : option.names) {
      const bool has_value = option.kind != ValueKind::kNone;
      add(fmt::format(
          "{}{}{}[{}]{}", option.repeats ? "*" : "", name,
          !has_value               ? ""
          : name.starts_with("--") ? "="
                                   : "+",
          zsh_safe(option.description),
          has_value ? fmt::format(":{}:{}", zsh_safe(option.value), zsh_action(option)) : ""));
    }
  }
  if (!command.commands.empty()) {
    std::string below;
    for (const ManualCommand& one : command.commands) {
      below += fmt::format("{}{}", below.empty() ? "" : " ", last_word(one));
    }
    add(fmt::format("1:command:({})", below));
  }
  return text;
}

}  // namespace

std::string zsh_completion(const ManualCommand& root, const CommandWords& words) {
  std::string script = kZshBeginning;
  std::vector<std::string> names;
  for (const ManualCommand* command : all_commands(root)) {
    if (!command->words().empty()) names.push_back(shell_quoted(command->words()));
  }
  script += fmt::format("typeset -ga _jnd_commands=(\n  {}\n)\n", fmt::join(names, "\n  "));
  for (const char* list : {"studies", "laboratories", "devices"}) {
    script += fmt::format(
        "_jnd_{0}() {{ _alternative '{0}:shipped:({1})' 'files:file:_files' }}\n", list,
        zsh_safe(fmt::format("{}", fmt::join(words_named(words, list), " "))));
  }
  script += kZshSearch;
  for (const ManualCommand* command : all_commands(root)) {
    script += fmt::format("    ({})\n      _arguments -s{} ;;\n",
                          shell_quoted(command->words()), zsh_arguments(*command));
  }
  return script + kZshEnd;
}

}  // namespace jnd::app
