#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace jnd::analysis {

// Reads the stored data of events. What is missing or has another type counts as empty. `Json`
// is a type of nlohmann::json, with its keys in any order.

/// The object in this text; an empty object for anything else.
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

}  // namespace jnd::analysis
