#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// One row of answers with when and how it was asked.
struct OrderedAnswers {
  double intensity = 0.0;  ///< > 0
  double num_yes = 0.0, num_trials = 1.0;
  std::optional<double> trial;     ///< Running number.
  std::optional<bool> test_first;  ///< The test came in the first interval.
};

/// By what an effect's interval and its p value are: near the edge of 5 % they may disagree.
inline constexpr char kEffectInterval[] = "Wald";
inline constexpr char kEffectTest[] = "likelihood ratio";

/// One term of the regression, tested by the likelihood ratio against leaving it out.
struct PsychometricEffect {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;   ///< Why there is no estimate; "" if there is one.
  std::string name;     ///< "response_bias", "interval_order", "drift", "learning"
  std::string meaning;  ///< What the estimate means, in words.
  std::optional<double> estimate;
  Interval ci95;                    ///< Wald's.
  std::optional<double> statistic;  ///< Chi-squared, one degree of freedom.
  std::optional<double> p_value;
};

struct PsychometricEffects {
  /// Of z over ln(x / reference), halfway through the trials: 1 / ln(1 + w). Below 0 where the
  /// answers fall.
  std::optional<double> slope;
  Interval slope_ci95;  ///< Wald's.
  std::vector<PsychometricEffect> effects;
  std::vector<std::string> warnings;  ///< What the effects rest on, where that is doubtful.
};

/// Probit regression of the answers on ln(x / reference) and what else was known of each row:
/// - response_bias: z at the reference, above 0 if "yes" is said too readily there. Where the
///   reference always came first it holds the order of the intervals too.
/// - interval_order: z where the test came first minus z where it came second.
/// - drift: change of z at the reference from the first trial to the last.
/// - learning: change of the slope from the first trial to the last, over its mean: above 0 if
///   discrimination became finer. Where the interval of the mean slope holds 0 there is nothing
///   to be a share of: no estimate, but the test of whether the slope changes stays.
/// Exploratory: nobody planned them, and nothing is adjusted for there being several. Effects
/// whose column is missing or never varies are left out. Throws `core::Error` for an intensity
/// or a reference that is not > 0, or counts as `fit_psychometric`.
[[nodiscard]] PsychometricEffects psychometric_effects(
    const std::vector<OrderedAnswers>& answers, double reference);

/// Whether one participant's answers change over the trials: the sum over levels of the
/// covariance of answer and running number, over its standard deviation if within a level every
/// order were equally likely; so neither level nor bias nor a perfect observer disturb it.
struct TrialTrend {
  std::optional<double> drift;     ///< z of "yes" becoming more frequent.
  std::optional<double> learning;  ///< z of right answers (by the reference) doing so.
};
[[nodiscard]] TrialTrend trial_trend(const std::vector<OrderedAnswers>& answers,
                                     double reference);

}  // namespace jnd::analysis
