#include "app/language/words.h"

#include <fmt/format.h>
#include <libintl.h>

#include <algorithm>
#include <cctype>
#include <clocale>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDomain = "jnd";
constexpr const char* kEnglish = "en";

// Set while there is no second thread.
bool is_spoken = false;
std::string spoken = kEnglish;

/// The value of the first of these variables that is set and not empty; "" if there is none.
template <typename... Names>
std::string first_set(Names... names) {
  for (const char* name : {names...}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') return value;
  }
  return "";
}

/// Sets the locale of messages. With the locale "C", nothing is looked up. C.UTF-8 exists on
/// every machine, and with it LANGUAGE alone decides which catalogue is read.
void choose_messages(const std::string& chosen) {
  if (!chosen.empty()) {
    // gettext looks for catalogues again only if the locale changes.
    std::setlocale(LC_MESSAGES, "C");
    setenv("LANGUAGE", chosen.c_str(), /*overwrite=*/1);
    if (chosen != kEnglish) std::setlocale(LC_MESSAGES, "C.UTF-8");
    return;
  }
  const std::string asked = first_set("LC_ALL", "LC_MESSAGES", "LANG");
  const bool is_installed = std::setlocale(LC_MESSAGES, "") != nullptr;
  if (is_installed && !asked.empty()) return;
  if (std::setlocale(LC_MESSAGES, "C.UTF-8") == nullptr) return;
  if (asked.empty()) return;
  const char* const wanted = std::getenv("LANGUAGE");
  if (wanted == nullptr || *wanted == '\0') setenv("LANGUAGE", asked.c_str(), /*overwrite=*/1);
}

/// The value of a line "NAME: VALUE" in a catalogue's description; "" if there is none.
std::string field_of(std::string_view description, std::string_view name) {
  while (!description.empty()) {
    const std::string_view line = description.substr(0, description.find('\n'));
    description.remove_prefix(std::min(line.size() + 1, description.size()));
    if (!line.starts_with(name) || !line.substr(name.size()).starts_with(": ")) continue;
    return std::string(line.substr(name.size() + 2));
  }
  return "";
}

/// The description of a compiled catalogue, which is the translation of the empty text, the
/// first text of all. "" for any other file. See gettext's manual, "The Format of GNU MO
/// Files".
std::string description_of(const fs::path& catalogue) {
  std::ifstream stream(catalogue, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const auto number_at = [&](std::size_t place) -> std::size_t {
    std::uint32_t number = 0;
    if (place + sizeof number <= bytes.size()) {
      std::memcpy(&number, bytes.data() + place, sizeof number);
    }
    return number;
  };
  constexpr std::size_t kMagic = 0x950412de;
  if (number_at(0) != kMagic) return "";
  const std::size_t translations = number_at(16);
  const std::size_t length = number_at(translations), place = number_at(translations + 4);
  if (place > bytes.size() || length > bytes.size() - place) return "";
  return bytes.substr(place, length);
}

std::string_view language_of(std::string_view locale) {
  return locale.substr(0, locale.find_first_of("_.@"));
}

}  // namespace

bool begin_language(const fs::path& folder, const std::string& chosen) {
  choose_messages(chosen);
  bindtextdomain(kDomain, folder.c_str());
  // Letters are UTF-8 whatever the locale's encoding is.
  bind_textdomain_codeset(kDomain, "UTF-8");
  // The translation of "" is a catalogue's own description; if there is none, there is no
  // catalogue.
  const std::string description = dgettext(kDomain, "");
  is_spoken = !description.empty();
  spoken = is_spoken ? field_of(description, "Language") : kEnglish;
  // Then the system's own sentences stay English, too.
  if (!is_spoken) std::setlocale(LC_MESSAGES, "C");
  return is_spoken;
}

std::vector<Language> languages_in(const fs::path& folder) {
  std::vector<Language> all = {{kEnglish, "English"}};
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string description =
        description_of(entry.path() / "LC_MESSAGES" / (std::string(kDomain) + ".mo"));
    if (description.empty()) continue;
    const std::string code = entry.path().filename().string();
    const std::string name = field_of(description, "X-Language-Name");
    all.push_back({code, name.empty() ? code : name});
  }
  std::ranges::sort(all, {}, &Language::name);
  return all;
}

std::string spoken_language() { return spoken; }

bool writes_decimal_comma(std::string_view locale) noexcept {
  // Languages of Europe and Latin America, and some others, that write a decimal comma.
  // Switzerland and Mexico do not.
  constexpr std::string_view kLanguages[] = {
      "af", "bg", "ca", "cs", "da", "de", "el", "es", "et", "eu", "fi", "fr",
      "gl", "hr", "hu", "id", "is", "it", "lt", "lv", "nb", "nl", "nn", "no",
      "pl", "pt", "ro", "ru", "sk", "sl", "sr", "sv", "tr", "uk", "vi"};
  const std::string_view language = language_of(locale);
  const std::string_view whole = locale.substr(0, locale.find_first_of(".@"));
  if (whole.ends_with("_CH") || whole.ends_with("_MX")) return false;
  return std::ranges::find(kLanguages, language) != std::end(kLanguages);
}

bool writes_decimal_comma() noexcept {
  std::string_view locale;
  for (const char* name : {"LC_ALL", "LC_NUMERIC", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    locale = value;
    break;
  }
  if (writes_decimal_comma(locale)) return true;
  // In Switzerland numbers have a point, and the window's words are German.
  return is_spoken && language_of(locale) != language_of(spoken) &&
         writes_decimal_comma(spoken);
}

std::string with_decimal_points(std::string typed, bool takes_comma) {
  if (!takes_comma || typed.find('.') != std::string::npos) return typed;
  const auto is_digit_at = [&](std::size_t place) {
    return place < typed.size() && std::isdigit(static_cast<unsigned char>(typed[place])) != 0;
  };
  for (std::size_t i = 1; i < typed.size(); ++i) {
    if (typed[i] == ',' && is_digit_at(i - 1) && is_digit_at(i + 1)) typed[i] = '.';
  }
  return typed;
}

const char* tr(const char* english) noexcept {
  // The translation of "" would be the catalogue's description.
  return is_spoken && *english != '\0' ? dgettext(kDomain, english) : english;
}

namespace language_details {
namespace {

/// The translation, if its holes fit the values. If not, it was not checked, and the English
/// words are used.
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
