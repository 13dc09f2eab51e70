#pragma once

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// The infimum of the cost over curves of infinite slope. Such a curve is at its lower end
/// below a threshold, at its upper end above it, and anywhere between at the threshold. With a
/// free pse the threshold may be any level. Otherwise it is the reference, where F = 0.5. The
/// infimum is infinite if no such curve can give the answers.
[[nodiscard]] double step_limit_cost(const PsychometricLevels& levels,
                                     PsychometricMethod method, bool free_pse, bool free_lapse);

/// The infimum of the cost as the slope goes to 0. F is then 0.5 or, with a free pse, any
/// constant. At intensity 0, f stays at its lower end.
[[nodiscard]] double flat_limit_cost(const PsychometricLevels& levels,
                                     PsychometricMethod method, bool free_pse, bool free_lapse);

/// The lapse rate from 0 to its limit that is best for given F(z) at each level, and its cost.
/// The cost is convex in the lapse rate. If the guess rate is free, the result is nearly the
/// best pair of rates, a little inside their bounds. `lower_tail` has levels.size() entries.
struct BestLapse {
  double lapse, cost, guess;
};
[[nodiscard]] BestLapse best_lapse(const PsychometricLevels& levels, PsychometricMethod method,
                                   bool free_lapse, const double* lower_tail) noexcept;

}  // namespace jnd::analysis
