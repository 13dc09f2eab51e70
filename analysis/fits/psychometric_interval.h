#pragma once

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// The interval around the optimum whose ends lie where the profiled cost has risen by `drop`
/// above its minimum. It always contains the estimate. An end is open if the profile does not
/// rise that far before the value leaves the range of numbers or the curve becomes a step.
[[nodiscard]] Interval weber_fraction_interval(const PsychometricLevels& levels,
                                               PsychometricMethod method,
                                               const FreeParameters& free,
                                               const PsychometricOptimum& optimum, double drop);

/// The same interval for the pse, if it is free.
[[nodiscard]] Interval pse_interval(const PsychometricLevels& levels, PsychometricMethod method,
                                    const FreeParameters& free,
                                    const PsychometricOptimum& optimum, double drop);

}  // namespace jnd::analysis
