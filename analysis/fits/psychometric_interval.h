#pragma once

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Where the profiled cost rises by `drop` above its minimum on either side of the optimum: the
/// stretch around the estimate, never one that misses it. An end is open where the profile does
/// not rise that far before the value leaves the range of numbers, or the curve is a step.
[[nodiscard]] Interval weber_fraction_interval(const PsychometricLevels& levels,
                                               PsychometricMethod method,
                                               const FreeParameters& free,
                                               const PsychometricOptimum& optimum, double drop);

/// The same for the pse, where it is free.
[[nodiscard]] Interval pse_interval(const PsychometricLevels& levels, PsychometricMethod method,
                                    const FreeParameters& free,
                                    const PsychometricOptimum& optimum, double drop);

}  // namespace jnd::analysis
