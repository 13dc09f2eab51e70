#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace jnd::app {

/// A document as it is printed. Names of files and cells of tables may not be UTF-8; such text
/// is replaced, so that the output is always valid JSON.
template <typename Json>
[[nodiscard]] std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace);
}

/// A calculated number without the rounding errors of its last bits: 2.4864, not
/// 2.4863999999999997.
[[nodiscard]] inline double to_decimals(double value, int num_decimals) noexcept {
  const double scale = std::pow(10.0, num_decimals);
  const double scaled = value * scale;
  constexpr double kLargestWhole = 4503599627370496.0;  // 2^52
  return std::abs(scaled) < kLargestWhole ? std::round(scaled) / scale : value;
}

}  // namespace jnd::app
