#pragma once

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Infimum of the cost over curves of infinite slope: `lapse` below a threshold, 1 - lapse
/// above it, anything between at it. The threshold is the reference (f = 0.5 there), or, with
/// the pse free, any level. Infinite where no such curve gives the answers.
[[nodiscard]] double step_limit_cost(const PsychometricLevels& levels,
                                     PsychometricMethod method, bool free_pse, bool free_lapse);

/// Infimum of the cost as the slope goes to 0: f = 0.5, or with the pse free any constant; at
/// intensity 0 f stays at the lapse.
[[nodiscard]] double flat_limit_cost(const PsychometricLevels& levels,
                                     PsychometricMethod method, bool free_pse, bool free_lapse);

/// The lapse in [0, 0.5] that is best for given Phi(z) at each level, and its cost. The cost is
/// convex in the lapse. `lower_tail` has levels.size() entries.
struct BestLapse {
  double lapse, cost;
};
[[nodiscard]] BestLapse best_lapse(const PsychometricLevels& levels, PsychometricMethod method,
                                   bool free_lapse, const double* lower_tail) noexcept;

}  // namespace jnd::analysis
