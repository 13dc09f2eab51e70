#pragma once

#include <optional>
#include <string>

#include "analysis/fits/psychometric_descent.h"

namespace jnd::analysis {

/// A curve whose answers scatter more than independent ones. For each entry of the levels (see
/// `levels_by_row`) the probability of yes is drawn from a beta distribution about the curve.
/// So two answers of one entry correlate by rho = 1 / (alpha + beta + 1), and the variance of a
/// count is n f (1 - f) (1 + (n - 1) rho) (Williams 1975; Schütt et al. 2016, whose eta is
/// sqrt(rho)).
struct BetaBinomialFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  PsychometricCurve curve;
  double correlation = 0.0;     ///< The correlation rho, in [0, 1).
  double log_likelihood = 0.0;  ///< The log-likelihood without binomial coefficients.
  /// The standard error of w, from the observed information. Parameters on their bound 0 are
  /// held there.
  std::optional<double> standard_error;
  /// The likelihood-ratio interval, with everything else at its optimum.
  Interval weber_fraction_ci95;
  /// The same for the pse. It is absent if the pse is not free.
  std::optional<Interval> pse_ci95;
};

/// Fits by maximum likelihood. `levels` may have several entries with the same intensity.
/// `start` is the binomial optimum, which must exist. The status is `degenerate` if the
/// answers, with this scatter, do not bound the slope. Not real time.
[[nodiscard]] BetaBinomialFit fit_beta_binomial(const PsychometricLevels& levels,
                                                const FreeParameters& free,
                                                const PsychometricCurve& start,
                                                bool intervals = true);

}  // namespace jnd::analysis
