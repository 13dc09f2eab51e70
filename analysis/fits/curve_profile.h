#pragma once

#include "analysis/fits/curve_model.h"
#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/psychometric_descent.h"

namespace jnd::analysis {

/// The likelihood-ratio interval of a quantity of the curve. Its ends lie where minus the
/// log-likelihood, minimised over everything else, has risen by `drop` above the optimum. An
/// end is open if the cost does not rise that far before the curve becomes flat, becomes a
/// step, or leaves the range of numbers. If a rate's interval reaches the rate's bound, the end
/// is that bound. `optimum` must belong to these levels. Not real time.
[[nodiscard]] Interval profile_interval(const CurveQuantity& quantity, const CurveModel& model,
                                        const PsychometricLevels& levels,
                                        const FreeParameters& free,
                                        const PsychometricOptimum& optimum,
                                        double drop = kLikelihoodDrop);

}  // namespace jnd::analysis
