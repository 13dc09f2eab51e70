#include "app/command_line/option_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "app/command_line/rate_text.h"

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
    // CLI11 would read leading zeros as octal.
    text = std::to_string(value);
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

CLI::Validator rate(const std::vector<std::string>& words) {
  const auto check = [words](std::string& text) -> std::string {
    if (std::ranges::find(words, text) != words.end()) return "";
    if (const std::optional<double> value = rate_of(text)) {
      text = fmt::format("{}", *value);
      return "";
    }
    return fmt::format("expected a rate from 0 to below 1, such as 0.5 or 1/3{}{}, found `{}`",
                       words.empty() ? "" : ", or ", fmt::join(words, " or "), text);
  };
  return {check, "rate", "rate"};
}

}  // namespace jnd::app
