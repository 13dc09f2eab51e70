#pragma once

#include <optional>
#include <string>

#include "analysis/results/study_results.h"

namespace jnd::app {

/// What the simulated value may be credited with: "calibrated", "implied" or "held out".
[[nodiscard]] std::string basis_of(const analysis::Estimate& estimate);

/// Whether our interval contains the published value, or is above zero if that was published;
/// none if there is no such interval. It is only for JSON, whose key remains: it ignores the
/// published value's own error, so it is false for many values that agree.
[[nodiscard]] std::optional<bool> holds_published(const analysis::Estimate& estimate);

/// The share of simulated studies that are as far out on the published value's side, with its
/// standard error: "0.004 below (se 0.002)", "< 0.001 above". "" if there are no simulated
/// studies.
[[nodiscard]] std::string tail_words(const analysis::Estimate& estimate,
                                     const analysis::Predictive& predictive);

}  // namespace jnd::app
