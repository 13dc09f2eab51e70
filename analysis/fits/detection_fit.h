#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// A stimulus presented alone: "is it felt?", and what is said without any.
///
///     P("yes" | x) = g + (1 - g) Phi( ln(x / threshold) / s ),   P("yes" | 0) = g
///
/// g is the rate of false alarms, which the model takes for guesses that a stimulus does not
/// prevent (high-threshold correction of Abbott 1925): the threshold is where half of those who
/// do not guess say "yes".
struct DetectionFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;               ///< Why there is no value; "" if there is one.
  std::optional<double> threshold;  ///< Unit of the intensities.
  Interval threshold_ci95;          ///< Likelihood ratio, the others at their best.
  std::optional<double> spread_ln;  ///< s, > 0: standard deviation in ln intensity.
  Interval spread_ln_ci95;
  std::optional<double> false_alarm_rate;  ///< g, [0, 1); 0 without catch trials.
  std::optional<double> log_likelihood;    ///< Without binomial terms.
};

/// By maximum likelihood, all answers at once. Rows at intensity 0 are catch trials; without
/// them g is 0. `degenerate` where the supremum is not attained: at a step (separated), at one
/// rate for all stimuli (flat), or where fewer than two intensities have answers. Throws
/// `core::Error` as `fit_psychometric`. Not real time.
[[nodiscard]] DetectionFit fit_detection(const std::vector<AnswerCount>& data);

}  // namespace jnd::analysis
