#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "analysis/fits/fit_status.h"

namespace jnd::app {

/// Numbers of a fit as people read them; "-" for one that does not exist.
[[nodiscard]] inline std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

/// "0.32 to 1.6", an end that the data leave open in words.
[[nodiscard]] inline std::string range(const analysis::Interval& interval) {
  const auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : std::string("open");
  };
  return end(interval.low) + " to " + end(interval.high);
}

}  // namespace jnd::app
