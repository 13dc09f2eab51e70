#pragma once

#include <vector>

#include "analysis/fits/curve_comparison.h"

namespace jnd::analysis {

/// Contrasts the thresholds of every two groups at the levels of `options`. Difference and
/// ratio have likelihood-ratio intervals with all other parameters at their optimum, and
/// bootstrap intervals if they are asked for. Not real time.
[[nodiscard]] std::vector<CurveContrast> contrasts_of(const std::vector<ComparedGroup>& groups,
                                                      const std::vector<FoundCurve>& found,
                                                      const JointCurves& joint,
                                                      const CurveOptions& options);

}  // namespace jnd::analysis
