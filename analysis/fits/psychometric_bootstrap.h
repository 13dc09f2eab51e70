#pragma once

#include <cstdint>

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Parametric bootstrap of the Weber fraction (Efron 1979): draws each level's answers anew
/// from the fitted curve, binomially, refits, and takes the 2.5 and 97.5 percentiles. A refit
/// without optimum counts as the value it tends to, 0 or infinity, so that leaving it out
/// cannot narrow the interval. An interval that misses `estimate` is refused: both ends open,
/// `method` says so.
[[nodiscard]] BootstrapInterval bootstrapped_weber_fraction(const PsychometricSearch& search,
                                                            const PsychometricLevels& levels,
                                                            const PsychometricCurve& fitted,
                                                            int num_refits, std::uint64_t seed);

}  // namespace jnd::analysis
