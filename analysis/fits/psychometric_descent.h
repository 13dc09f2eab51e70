#pragma once

#include <array>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Which of slope, offset, lapse and guess a descent may move. If the pse is fixed, the offset
/// is 0, because the abscissa then measures from the reference.
using FreeParameters = std::array<bool, 4>;

/// The curve at which a descent came to rest, and its cost.
struct PsychometricOptimum {
  PsychometricCurve curve;
  PsychometricCost cost;
  bool converged = false;
};

/// Descends from `start`. If `converged` is set, the parameters are accurate to about 1e-14.
using PsychometricDescent = PsychometricOptimum (*)(const PsychometricLevels& levels,
                                                    PsychometricMethod method,
                                                    const FreeParameters& free,
                                                    const PsychometricCurve& start);

/// Newton's method with the exact Hessian, which is made positive definite where it is not. Its
/// steps keep the slope > 0 and the rates within their limits, and are shortened until the cost
/// falls. It takes some microseconds, so bootstraps and profiles use it for their many refits.
[[nodiscard]] PsychometricOptimum minimised_by_newton(const PsychometricLevels& levels,
                                                      PsychometricMethod method,
                                                      const FreeParameters& free,
                                                      const PsychometricCurve& start) noexcept;

/// A descent by Ceres over ln slope, offset and lapse: BFGS for the likelihood, Levenberg and
/// Marquardt for least squares. Newton's method then improves the last digits. `converged` is
/// false if the two come to rest at different places. It makes the fit that is reported, for a
/// known guess rate.
[[nodiscard]] PsychometricOptimum minimised_by_ceres(const PsychometricLevels& levels,
                                                     PsychometricMethod method,
                                                     const FreeParameters& free,
                                                     const PsychometricCurve& start);

}  // namespace jnd::analysis
