#pragma once

#include <array>

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Which of slope, offset, lapse and guess a descent may move. A fixed pse is offset 0, because
/// the log ratios are then those to the reference.
using FreeParameters = std::array<bool, 4>;

/// A stationary point of the cost.
struct PsychometricOptimum {
  PsychometricCurve curve;
  PsychometricCost cost;
  bool converged = false;
};

/// Goes downhill from `start`. At `converged` the parameters are right to about 1e-14.
using PsychometricDescent = PsychometricOptimum (*)(const PsychometricLevels& levels,
                                                    PsychometricMethod method,
                                                    const FreeParameters& free,
                                                    const PsychometricCurve& start);

/// Newton's method with the exact Hessian, made positive definite where it is not, a step that
/// keeps the slope > 0 and lapse and guess within their limits, and backtracking: some
/// microseconds, for the many refits of a bootstrap and a profile.
[[nodiscard]] PsychometricOptimum minimised_by_newton(const PsychometricLevels& levels,
                                                      PsychometricMethod method,
                                                      const FreeParameters& free,
                                                      const PsychometricCurve& start) noexcept;

/// Ceres, over ln slope, offset and lapse: BFGS for the likelihood, Levenberg and Marquardt for
/// least squares. Newton's method then mends the last digits; not `converged` where it comes to
/// rest elsewhere. For the fit that is reported, of a guess rate that is known.
[[nodiscard]] PsychometricOptimum minimised_by_ceres(const PsychometricLevels& levels,
                                                     PsychometricMethod method,
                                                     const FreeParameters& free,
                                                     const PsychometricCurve& start);

}  // namespace jnd::analysis
