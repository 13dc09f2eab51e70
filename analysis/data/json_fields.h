#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace jnd::analysis {

// What the stored data of events hold: whatever is missing or of another type is as good as
// empty. `Json` is nlohmann's, its keys in whichever order.

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

}  // namespace jnd::analysis
