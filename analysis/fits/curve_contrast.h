#pragma once

#include <vector>

#include "analysis/fits/curve_comparison.h"

namespace jnd::analysis {

/// The thresholds of every two groups at the levels of `options`: difference and ratio with
/// likelihood-ratio intervals, all else at its best, and with those of a bootstrap where that
/// is asked for. Not real time.
[[nodiscard]] std::vector<CurveContrast> contrasts_of(const std::vector<ComparedGroup>& groups,
                                                      const std::vector<FoundCurve>& found,
                                                      const JointCurves& joint,
                                                      const CurveOptions& options);

}  // namespace jnd::analysis
