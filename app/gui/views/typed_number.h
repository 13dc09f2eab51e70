#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace jnd::app::gui {

/// A number as people write it: digits, one point, a minus; no exponent and nothing besides.
[[nodiscard]] inline std::optional<double> typed_number(std::string_view typed) noexcept {
  double value = 0.0;
  const char* end = typed.data() + typed.size();
  const auto [stopped, error] =
      std::from_chars(typed.data(), end, value, std::chars_format::fixed);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace jnd::app::gui
