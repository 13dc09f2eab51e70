#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "analysis/statistics/fit_status.h"

/// What numbers and words of fits are in JSON.
namespace jnd::analysis::json_values {

using Json = nlohmann::ordered_json;

/// null for none and for what is not finite.
inline Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

/// [low, high], null where an end is open.
inline Json interval(const Interval& ends) {
  return Json::array({number(ends.low), number(ends.high)});
}

/// null for an empty text.
inline Json sentence(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

}  // namespace jnd::analysis::json_values
