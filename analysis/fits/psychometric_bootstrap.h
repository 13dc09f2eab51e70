#pragma once

#include <cstdint>

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Bootstrap of the Weber fraction (Efron 1979): draws each level's answers anew, refits, and
/// takes the 2.5 and 97.5 percentiles, and those corrected for bias and acceleration (BCa,
/// Efron 1987; the acceleration by the jackknife over answers). A refit without optimum counts
/// as the value it tends to, 0 or infinity, so that leaving it out cannot narrow the interval.
/// An interval that misses the estimate is refused: both ends open, and its method says so.
[[nodiscard]] BootstrapInterval bootstrapped_weber_fraction(const PsychometricSearch& search,
                                                            const PsychometricLevels& levels,
                                                            const PsychometricCurve& fitted,
                                                            const BootstrapOptions& options);

}  // namespace jnd::analysis
