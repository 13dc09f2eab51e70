#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_line/shell_word.h"
#include "app/manual/completions.h"

namespace jnd::app {
namespace {

// The part that is the same for any tree. `kind` is `value` for words only, `path` for files as
// well, `folder`, `nothing`, or "" if no option waits for its value.
constexpr const char* kBashBeginning =
    R"bash(# Completion of jnd for bash, from the same tables as `jnd --help`.
_jnd() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  if [[ $current == '=' ]]; then
    current=''
  elif [[ $previous == '=' && $COMP_CWORD -ge 2 ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
  local command='' options='' words='' kind='' positional='' i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$command${command:+ }${COMP_WORDS[i]}" in
)bash";

constexpr const char* kBashEnd = R"bash(  esac
  COMPREPLY=()
  if [[ -z $kind && $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
    return
  fi
  [[ -n $kind ]] || kind=$positional
  [[ $kind == nothing ]] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  case "$kind" in
    path)
      compopt -o filenames 2>/dev/null
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$current") ;;
    folder)
      compopt -o filenames 2>/dev/null
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$current") ;;
  esac
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *: ]]; then compopt -o nospace 2>/dev/null; fi
  if [[ ${#COMPREPLY[@]} -eq 0 && -z $current && -z $kind ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- '')
  fi
}
complete -F _jnd jnd
)bash";

std::string bash_kind(const ManualOption& option) {
  if (!option.choices.empty()) return "value";
  switch (option.kind) {
    case ValueKind::kNumber:
      return "nothing";
    case ValueKind::kFolder:
      return "folder";
    default:
      return "path";
  }
}

std::string bash_words(const ManualOption& option, const CommandWords& words) {
  const auto& all = option.choices.empty() ? words_named(words, option.words) : option.choices;
  return fmt::format("{}", fmt::join(all, " "));
}

/// The branch of one command: what the command takes, and what each of its options takes.
std::string bash_branch(const ManualCommand& command, const CommandWords& words) {
  std::vector<std::string> options, offered;
  std::string positional, values;
  for (const ManualCommand& below : command.commands) offered.push_back(last_word(below));
  for (const ManualOption& option : command.options) {
    if (option.is_positional) {
      const std::string these = bash_words(option, words);
      if (!these.empty()) offered.push_back(these);
      // If there are several positional arguments, whatever any of them takes is offered.
      if (const std::string kind = bash_kind(option); positional != "path") positional = kind;
      continue;
    }
    options.insert(options.end(), option.names.begin(), option.names.end());
    if (option.kind == ValueKind::kNone) continue;
    values += fmt::format("        {}) kind={} words={} ;;\n", fmt::join(option.names, "|"),
                          bash_kind(option), shell_quoted(bash_words(option, words)));
  }
  std::string branch = fmt::format("    {})\n      options={}\n", shell_quoted(command.words()),
                                   shell_quoted(fmt::format("{}", fmt::join(options, " "))));
  branch += fmt::format("      words={} positional={}\n",
                        shell_quoted(fmt::format("{}", fmt::join(offered, " "))),
                        shell_quoted(positional));
  if (!values.empty()) {
    branch += "      case \"$previous\" in\n" + values + "      esac\n";
  }
  return branch + "      ;;\n";
}

}  // namespace

std::string bash_completion(const ManualCommand& root, const CommandWords& words) {
  std::string script = kBashBeginning;
  std::vector<std::string> patterns;
  for (const ManualCommand* command : all_commands(root)) {
    if (!command->words().empty()) patterns.push_back(shell_quoted(command->words()));
  }
  script += fmt::format("      {})\n", fmt::join(patterns, "|"));
  script += "        command+=\"${command:+ }${COMP_WORDS[i]}\" ;;\n    esac\n  done\n";
  script += "  case \"$command\" in\n";
  for (const ManualCommand* command : all_commands(root))
    script += bash_branch(*command, words);
  return script + kBashEnd;
}

}  // namespace jnd::app
