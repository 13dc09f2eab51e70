#pragma once

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Twice the log-likelihood that the saturated model, each level's own proportion, has more.
[[nodiscard]] double deviance_of(const PsychometricLevels& levels, double log_likelihood);

/// Pearson's: the sum over levels > 0 of squared standardised residuals.
[[nodiscard]] double pearson_statistic(const PsychometricLevels& levels,
                                       const PsychometricCurve& curve);

/// Levels minus parameters that are free; a lapse rate on its bound 0 is not.
[[nodiscard]] int residual_degrees_of_freedom(const PsychometricLevels& levels,
                                              const FreeParameters& free, double lapse);

/// Probability that answers of the curve lie as far from it as these, by `misfit_p_value`.
[[nodiscard]] std::optional<double> misfit_p_value(const PsychometricLevels& levels,
                                                   const FreeParameters& free,
                                                   const PsychometricCurve& fitted);

/// What is drawn anew for a goodness of fit.
struct GoodnessRedraws {
  int num = 0;  ///< 0: nothing.
  std::uint64_t seed = 1;
  bool correlation = true;  ///< Also how often residuals correlate with the curve as much.
};

/// Residuals, overdispersion and, with `redraws.num` > 0, how often data drawn from the fitted
/// curve and refitted lie at least as far off: chi-squared does not hold at few answers a level
/// (Wichmann and Hill 2001). A refit without an optimum has the deviance of its limit.
[[nodiscard]] PsychometricGoodness goodness_of_fit(const PsychometricSearch& search,
                                                   const PsychometricLevels& levels,
                                                   const PsychometricCurve& fitted,
                                                   const GoodnessRedraws& redraws);

}  // namespace jnd::analysis
