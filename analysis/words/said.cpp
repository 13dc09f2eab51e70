#include "analysis/words/said.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>

namespace jnd::analysis {
namespace {

// This lists counted nouns, and words of lower layers and of names, which go through `said_of`.
// It puts them into the catalogue.
[[maybe_unused]] constexpr const char* kWordsOfOthers[] = {
    said_later("participant"),
    said_later("participants"),
    said_later("answer"),
    said_later("answers"),
    said_later("drawn trial"),
    said_later("drawn trials"),
    said_later("fit"),
    said_later("fits"),
    said_later("fraction"),
    said_later("fractions"),
    said_later("level"),
    said_later("levels"),
    said_later("pilot session"),
    said_later("pilot sessions"),
    said_later("repetition"),
    said_later("repetitions"),
    said_later("return"),
    said_later("returns"),
    said_later("session"),
    said_later("sessions"),
    said_later("staircase"),
    said_later("staircases"),
    said_later("stroke"),
    said_later("strokes"),
    said_later("trial"),
    said_later("trials"),
    said_later("value"),
    said_later("values"),
    said_later("density"),
    said_later("Weber fraction"),
    said_later("Weber fraction, median person"),
    said_later("PSE"),
    said_later("PSE, median person"),
    said_later("lapse rate"),
    said_later("slope sd"),
    // Titles of sections about the whole study, which follow from their names.
    said_later("As published"),
    said_later("Combined"),
    said_later("Exploratory"),
    said_later("Movement"),
    said_later("Practice"),
    said_later("Questionnaires"),
    said_later("Recorded movement"),
    said_later("Response times"),
    said_later("Unanswered"),
    // In the window, what a section tells of its block.
    said_later("intervals"),
    said_later("catch trials"),
    said_later("questions"),
    said_later("limits"),
    said_later("quest plus"),
};

SpokenLanguage& language_of_words() {
  static SpokenLanguage language;
  return language;
}

}  // namespace

void speak(const SpokenLanguage& language) { language_of_words() = language; }

const SpokenLanguage& spoken() { return language_of_words(); }

const char* said(const char* english) {
  const auto words = spoken().words;
  return words == nullptr || *english == '\0' ? english : words(english);
}

std::string said_of(const std::string& english) { return said(english.c_str()); }

std::string with_decimal_sign(std::string digits) {
  if (spoken().decimal_comma) std::ranges::replace(digits, '.', ',');
  return digits;
}

const char* between_numbers() { return spoken().decimal_comma ? "; " : ", "; }

std::string said_with(const char* english, const std::vector<std::string>& words) {
  fmt::dynamic_format_arg_store<fmt::format_context> values;
  for (const std::string& word : words) values.push_back(word);
  return said_details::filled(english, values);
}

std::string said_details::filled(fmt::string_view english, fmt::format_args values) {
  const char* const words = said(english.data());
  try {
    return fmt::vformat(words, values);
  } catch (const fmt::format_error&) {
    return fmt::vformat(english, values);
  }
}

}  // namespace jnd::analysis
