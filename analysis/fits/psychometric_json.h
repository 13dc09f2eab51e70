#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/fits/psychometric_effects.h"
#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Adds to a fit's JSON the family, the bootstrap's corrected interval, the goodness of fit,
/// the posterior and the warnings. Every number is finite or null.
void add_psychometric_details(nlohmann::ordered_json& json, const PsychometricFit& fit);

/// An object with `status` (the last one that is not "ok"), the slope, the list `effects` and
/// the warnings.
[[nodiscard]] nlohmann::ordered_json to_json(const PsychometricEffects& found);

}  // namespace jnd::analysis
