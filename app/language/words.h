#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

// The words of the window, in the language of whoever looks at it. Every sentence that the
// window shows stands in the source in English, inside one of these functions, from where
// `./dev words` collects the catalogue (data/languages/jnd.pot). Where a language is spoken
// (`begin_language`), they look its words up; before, and on the command line, words stay as
// they are written. From any thread.
//
// What goes into a study, an export or an error of the command line is none of the window's
// words: it is the same everywhere, and `as_is` says so.

/// These words in the language that is spoken; themselves where it has none for them. Stays
/// valid for the program's life, as `english` has to.
[[nodiscard]] const char* tr(const char* english) noexcept;

/// Words of a table, which `tr` gets when they are shown.
[[nodiscard]] constexpr const char* tr_later(const char* english) noexcept { return english; }

/// Words that are not the window's and stay as they are: of a study's log, or a participant's.
[[nodiscard]] constexpr const char* as_is(const char* english) noexcept { return english; }

namespace language_details {

// English as the compiler has checked it against what fills it.
[[nodiscard]] std::string filled(fmt::string_view english, fmt::format_args values);
[[nodiscard]] std::string counted(fmt::string_view one, fmt::string_view many,
                                  std::int64_t count, fmt::format_args values);

}  // namespace language_details

/// A sentence with holes, `fmt` fills them: tr("Trial {} of {}", 3, 40). A translation may fill
/// them in another order ("{1}, {0}"); one whose holes do not fit is not used.
template <typename First, typename... Rest>
[[nodiscard]] std::string tr(fmt::format_string<const First&, const Rest&...> english,
                             const First& first, const Rest&... rest) {
  return language_details::filled(english, fmt::make_format_args(first, rest...));
}

/// A sentence about so many things, in the form that the language has for their number. The
/// count is the first value: trn("{} trial of {}", "{} trials of {}", 1, 40).
template <typename... Rest>
[[nodiscard]] std::string trn(fmt::format_string<const std::int64_t&, const Rest&...> one,
                              fmt::format_string<const std::int64_t&, const Rest&...> many,
                              std::int64_t count, const Rest&... rest) {
  return language_details::counted(one, many, count, fmt::make_format_args(count, rest...));
}

/// Chooses the language of all that follows among the catalogues
/// FOLDER/LANGUAGE/LC_MESSAGES/jnd.mo: the one of this code ("de"; "en" is English), or, where
/// it is "", by LC_ALL, LC_MESSAGES, LANG and LANGUAGE, as every program does. Needs no locale
/// of that language to be installed. Numbers stay as they are: of the locale, messages alone
/// are set. Returns whether there are words of another language than English. It may be called
/// again, while no other thread of the program runs; words that `tr` gave before stay valid.
bool begin_language(const std::filesystem::path& folder, const std::string& chosen = "");

/// A language of the window.
struct Language {
  std::string code;  ///< "de"
  std::string name;  ///< As those who speak it call it: "Deutsch".

  friend bool operator==(const Language&, const Language&) = default;
};

/// English, and each language that has a catalogue in this folder, by their names. A catalogue
/// says the name of its language as `X-Language-Name`; one that does not is called by its code.
[[nodiscard]] std::vector<Language> languages_in(const std::filesystem::path& folder);

/// The code of the language that is spoken since `begin_language`: "en" where there are no
/// other words.
[[nodiscard]] std::string spoken_language();

/// Who writes numbers by this locale ("de_DE.UTF-8") writes half as "0,5". Needs no locale of
/// that name to be installed.
[[nodiscard]] bool writes_decimal_comma(std::string_view locale) noexcept;
/// The same by LC_ALL, LC_NUMERIC or LANG, the first of them that says anything, and besides by
/// the language that is spoken, where that is another one than theirs: how numbers that are
/// typed are read.
[[nodiscard]] bool writes_decimal_comma() noexcept;

/// What is typed, with points for decimal commas ("0,5" is "0.5"), where half is written so. A
/// comma between two digits is one, unless a point stands in the text: then commas are between
/// numbers.
[[nodiscard]] std::string with_decimal_points(std::string typed,
                                              bool takes_comma = writes_decimal_comma());

}  // namespace jnd::app
