#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/mixed/mixed_derived.h"
#include "analysis/mixed/mixed_fit.h"
#include "analysis/mixed/power_people.h"

namespace jnd::analysis {

/// A mixed model with the keys that the command line promises: status, reason, fixed, random,
/// log_likelihood, aic, bic, num_parameters, num_rows. Numbers that do not exist are null.
[[nodiscard]] nlohmann::ordered_json to_json(const MixedFit& fit);

/// A list of objects with name, value, standard_error, ci95 and, with redraws, bootstrap_ci95.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<DerivedQuantity>& derived,
                                             bool has_bootstrap);

/// Uses the keys of the plain power law where it has them. The differences between people are
/// under `between_people`, and everybody's exponents under `people`.
[[nodiscard]] nlohmann::ordered_json to_json(const PeoplePowerFit& fit);

}  // namespace jnd::analysis
