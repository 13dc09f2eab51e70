#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "analysis/fits/bounded_interval.h"

namespace jnd::app {

/// A number of a fit as people read it; "-" if it does not exist.
[[nodiscard]] inline std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

/// Such as "p = 0.031". Nothing that was observed is impossible, so 0 means a number that is
/// too small for a double.
[[nodiscard]] inline std::string p_value_words(const std::optional<double>& p_value) {
  return p_value == 0.0 ? "p < 1e-300" : "p = " + number(p_value);
}

/// Such as "0.32 to 1.6"; if the data leave an end open, words say it.
[[nodiscard]] inline std::string whole_range(const analysis::Interval& interval) {
  if (!interval.low && !interval.high) return analysis::kNotBounded;
  const auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : std::string("open");
  };
  const bool open = !interval.low || !interval.high;
  return end(interval.low) + " to " + end(interval.high) +
         (open ? std::string(" (") + analysis::kNotBounded + ")" : "");
}

/// The same interval around the estimate; an end far beyond the estimate counts as open.
[[nodiscard]] inline std::string range(const analysis::Interval& whole,
                                       const std::optional<double>& estimate) {
  return whole_range(analysis::bounded_by_data(whole, estimate));
}

/// True if a standard error is only the rounding error of zero.
[[nodiscard]] inline bool is_exact(const std::optional<double>& standard_error,
                                   const std::optional<double>& estimate) {
  return standard_error && estimate && *standard_error <= 1e-9 * std::fabs(*estimate);
}

/// Such as "95 % 0.32 to 1.6, standard error 0.3"; if there can be no interval, `why_none`.
[[nodiscard]] inline std::string uncertainty(const analysis::Interval& interval,
                                             const std::optional<double>& estimate,
                                             const std::optional<double>& standard_error,
                                             const std::string& why_none) {
  const bool told = standard_error && !is_exact(standard_error, estimate);
  const std::string error = told ? ", standard error " + number(standard_error) : "";
  return (why_none.empty() ? "95 % " + range(interval, estimate) : "no interval: " + why_none) +
         error;
}

/// A group's value, such as "x"; "(empty)" for an empty cell.
[[nodiscard]] inline std::string group_words(const std::string& value) {
  return value.empty() ? "(empty)" : value;
}

}  // namespace jnd::app
