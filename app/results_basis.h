#pragma once

#include <optional>
#include <string>

#include "analysis/study_results.h"

namespace jnd::app {

/// What the simulated value may be credited with: "calibrated", "implied" or "held out".
[[nodiscard]] std::string basis_of(const analysis::Estimate& estimate);

/// Whether our interval holds the published value, or lies above zero as was published; nothing
/// where there is no such interval.
[[nodiscard]] std::optional<bool> holds_published(const analysis::Estimate& estimate);

}  // namespace jnd::app
