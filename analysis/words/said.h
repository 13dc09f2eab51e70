#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

namespace jnd::analysis {

// Words of results, charts and reports, in the language of a report. Every sentence stands in
// the source in English inside one of these functions, from which `./dev words` collects the
// catalogue (data/languages/jnd.pot). Unless `speak` is called, words and numbers stay as they
// are written: in English, with decimal points. Names, JSON and tables of numbers never go
// through here. These functions may be called from any thread.

/// The language in which results are told to people.
struct SpokenLanguage {
  std::string code = "en";  ///< The code that HTML uses, such as "de".
  /// Returns the translation of an English text, or the same pointer if there is none. The
  /// result must stay valid until the program ends.
  const char* (*words)(const char* english) = nullptr;
  bool decimal_comma = false;  ///< Whether half is written "0,5".
};

/// Chooses the language of all words that follow; `{}` is English. No other thread of the
/// program may run meanwhile.
void speak(const SpokenLanguage& language);
[[nodiscard]] const SpokenLanguage& spoken();

/// The words in the chosen language.
[[nodiscard]] const char* said(const char* english);
/// The same for words that are composed or come from a lower layer, if the catalogue has them.
[[nodiscard]] std::string said_of(const std::string& english);
/// A sentence of a lower layer with the words for its holes.
[[nodiscard]] std::string said_with(const char* english, const std::vector<std::string>& words);
/// Words of a table, which `said` gets when they are shown.
[[nodiscard]] constexpr const char* said_later(const char* english) noexcept { return english; }

/// A number's digits with the decimal sign of the language, such as "0,5" for "0.5".
[[nodiscard]] std::string with_decimal_sign(std::string digits);
/// The separator in a list of numbers: ", ", or "; " if numbers have decimal commas.
[[nodiscard]] const char* between_numbers();

namespace said_details {
[[nodiscard]] std::string filled(fmt::string_view english, fmt::format_args values);
}  // namespace said_details

/// A sentence with placeholders, which `fmt` fills. Numbers with decimals must already be words
/// (`number_words`). A translation whose placeholders do not match is not used.
template <typename First, typename... Rest>
[[nodiscard]] std::string said(fmt::format_string<const First&, const Rest&...> english,
                               const First& first, const Rest&... rest) {
  return said_details::filled(english, fmt::make_format_args(first, rest...));
}

}  // namespace jnd::analysis
