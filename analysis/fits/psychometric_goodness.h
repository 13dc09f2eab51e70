#pragma once

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Twice the log-likelihood that the saturated model has above the given one. The saturated
/// model gives each level its own proportion.
[[nodiscard]] double deviance_of(const PsychometricLevels& levels, double log_likelihood);

/// Pearson's statistic: the sum of squared standardised residuals. Answers at intensity 0 of a
/// logarithmic family belong to it where the curve's lower end lies between 0 and 1.
[[nodiscard]] double pearson_statistic(const PsychometricLevels& levels,
                                       const PsychometricCurve& curve);

/// The number of levels minus the number of free parameters. A lapse or guess rate on its bound
/// 0 does not count as free. Intensity 0 of a logarithmic family is a level where the curve's
/// lower end lies between 0 and 1; elsewhere no answer there can surprise.
[[nodiscard]] int residual_degrees_of_freedom(const PsychometricLevels& levels,
                                              const FreeParameters& free,
                                              const PsychometricCurve& curve);

/// The probability that answers of the curve lie as far from it as these do; see
/// `answer_scatter.h`.
[[nodiscard]] std::optional<double> misfit_p_value(const PsychometricLevels& levels,
                                                   const FreeParameters& free,
                                                   const PsychometricCurve& fitted);

/// What is redrawn to judge the goodness of fit.
struct GoodnessRedraws {
  int num = 0;  ///< The number of redraws; 0 for none.
  std::uint64_t seed = 1;
  /// Whether to find out too how often residuals correlate as strongly with the curve.
  bool correlation = true;
};

/// Residuals and overdispersion. If `redraws.num` > 0, it also finds how often data that are
/// redrawn from the fitted curve and refitted lie at least as far from their curve, because
/// chi-squared does not hold if levels have few answers (Wichmann and Hill 2001). A refit
/// without an optimum has the deviance of its limit.
[[nodiscard]] PsychometricGoodness goodness_of_fit(const PsychometricSearch& search,
                                                   const PsychometricLevels& levels,
                                                   const PsychometricCurve& fitted,
                                                   const GoodnessRedraws& redraws);

}  // namespace jnd::analysis
