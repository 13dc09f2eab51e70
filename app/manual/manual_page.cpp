#include "app/manual/manual_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace jnd::app {
namespace {

/// Escapes a text for a page, so that none of its characters is taken for a request.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    if (letter == '\\') {
      safe += "\\e";
    } else if (letter == '-') {
      // A hyphen as it is typed, not as it is printed in books.
      safe += "\\-";
    } else if (letter == '^') {
      safe += "\\(ha";
    } else if (letter == '~') {
      safe += "\\(ti";
    } else if (letter == '`') {
      safe += "\\(ga";
    } else if (letter == '\'') {
      safe += "\\(aq";
    } else if (letter == '"') {
      safe += "\\(dq";
    } else {
      safe += letter == '\n' ? ' ' : letter;
    }
  }
  return safe.starts_with('.') ? "\\&" + safe : safe;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string slanted(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string page_name(const std::string& command_name) {
  std::string name = command_name;
  std::ranges::replace(name, ' ', '-');
  return name;
}

/// The words as a sentence that ends with a full stop.
std::string as_sentence(const std::string& words) {
  if (words.empty() || words.ends_with('.')) return words;
  return words + ".";
}

std::string reference(const std::string& command_name) {
  return bold(page_name(command_name)) + "(1)";
}

std::string synopsis(const ManualCommand& command) {
  std::string text = bold(command.name) + " [" + slanted("OPTION") + " ...]";
  for (const ManualOption& option : command.options) {
    if (!option.is_positional && !option.is_required) continue;
    std::string part = option.is_positional
                           ? slanted(option.names.back())
                           : bold(option.names.back()) + " " + slanted(option.value);
    if (option.is_positional && option.repeats) part += " ...";
    text += " " + (option.is_required ? part : "[" + part + "]");
  }
  if (!command.commands.empty()) {
    const std::string word = slanted("COMMAND") + " ...";
    text += " " + (command.words().empty() ? "[" + word + "]" : word);
  }
  return text;
}

/// Puts into sentences what `--help` says in brackets and signs.
std::string rules_of(const ManualOption& option) {
  std::vector<std::string> rules;
  if (option.is_required && !option.is_positional) rules.emplace_back("Required.");
  if (!option.choices.empty()) {
    rules.push_back(fmt::format("One of: {}.", fmt::join(option.choices, ", ")));
  }
  if (!option.allowed.empty()) rules.push_back("Allowed: " + option.allowed + ".");
  if (!option.standard.empty()) rules.push_back("Default: " + option.standard + ".");
  if (option.repeats) rules.emplace_back("May be given several times.");
  if (!option.needs.empty()) {
    rules.push_back(fmt::format("Only with {}.", fmt::join(option.needs, ", ")));
  }
  if (!option.excludes.empty()) {
    rules.push_back(fmt::format("Not with {}.", fmt::join(option.excludes, ", ")));
  }
  return fmt::format("{}", fmt::join(rules, " "));
}

std::string options_section(const ManualCommand& command, bool positional) {
  std::string text;
  for (const ManualOption& option : command.options) {
    if (option.is_positional != positional) continue;
    std::vector<std::string> names;
    for (const std::string& name : option.names) {
      names.push_back(positional ? slanted(name) : bold(name));
    }
    text += fmt::format(".TP\n{}", fmt::join(names, ", "));
    if (!positional && !option.value.empty()) text += " " + slanted(option.value);
    text += "\n" + roff(as_sentence(option.description)) + "\n";
    if (const std::string rules = rules_of(option); !rules.empty()) text += roff(rules) + "\n";
  }
  if (text.empty()) return text;
  return std::string(".SH ") + (positional ? "ARGUMENTS\n" : "OPTIONS\n") + text;
}

std::string commands_section(const ManualCommand& command) {
  if (command.commands.empty()) return "";
  std::string text = ".SH COMMANDS\n";
  for (const ManualCommand& below : command.commands) {
    text +=
        ".TP\n" + reference(below.name) + "\n" + roff(as_sentence(below.description)) + "\n";
  }
  return text;
}

std::string examples_section(const ManualCommand& command) {
  std::string text;
  for (const CommandExample& example : command.examples) {
    text += ".TP\n" + bold(example.call) + "\n" + roff(as_sentence(example.meaning)) + "\n";
  }
  return text.empty() ? text : ".SH EXAMPLES\n" + text;
}

std::string table(const char* title,
                  const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string text = std::string(".SH ") + title + "\n";
  for (const auto& [left, right] : rows)
    text += ".TP\n" + bold(left) + "\n" + roff(right) + "\n";
  return text;
}

std::string exit_section() {
  return table("EXIT STATUS",
               {{"0", "Done."},
                {"1", "The thing asked about has problems."},
                {"2", "The command line is wrong."},
                {"3", "The environment lacks something: a display, a device, a right."},
                {"4", "The program itself is at fault."}});
}

/// The sections on the program's page that apply to all commands.
std::string program_sections() {
  return table("ENVIRONMENT",
               {{"JND_SHARE",
                 "The folder of the shipped studies and data, with protocols and "
                 "data in it; without it share/jnd beside the program's folder."},
                {"JND_DEVICE_PATH", "Folders with drivers of devices, with colons between."},
                {"JND_DEVICE_HOST", "The program that runs drivers, jnd-device-host."},
                {"LANGUAGE, LC_ALL, LC_MESSAGES, LANG",
                 "The language of the window; messages of the command line are English."}}) +
         table(
             "FILES",
             {{"NAME.study",
               "A study: study.sqlite, in which every act is an event that is "
               "never changed, and recordings/ with every sample of the loop."},
              {"NAME.json", "What a study is; `jnd schema --markdown` explains every key."},
              {"NAME.device.json", "What was measured of a device, by `jnd commission`."},
              {"share/jnd/protocols, share/jnd/data",
               "Beside the program's folder: shipped studies, laboratories, published values."},
              {"lib/jnd/devices", "Beside the program's folder: drivers, found by name."},
              {"share/doc/jnd",
               "Beside the program's folder: README.md, the methods with "
               "their equations, and SAFETY.md for whoever answers for a "
               "hand in a device."}});
}

std::string see_also(const ManualCommand& command, const ManualCommand& root) {
  std::vector<std::string> names;
  if (const std::size_t space = command.name.rfind(' '); space != std::string::npos) {
    names.push_back(reference(command.name.substr(0, space)));
    for (const ManualCommand* other : all_commands(root)) {
      const bool is_sibling = other->name != command.name && other->name.rfind(' ') == space &&
                              other->name.starts_with(command.name.substr(0, space + 1));
      // The program has too many commands to name all of them.
      if (is_sibling && space > root.name.size()) names.push_back(reference(other->name));
    }
  }
  for (const ManualCommand& below : command.commands) names.push_back(reference(below.name));
  return fmt::format(".SH SEE ALSO\n{}\n", fmt::join(names, ",\n"));
}

}  // namespace

std::string manual_file_name(const ManualCommand& command) {
  return page_name(command.name) + ".1";
}

std::string manual_page(const ManualCommand& command, const ManualCommand& root,
                        const std::string& version) {
  const bool is_program = command.words().empty();
  std::string title = page_name(command.name);
  std::ranges::transform(title, title.begin(), [](char letter) {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  });
  // CLI11's description of the program begins with its name.
  std::string phrase = command.description;
  if (is_program && phrase.starts_with("jnd - ")) phrase = phrase.substr(6);
  std::string page =
      fmt::format(".TH {} 1 \"\" \"jnd {}\" \"jnd\"\n.ad l\n.nh\n", roff(title), roff(version));
  page += ".SH NAME\n" + roff(page_name(command.name)) + " \\- " + roff(phrase) + "\n";
  page += ".SH SYNOPSIS\n" + synopsis(command) + "\n";
  page += ".SH DESCRIPTION\n" + roff(as_sentence(phrase)) + "\n";
  if (is_program) {
    page += roff(
                "Without a command the window opens. Simulated hands and participants run "
                "whole studies without a device.") +
            "\n";
  }
  page += options_section(command, true) + options_section(command, false);
  page += commands_section(command) + examples_section(command) + exit_section();
  if (is_program) page += program_sections();
  return page + see_also(command, root);
}

}  // namespace jnd::app
