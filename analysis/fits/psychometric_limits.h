#pragma once

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Infimum of the cost over curves of infinite slope: the lower of their ends below a
/// threshold, the upper above it, anything between at it. The threshold is the reference (F =
/// 0.5 there), or, with the pse free, any level. Infinite where no such curve gives the
/// answers.
[[nodiscard]] double step_limit_cost(const PsychometricLevels& levels,
                                     PsychometricMethod method, bool free_pse, bool free_lapse);

/// Infimum of the cost as the slope goes to 0: F = 0.5, or with the pse free any constant; at
/// intensity 0 f stays at its lower end.
[[nodiscard]] double flat_limit_cost(const PsychometricLevels& levels,
                                     PsychometricMethod method, bool free_pse, bool free_lapse);

/// The lapse, from 0 to its limit, that is best for given F(z) at each level, and its cost. The
/// cost is convex in the lapse. With a guess rate that is free, nearly the best of both, a
/// little off their bounds. `lower_tail` has levels.size() entries.
struct BestLapse {
  double lapse, cost, guess;
};
[[nodiscard]] BestLapse best_lapse(const PsychometricLevels& levels, PsychometricMethod method,
                                   bool free_lapse, const double* lower_tail) noexcept;

}  // namespace jnd::analysis
