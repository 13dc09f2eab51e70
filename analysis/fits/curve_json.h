#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/fits/curve_comparison.h"
#include "analysis/fits/curve_fit.h"

namespace jnd::analysis {

/// Uses the keys that the command line promises. Every number is finite or null.
[[nodiscard]] nlohmann::ordered_json to_json(const CurveFit& fit);
[[nodiscard]] nlohmann::ordered_json to_json(const CurveComparison& comparison);

}  // namespace jnd::analysis
