#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/fits/psychometric_effects.h"
#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Adds to a fit's JSON what goes beyond the curve itself: family, the bootstrap's corrected
/// interval, goodness of fit, posterior, warnings. Every number is finite or null.
void add_psychometric_details(nlohmann::ordered_json& json, const PsychometricFit& fit);

/// `status`, the last that is not "ok", the slope, the list `effects` and the warnings.
[[nodiscard]] nlohmann::ordered_json to_json(const PsychometricEffects& found);

}  // namespace jnd::analysis
