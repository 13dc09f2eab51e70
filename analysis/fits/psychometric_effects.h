#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// One row of answers, with when and how it was asked.
struct OrderedAnswers {
  double intensity = 0.0;  ///< > 0
  double num_yes = 0.0, num_trials = 1.0;
  std::optional<double> trial;     ///< The running number of the trial.
  std::optional<bool> test_first;  ///< Whether the test came in the first interval.
};

/// An effect's interval and its p value come from different methods. Near 5 % they may
/// disagree.
inline constexpr char kEffectInterval[] = "Wald";
inline constexpr char kEffectTest[] = "likelihood ratio";

/// One term of the regression. The likelihood ratio tests it against leaving it out.
struct PsychometricEffect {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;   ///< Why there is no estimate; "" if there is one.
  std::string name;     ///< "response_bias", "interval_order", "drift" or "learning".
  std::string meaning;  ///< What the estimate means, in words.
  std::optional<double> estimate;
  Interval ci95;                    ///< The Wald interval.
  std::optional<double> statistic;  ///< Chi-squared with one degree of freedom.
  std::optional<double> p_value;
};

struct PsychometricEffects {
  /// The slope of z over ln(x / reference), halfway through the trials: 1 / ln(1 + w). It is
  /// below 0 if the answers fall.
  std::optional<double> slope;
  Interval slope_ci95;  ///< The Wald interval.
  std::vector<PsychometricEffect> effects;
  std::vector<std::string> warnings;  ///< Reasons to doubt the effects.
};

/// Probit regression of the answers on ln(x / reference) and on what else is known of each row:
///
/// - response_bias: z at the reference. It is above 0 if "yes" is said too readily there. If
///   the reference always came first, it includes the effect of the order of the intervals.
/// - interval_order: z where the test came first minus z where it came second.
/// - drift: the change of z at the reference from the first trial to the last.
/// - learning: the change of the slope from the first trial to the last, divided by the mean
///   slope. It is above 0 if discrimination became finer. If the interval of the mean slope
///   holds 0 there is no estimate, but the test whether the slope changes remains.
///
/// The analysis is exploratory: nobody planned these tests, and they are not adjusted for their
/// number. Effects whose column is missing or never varies are left out. Throws `core::Error`
/// for an intensity or a reference that is not > 0, and for counts as `fit_psychometric` does.
[[nodiscard]] PsychometricEffects psychometric_effects(
    const std::vector<OrderedAnswers>& answers, double reference);

/// Tests whether one participant's answers change over the trials. The statistic is the
/// covariance of answer and running number, summed over the levels. It is divided by its
/// standard deviation under equally likely orders within each level. So levels, a bias or a
/// perfect observer do not disturb it.
struct TrialTrend {
  /// z of the trend; it is above 0 if "yes" becomes more frequent.
  std::optional<double> drift;
  /// z of the trend of right answers (judged by the reference); it is above 0 if they become
  /// more frequent.
  std::optional<double> learning;
};
[[nodiscard]] TrialTrend trial_trend(const std::vector<OrderedAnswers>& answers,
                                     double reference);

}  // namespace jnd::analysis
