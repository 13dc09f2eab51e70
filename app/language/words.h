#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

// The words of the window, in the language of the person who looks at it. Every sentence that
// the window shows is in the source in English, inside one of these functions, from which
// `./dev words` collects the catalogue (data/languages/jnd.pot). After `begin_language` has
// chosen a language, the functions look its words up; before that, and on the command line,
// words stay as they are written. Any thread may call them.
//
// What goes into a study, an export or an error of the command line is not among the window's
// words: it is the same in every language, and `as_is` marks it.

/// These words in the chosen language, or unchanged if it has none for them. The result is
/// valid for the program's life, as `english` has to be.
[[nodiscard]] const char* tr(const char* english) noexcept;

/// Marks words of a table, which are given to `tr` when they are shown.
[[nodiscard]] constexpr const char* tr_later(const char* english) noexcept { return english; }

/// Marks words that do not belong to the window and stay as they are, such as those of a
/// study's log or a participant's words.
[[nodiscard]] constexpr const char* as_is(const char* english) noexcept { return english; }

namespace language_details {

// English sentences whose holes the compiler has checked against the values.
[[nodiscard]] std::string filled(fmt::string_view english, fmt::format_args values);
[[nodiscard]] std::string counted(fmt::string_view one, fmt::string_view many,
                                  std::int64_t count, fmt::format_args values);

}  // namespace language_details

/// A sentence with holes that `fmt` fills: tr("Trial {} of {}", 3, 40). A translation may fill
/// them in another order ("{1}, {0}"); a translation whose holes do not fit is not used.
template <typename First, typename... Rest>
[[nodiscard]] std::string tr(fmt::format_string<const First&, const Rest&...> english,
                             const First& first, const Rest&... rest) {
  return language_details::filled(english, fmt::make_format_args(first, rest...));
}

/// A sentence about a number of things, in the form that the language has for this number. The
/// count is the first value: trn("{} trial of {}", "{} trials of {}", 1, 40).
template <typename... Rest>
[[nodiscard]] std::string trn(fmt::format_string<const std::int64_t&, const Rest&...> one,
                              fmt::format_string<const std::int64_t&, const Rest&...> many,
                              std::int64_t count, const Rest&... rest) {
  return language_details::counted(one, many, count, fmt::make_format_args(count, rest...));
}

/// Chooses the language of everything that follows, among the catalogues
/// FOLDER/LANGUAGE/LC_MESSAGES/jnd.mo. `chosen` is a code such as "de", or "en" for English; if
/// it is "", LC_ALL, LC_MESSAGES, LANG and LANGUAGE decide, as for every program. The
/// language's locale need not be installed. Numbers keep the locale's form, because only
/// messages are set. Returns true if there are words of another language than English. It may
/// be called again while no other thread of the program runs; words that `tr` returned before
/// stay valid.
bool begin_language(const std::filesystem::path& folder, const std::string& chosen = "");

/// A language of the window.
struct Language {
  std::string code;  ///< The code, such as "de".
  std::string name;  ///< The name in the language itself, such as "Deutsch".

  friend bool operator==(const Language&, const Language&) = default;
};

/// English, and each language that has a catalogue in this folder, by their names. A catalogue
/// gives the name of its language as `X-Language-Name`; without that, the language is called by
/// its code.
[[nodiscard]] std::vector<Language> languages_in(const std::filesystem::path& folder);

/// The code of the language that `begin_language` has chosen; "en" if there are no other words.
[[nodiscard]] std::string spoken_language();

/// True if people with this locale, such as "de_DE.UTF-8", write a half as "0,5". A locale of
/// that name need not be installed.
[[nodiscard]] bool writes_decimal_comma(std::string_view locale) noexcept;
/// Says how typed numbers are read: by the first of LC_ALL, LC_NUMERIC and LANG that is set,
/// and also by the chosen language if it differs from theirs.
[[nodiscard]] bool writes_decimal_comma() noexcept;

/// The typed text with points for decimal commas ("0,5" becomes "0.5"), if a half is written
/// so. A comma between two digits is decimal, unless the text contains a point; then commas
/// separate numbers.
[[nodiscard]] std::string with_decimal_points(std::string typed,
                                              bool takes_comma = writes_decimal_comma());

}  // namespace jnd::app
