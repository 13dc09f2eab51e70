#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "app/language/words.h"

namespace jnd::app::gui {

/// A number as people write it: digits, one point, a minus; no exponent and nothing besides.
/// Where half is written "0,5" a comma is one, too; elsewhere it might mean thousands, and is
/// none.
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

/// What is typed and is a number, as a study keeps it: with a point.
[[nodiscard]] inline std::string with_point(std::string typed) {
  const std::size_t comma = typed.find(',');
  if (comma != std::string::npos) typed[comma] = '.';
  return typed;
}

/// Nothing that anybody could read.
[[nodiscard]] inline bool is_blank(std::string_view typed) noexcept {
  return typed.find_first_not_of(" \t\n") == std::string_view::npos;
}

}  // namespace jnd::app::gui
