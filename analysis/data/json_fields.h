#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace jnd::analysis {

// What stored JSON holds, study files and the data of events: whatever is missing or of another
// type is as good as empty. `Json` is nlohmann's, its keys in whichever order.

/// The object that this text is; an empty one for any other.
template <typename Json = nlohmann::json>
[[nodiscard]] Json object_in(const std::string& text) {
  Json value = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  return value.is_object() ? value : Json::object();
}

template <typename Json>
[[nodiscard]] std::string string_at(const Json& object, const char* key,
                                    const std::string& otherwise = "") {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->template get<std::string>()
                                                     : otherwise;
}

/// A text of a study file: one string, or in English of several languages, or in the first.
template <typename Json>
[[nodiscard]] std::string text_at(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_object()) return string_at(object, key);
  if (found->contains("en")) return string_at(*found, "en");
  for (const auto& [language, words] : found->items()) {
    if (language != "comment") return string_at(*found, language.c_str());
  }
  return "";
}

}  // namespace jnd::analysis
