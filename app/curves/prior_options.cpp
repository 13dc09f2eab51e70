#include "app/curves/prior_options.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "app/command_line/command.h"

namespace jnd::app {
namespace {

std::optional<double> prior_parameter(std::string_view digits, double largest) {
  double value = 0.0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  const bool is_number = !digits.empty() && stop == end && error == std::errc();
  return is_number && value >= 1.0 && value <= largest ? std::optional(value) : std::nullopt;
}

}  // namespace

analysis::BetaPrior beta_prior_of(const std::string& option, const std::string& text,
                                  double largest) {
  const std::string_view whole = text;
  const std::size_t comma = whole.find(',');
  const std::optional<double> a = prior_parameter(whole.substr(0, comma), largest);
  const std::optional<double> b = comma == std::string_view::npos
                                      ? std::nullopt
                                      : prior_parameter(whole.substr(comma + 1), largest);
  if (a && b) return {*a, *b};
  throw UsageError(fmt::format(
      "{}: expected two numbers A,B from 1 to {:.0f} such as 1,20, found `{}`; below "
      "1 the density of Beta(A, B) has no bound",
      option, largest, text));
}

std::string prior_weight_words(double weight) {
  return weight == 0.0  ? "without it"
         : weight < 1.0 ? "at half its weight"
                        : "at twice its weight";
}

}  // namespace jnd::app
