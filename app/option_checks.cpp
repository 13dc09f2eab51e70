#include "app/option_checks.h"

#include <fmt/format.h>

#include <charconv>

namespace jnd::app {

CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest) {
  const auto check = [lowest, highest](std::string& text) -> std::string {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (text.empty() || stop != end || error != std::errc() || value < lowest ||
        value > highest) {
      return fmt::format("expected a whole number from {} to {}, found `{}`", lowest, highest,
                         text);
    }
    text = std::to_string(value);  // CLI11 would read leading zeros as octal.
    return "";
  };
  return {check, fmt::format("{} to {}", lowest, highest), "whole number"};
}

CLI::Validator number_between(double lowest, double highest) {
  const auto check = [lowest, highest](std::string& text) -> std::string {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (!text.empty() && stop == end && error == std::errc() && value >= lowest &&
        value <= highest) {
      return "";
    }
    return fmt::format("expected a number from {:g} to {:g}, found `{}`", lowest, highest,
                       text);
  };
  return {check, fmt::format("{:g} to {:g}", lowest, highest), "number"};
}

}  // namespace jnd::app
