#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "app/language/words.h"

namespace jnd::app::gui {

/// Reads a number as people write it: digits, one point and a minus, but no exponent and
/// nothing else. In languages that write a half as "0,5", a comma is a point, too; elsewhere a
/// comma might mean thousands, and then it is no number.
[[nodiscard]] inline std::optional<double> typed_number(
    std::string_view typed, bool takes_comma = writes_decimal_comma()) {
  std::string written(typed);
  if (takes_comma && written.find('.') == std::string::npos) {
    const std::size_t comma = written.find(',');
    if (comma != std::string::npos) written[comma] = '.';
  }
  double value = 0.0;
  const char* end = written.data() + written.size();
  const auto [stopped, error] =
      std::from_chars(written.data(), end, value, std::chars_format::fixed);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Returns a typed number in the form in which a study stores it: with a point instead of a
/// comma.
[[nodiscard]] inline std::string with_point(std::string typed) {
  const std::size_t comma = typed.find(',');
  if (comma != std::string::npos) typed[comma] = '.';
  return typed;
}

/// True if the text is empty or consists of white space only.
[[nodiscard]] inline bool is_blank(std::string_view typed) noexcept {
  return typed.find_first_not_of(" \t\n") == std::string_view::npos;
}

}  // namespace jnd::app::gui
