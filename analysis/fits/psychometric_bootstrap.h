#pragma once

#include <cstdint>

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// The bootstrap of the Weber fraction (Efron 1979). It redraws each level's answers, refits
/// them, and takes the 2.5 and 97.5 percentiles. The second interval is corrected for bias and
/// acceleration (BCa, Efron 1987; the acceleration comes from the jackknife over answers). A
/// refit without an optimum counts as its limit, 0 or infinity, so that leaving it out cannot
/// narrow the interval. If an interval misses the estimate, both ends are open and its method
/// says so.
[[nodiscard]] BootstrapInterval bootstrapped_weber_fraction(const PsychometricSearch& search,
                                                            const PsychometricLevels& levels,
                                                            const PsychometricCurve& fitted,
                                                            const BootstrapOptions& options);

}  // namespace jnd::analysis
