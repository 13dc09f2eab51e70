#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "analysis/fits/bounded_interval.h"

namespace jnd::app {

/// Numbers of a fit as people read them; "-" for one that does not exist.
[[nodiscard]] inline std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

/// "p = 0.031"; nothing that was observed is impossible, so 0 is less than there are numbers
/// for.
[[nodiscard]] inline std::string p_value_words(const std::optional<double>& p_value) {
  return p_value == 0.0 ? "p < 1e-300" : "p = " + number(p_value);
}

/// "0.32 to 1.6", an end that the data leave open in words.
[[nodiscard]] inline std::string whole_range(const analysis::Interval& interval) {
  if (!interval.low && !interval.high) return analysis::kNotBounded;
  const auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : std::string("open");
  };
  const bool open = !interval.low || !interval.high;
  return end(interval.low) + " to " + end(interval.high) +
         (open ? std::string(" (") + analysis::kNotBounded + ")" : "");
}

/// The same about the estimate, an end that is far beyond it being open.
[[nodiscard]] inline std::string range(const analysis::Interval& whole,
                                       const std::optional<double>& estimate) {
  return whole_range(analysis::bounded_by_data(whole, estimate));
}

/// Whether a standard error is only what rounding leaves of none.
[[nodiscard]] inline bool is_exact(const std::optional<double>& standard_error,
                                   const std::optional<double>& estimate) {
  return standard_error && estimate && *standard_error <= 1e-9 * std::fabs(*estimate);
}

/// "95 % 0.32 to 1.6, standard error 0.3"; where there can be no interval, `why_none`.
[[nodiscard]] inline std::string uncertainty(const analysis::Interval& interval,
                                             const std::optional<double>& estimate,
                                             const std::optional<double>& standard_error,
                                             const std::string& why_none) {
  const bool told = standard_error && !is_exact(standard_error, estimate);
  const std::string error = told ? ", standard error " + number(standard_error) : "";
  return (why_none.empty() ? "95 % " + range(interval, estimate) : "no interval: " + why_none) +
         error;
}

/// "x", with a mark where a cell is empty.
[[nodiscard]] inline std::string group_words(const std::string& value) {
  return value.empty() ? "(empty)" : value;
}

}  // namespace jnd::app
