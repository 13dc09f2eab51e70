#include "app/language/words.h"

#include <fmt/format.h>
#include <libintl.h>

#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <iterator>

namespace jnd::app {
namespace {

constexpr const char* kDomain = "jnd";

/// Set before there is a second thread.
bool is_spoken = false;

/// The value of the first of these variables that has any; "" for none.
template <typename... Names>
std::string first_set(Names... names) {
  for (const char* name : {names...}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') return value;
  }
  return "";
}

/// With the locale "C" nothing is looked up. C.UTF-8 is one of every machine, and with it
/// LANGUAGE alone says which catalogue is read.
void choose_messages() {
  const std::string asked = first_set("LC_ALL", "LC_MESSAGES", "LANG");
  const bool is_installed = std::setlocale(LC_MESSAGES, "") != nullptr;
  if (is_installed && !asked.empty()) return;
  if (std::setlocale(LC_MESSAGES, "C.UTF-8") == nullptr) return;
  if (!asked.empty()) setenv("LANGUAGE", asked.c_str(), /*overwrite=*/0);
}

}  // namespace

bool begin_language(const std::filesystem::path& folder) {
  choose_messages();
  bindtextdomain(kDomain, folder.c_str());
  // Letters stay UTF-8 whatever the locale's are.
  bind_textdomain_codeset(kDomain, "UTF-8");
  // Under "" stands a catalogue's own description, without which there is none.
  is_spoken = *dgettext(kDomain, "") != '\0';
  // The system's own sentences then stay English, too.
  if (!is_spoken) std::setlocale(LC_MESSAGES, "C");
  return is_spoken;
}

bool writes_decimal_comma(std::string_view locale) noexcept {
  // Of the languages of Europe and Latin America that write one. Switzerland and Mexico do not.
  constexpr std::string_view kLanguages[] = {
      "af", "bg", "ca", "cs", "da", "de", "el", "es", "et", "eu", "fi", "fr",
      "gl", "hr", "hu", "id", "is", "it", "lt", "lv", "nb", "nl", "nn", "no",
      "pl", "pt", "ro", "ru", "sk", "sl", "sr", "sv", "tr", "uk", "vi"};
  const std::string_view language = locale.substr(0, locale.find_first_of("_.@"));
  const std::string_view whole = locale.substr(0, locale.find_first_of(".@"));
  if (whole.ends_with("_CH") || whole.ends_with("_MX")) return false;
  return std::ranges::find(kLanguages, language) != std::end(kLanguages);
}

bool writes_decimal_comma() noexcept {
  for (const char* name : {"LC_ALL", "LC_NUMERIC", "LANG"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0')
      return writes_decimal_comma(std::string_view(value));
  }
  return false;
}

const char* tr(const char* english) noexcept {
  // The words of "" would be the catalogue's description.
  return is_spoken && *english != '\0' ? dgettext(kDomain, english) : english;
}

namespace language_details {
namespace {

/// The translation where its holes fit what fills them; where not, it was not checked.
std::string filled_or(const char* words, const char* english, fmt::format_args values) {
  try {
    return fmt::vformat(words, values);
  } catch (const fmt::format_error&) {
    return fmt::vformat(english, values);
  }
}

}  // namespace

std::string filled(fmt::string_view english, fmt::format_args values) {
  return filled_or(tr(english.data()), english.data(), values);
}

std::string counted(fmt::string_view one, fmt::string_view many, std::int64_t count,
                    fmt::format_args values) {
  const char* english = count == 1 ? one.data() : many.data();
  const char* words =
      is_spoken ? dngettext(kDomain, one.data(), many.data(), static_cast<unsigned long>(count))
                : english;
  return filled_or(words, english, values);
}

}  // namespace language_details
}  // namespace jnd::app
