#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "analysis/statistics/fit_status.h"

/// Converts numbers and words of fits to JSON.
namespace jnd::analysis::json_values {

using Json = nlohmann::ordered_json;

/// The number, or null if it is absent or not finite.
inline Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

/// [low, high], with null for an open end.
inline Json interval(const Interval& ends) {
  return Json::array({number(ends.low), number(ends.high)});
}

/// The text, or null if it is empty.
inline Json sentence(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

}  // namespace jnd::analysis::json_values
