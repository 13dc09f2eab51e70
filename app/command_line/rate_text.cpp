#include "app/command_line/rate_text.h"

#include <charconv>

namespace jnd::app {

std::optional<double> rate_of(std::string_view text) noexcept {
  const auto number = [](std::string_view digits) -> std::optional<double> {
    double value = 0.0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    const bool whole = !digits.empty() && stop == end && error == std::errc();
    return whole && value >= 0.0 ? std::optional(value) : std::nullopt;
  };
  const std::size_t slash = text.find('/');
  const std::optional<double> above = number(text.substr(0, slash));
  const std::optional<double> below =
      slash == std::string_view::npos ? 1.0 : number(text.substr(slash + 1));
  if (!above || !below || !(*above < *below)) return std::nullopt;
  return *above / *below;
}

}  // namespace jnd::app
