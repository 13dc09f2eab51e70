#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The model of "is it felt?" for a stimulus that is presented alone, with catch trials that
/// have no stimulus:
///
///     P("yes" | x) = g + (1 - g) Phi( ln(x / threshold) / s ),   P("yes" | 0) = g
///
/// g is the rate of false alarms. The model takes false alarms for guesses that a stimulus does
/// not prevent (high-threshold correction of Abbott 1925). So the threshold is the intensity
/// where half of those who do not guess say "yes".
struct DetectionFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;               ///< Why there is no value; "" if there is one.
  std::optional<double> threshold;  ///< The threshold in the unit of the intensities.
  /// The likelihood-ratio interval, with the other parameters at their optimum.
  Interval threshold_ci95;
  std::optional<double> spread_ln;  ///< The standard deviation s in ln intensity, > 0.
  Interval spread_ln_ci95;
  /// The rate g, in [0, 1). It is 0 without catch trials.
  std::optional<double> false_alarm_rate;
  /// The log-likelihood without binomial coefficients.
  std::optional<double> log_likelihood;
};

/// Fits all answers at once by maximum likelihood. Rows at intensity 0 are catch trials;
/// without them g is 0. The status is `degenerate` if the supremum of the likelihood is not
/// attained: at a step (separated answers), at one rate for all stimuli (flat), or if fewer
/// than two intensities have answers. Throws `core::Error` as `fit_psychometric` does.
/// Not real time.
[[nodiscard]] DetectionFit fit_detection(const std::vector<AnswerCount>& data);

}  // namespace jnd::analysis
