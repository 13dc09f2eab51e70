#pragma once

#include "analysis/fits/curve_model.h"
#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/psychometric_descent.h"

namespace jnd::analysis {

/// The likelihood-ratio interval of a number of the curve: where minus the log-likelihood, at
/// its least over all else, has risen by `drop` above the optimum's on either side. An end is
/// open where it does not rise so far while the curve is one: before it is flat, a step, or
/// out of the range of numbers. Of a rate, an end on its bound is that bound. `optimum` is
/// that of these levels. Not real time.
[[nodiscard]] Interval profile_interval(const CurveQuantity& quantity, const CurveModel& model,
                                        const PsychometricLevels& levels,
                                        const FreeParameters& free,
                                        const PsychometricOptimum& optimum,
                                        double drop = kLikelihoodDrop);

}  // namespace jnd::analysis
