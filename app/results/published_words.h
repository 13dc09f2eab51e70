#pragma once

#include <optional>
#include <string>

#include "analysis/results/study_results.h"

namespace jnd::app {

/// What the simulated value may be credited with: "calibrated", "implied" or "held out".
[[nodiscard]] std::string basis_of(const analysis::Estimate& estimate);

/// Whether our interval holds the published value, or lies above zero as was published; nothing
/// where there is no such interval. For JSON alone, where the key stays: it leaves the
/// published value's own error out, so that "no" is said of many values that agree.
[[nodiscard]] std::optional<bool> holds_published(const analysis::Estimate& estimate);

/// "0.004 below (se 0.002)", "< 0.001 above": the share of simulated studies as far on the
/// published value's side, with its standard error; "" where none are known.
[[nodiscard]] std::string tail_words(const analysis::Estimate& estimate,
                                     const analysis::Predictive& predictive);

}  // namespace jnd::app
