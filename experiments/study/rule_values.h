#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"
#include "experiments/study/shown_text.h"

namespace jnd::experiments {

// Functions by which rules read values. They treat a value of the wrong type as absent, because
// `StructureCheck` has reported it already.

/// Returns the text at `key`, or "".
[[nodiscard]] inline std::string word(const nlohmann::json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Returns the number at `key`, or null.
[[nodiscard]] inline const nlohmann::json* number(const nlohmann::json& object,
                                                  const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? &*found : nullptr;
}

[[nodiscard]] inline double number_or(const nlohmann::json& object, const std::string& key,
                                      double otherwise) {
  const nlohmann::json* found = number(object, key);
  return found == nullptr ? otherwise : found->get<double>();
}

/// Returns a number within the range of its table, or `otherwise`.
[[nodiscard]] inline double sound_number(const ParameterTable& table,
                                         const nlohmann::json& object, const std::string& key,
                                         double otherwise) {
  const Parameter* parameter = table.find(key);
  const double value = number_or(object, key, otherwise);
  return parameter != nullptr && parameter->range.contains(value) ? value : otherwise;
}

/// Returns the list at `key`, or an empty one.
[[nodiscard]] inline const nlohmann::json& list(const nlohmann::json& object,
                                                const std::string& key) {
  static const nlohmann::json kNone = nlohmann::json::array();
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : kNone;
}

/// Returns the key of a block's standards: "standard_scale". Without a standard it is a key
/// that no block has.
[[nodiscard]] inline std::string standard_key(const nlohmann::json& block) {
  return "standard_" + quantity_of(word(block, "standard_medium"));
}

/// Returns how often a block shows each of its stimuli in a repetition: once for every target
/// of a production, and once for every standard of a matching.
[[nodiscard]] inline double num_showings(const nlohmann::json& block) {
  const std::size_t num_targets = list(block, "target_percent").size();
  const std::size_t num_standards = list(block, standard_key(block)).size();
  return static_cast<double>(std::max<std::size_t>(1, num_targets) *
                             std::max<std::size_t>(1, num_standards));
}

/// Returns the object at `key`, or an empty one.
[[nodiscard]] inline const nlohmann::json& object_at(const nlohmann::json& object,
                                                     const std::string& key) {
  static const nlohmann::json kNone = nlohmann::json::object();
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? *found : kNone;
}

/// Returns names as a message lists them: shortened, and only the first of very many.
[[nodiscard]] inline std::string names_words(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < names.size() && i < kMost; ++i) {
    shown.push_back(shown_text(names[i], 30));
  }
  return one_of_words(shown) + (names.size() > kMost ? " ..." : "");
}

}  // namespace jnd::experiments
