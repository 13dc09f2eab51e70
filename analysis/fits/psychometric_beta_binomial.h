#pragma once

#include <optional>
#include <string>

#include "analysis/fits/psychometric_descent.h"

namespace jnd::analysis {

/// A curve whose answers scatter more than independent ones: for each entry of the levels, see
/// `levels_by_row`, the probability of yes is drawn from a beta distribution about the curve,
/// so that two answers of one entry correlate by rho = 1 / (alpha + beta + 1) and the variance
/// of a count is n f (1 - f) (1 + (n - 1) rho) (Williams 1975; Schütt et al. 2016, whose eta is
/// sqrt(rho)).
struct BetaBinomialFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  PsychometricCurve curve;
  double correlation = 0.0;              ///< rho, in [0, 1).
  double log_likelihood = 0.0;           ///< Without binomial coefficients.
  std::optional<double> standard_error;  ///< Of w, of the observed information; what is on its
                                         ///< bound 0 is held there.
  Interval weber_fraction_ci95;          ///< Likelihood ratio, over all else.
  std::optional<Interval> pse_ci95;      ///< Absent if the pse is not free.
};

/// `levels` may have several entries of one intensity. By maximum likelihood from the binomial
/// optimum `start`, which must exist; `degenerate` where with this scatter the answers do not
/// bound a slope. Not real time.
[[nodiscard]] BetaBinomialFit fit_beta_binomial(const PsychometricLevels& levels,
                                                const FreeParameters& free,
                                                const PsychometricCurve& start,
                                                bool intervals = true);

}  // namespace jnd::analysis
