#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

namespace jnd::analysis {

// The words of results, charts and reports, in the language that a report is written in. Every
// sentence stands in the source in English, inside one of these functions, from where
// `./dev words` collects the catalogue (data/languages/jnd.pot). Unless somebody calls `speak`,
// words and numbers stay as they are written: in English, with decimal points. Names, JSON and
// tables of numbers never go through here. From any thread.

/// How results are told to people.
struct SpokenLanguage {
  std::string code = "en";  ///< As HTML has it: "de".
  /// A text in this language for one in English; the same pointer where there is none. What it
  /// returns has to stay valid for the program's life.
  const char* (*words)(const char* english) = nullptr;
  bool decimal_comma = false;  ///< Half is written "0,5".
};

/// Chooses the language of all words that follow; `{}` is English. While no other thread of the
/// program runs.
void speak(const SpokenLanguage& language);
[[nodiscard]] const SpokenLanguage& spoken();

/// These words in the language that is spoken.
[[nodiscard]] const char* said(const char* english);
/// Of words that are put together or come from a lower layer, where the catalogue has them.
[[nodiscard]] std::string said_of(const std::string& english);
/// A sentence of a lower layer with the words for its holes.
[[nodiscard]] std::string said_with(const char* english, const std::vector<std::string>& words);
/// Words of a table, which `said` gets when they are shown.
[[nodiscard]] constexpr const char* said_later(const char* english) noexcept { return english; }

/// A number's digits with the decimal sign of the language: "0,5" of "0.5".
[[nodiscard]] std::string with_decimal_sign(std::string digits);
/// Between numbers of a list: ", ", or "; " where numbers have commas themselves.
[[nodiscard]] const char* between_numbers();

namespace said_details {
[[nodiscard]] std::string filled(fmt::string_view english, fmt::format_args values);
}  // namespace said_details

/// A sentence with holes, which `fmt` fills. Its numbers with decimals are words already
/// (`number_words`). A translation whose holes do not fit is not used.
template <typename First, typename... Rest>
[[nodiscard]] std::string said(fmt::format_string<const First&, const Rest&...> english,
                               const First& first, const Rest&... rest) {
  return said_details::filled(english, fmt::make_format_args(first, rest...));
}

}  // namespace jnd::analysis
