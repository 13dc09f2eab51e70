#include "app/command_line/usage_message.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <limits>
#include <optional>
#include <regex>
#include <vector>

#include "app/command_line/command.h"
#include "experiments/study/study_problem.h"

namespace jnd::app {
namespace {

/// The subcommand that was asked for, and its words, such as "fit weber".
struct Asked {
  const CLI::App* app = nullptr;
  std::string words;
};

Asked asked_of(const CLI::App& program) {
  Asked asked{&program, ""};
  while (!asked.app->get_subcommands().empty()) {
    asked.app = asked.app->get_subcommands().front();
    asked.words += (asked.words.empty() ? "" : " ") + asked.app->get_name();
  }
  return asked;
}

/// The words as alternatives, such as "a, b or c".
std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  std::size_t from = 0;
  for (std::size_t to = 0; to != std::string::npos; from = to + 1) {
    to = list.find(',', from);
    words.push_back(list.substr(from, to - from));
  }
  return words;
}

std::vector<std::string> subcommands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* one : app.get_subcommands({})) names.push_back(one->get_name());
  return names;
}

std::string unknown_word(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  std::string expected = "no further word";
  if (word.starts_with("-")) {
    expected = "an option that it has";
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
  } else if (known = subcommands_of(app); !known.empty()) {
    expected = "a subcommand";
  }
  return fmt::format("expected {}, found `{}`{}", expected, word,
                     experiments::did_you_mean(word, known));
}

/// What kind of value the option takes, such as "a whole number".
std::string kind_of(const CLI::App& app, const std::string& name) {
  const CLI::Option* option = app.get_option_no_throw(name);
  if (option == nullptr) return "a number";
  const std::string type = option->get_type_name();
  if (type.starts_with("INT") || type.starts_with("UINT")) return "a whole number";
  if (type.starts_with("FLOAT")) return "a number";
  return option->get_items_expected_max() == 0 ? "no value" : "a value that fits";
}

std::string range(const std::string& low, const std::string& high) {
  const double from = std::strtod(low.c_str(), nullptr);
  const double to = std::strtod(high.c_str(), nullptr);
  if (to >= std::numeric_limits<double>::max()) return fmt::format(">= {:.10g}", from);
  return fmt::format("from {:.10g} to {:.10g}", from, to);
}

/// The part after "--name: " in our words; none if CLI11's form is not known here.
std::optional<std::string> translated(const CLI::App& app, const std::string& name,
                                      const std::string& detail) {
  // CLI11 tells the reason only as text. [^] matches any character, including a line end.
  static const std::regex kRange("Value ([^]*) not in range (\\S+) to (\\S+)");
  static const std::regex kMember("([^]*) not in \\{([^}]*)\\}");
  static const std::regex kAbsent("(Directory|File) does not exist: ([^]*)");
  static const std::regex kOther("(Directory|File) is actually a (?:file|directory): ([^]*)");
  static const std::regex kTwice("At Most (\\d+) required but received (\\d+)");
  static const std::regex kLacking("(\\d+) required [^]* missing");
  std::smatch match;
  if (detail.starts_with("expected")) return detail;
  if (std::regex_match(detail, match, kRange)) {
    return fmt::format("expected {} {}, found `{}`", kind_of(app, name),
                       range(match[2], match[3]), match[1].str());
  }
  if (std::regex_match(detail, match, kMember)) {
    const std::vector<std::string> words = split(match[2]);
    return fmt::format("expected {}, found `{}`{}", alternatives(words), match[1].str(),
                       experiments::did_you_mean(match[1].str(), words));
  }
  if (std::regex_match(detail, match, kAbsent)) {
    return fmt::format("expected a {}, found nothing named `{}`",
                       match[1] == "File" ? "file" : "folder", match[2].str());
  }
  if (std::regex_match(detail, match, kOther)) {
    return fmt::format("expected a {1}, found that `{0}` is a {2}", match[2].str(),
                       match[1] == "File" ? "file" : "folder",
                       match[1] == "File" ? "folder" : "file");
  }
  if (std::regex_match(detail, match, kTwice)) {
    return fmt::format("expected it {}, found it {} times",
                       match[1] == "1" ? "once" : "at most " + match[1].str() + " times",
                       match[2].str());
  }
  if (std::regex_match(detail, match, kLacking)) {
    return "expected a value after it, found none";
  }
  return std::nullopt;
}

std::string sentence(const CLI::App& app, const CLI::ParseError& error) {
  const std::string text = error.what();
  static const std::regex kRequired("([^]*) is required");
  static const std::regex kConversion("Could not convert: (\\S+) = ([^]*)");
  static const std::regex kNamed("([^:\\s]+): ([^]*)");
  std::smatch match;
  if (text == "A subcommand is required") {
    return "expected " + alternatives(subcommands_of(app)) + ", found none of them";
  }
  if (std::regex_match(text, match, kRequired)) {
    return fmt::format("expected {}, found none", match[1].str());
  }
  if (std::regex_match(text, match, kConversion)) {
    return fmt::format("{}: expected {}, found `{}`", match[1].str(), kind_of(app, match[1]),
                       match[2].str());
  }
  if (std::regex_match(text, match, kNamed)) {
    if (const auto detail = translated(app, match[1], match[2])) {
      return match[1].str() + ": " + *detail;
    }
  }
  return "expected words that fit, found this wrong: " + text;
}

}  // namespace

std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const Asked asked = asked_of(program);
  // A misspelt option is also a missing one; the misspelling is the cause.
  const std::vector<std::string> unknown = program.remaining(true);
  std::string message = asked.words.empty() ? "" : asked.words + ": ";
  message +=
      unknown.empty() ? sentence(*asked.app, error) : unknown_word(*asked.app, unknown.front());
  if (message.find("; ") == std::string::npos) {
    message +=
        fmt::format("; see `jnd {}{}--help`", asked.words, asked.words.empty() ? "" : " ");
  }
  return one_line(message);
}

void refuse_options_as_values(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_items_expected_max() == 0) continue;
      for (const std::string& value : option->results()) {
        if (!value.starts_with("--") || command->get_option_no_throw(value) == nullptr)
          continue;
        throw UsageError(option->get_name() + ": expected a value, found the option `" + value +
                         "`; write a value after it, or leave it away");
      }
    }
    refuse_options_as_values(*command);
  }
}

std::string one_line(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20) letter = '?';
  }
  return text;
}

}  // namespace jnd::app
