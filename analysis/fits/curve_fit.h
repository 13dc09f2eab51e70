#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/beta_prior.h"
#include "analysis/fits/curve_model.h"
#include "analysis/fits/psychometric_search.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

struct CurveOptions {
  CurveModel model;
  /// The levels of S, in (0, 1), at which thresholds are reported. S is the curve between guess
  /// and lapse rate.
  std::vector<double> at = {0.5};
  /// Proportions of yes, in (0, 1), at which thresholds are reported after those of `at`. If a
  /// rate is free, a proportion belongs to a different level of S in each curve.
  std::vector<double> at_proportion = {};
  /// The just noticeable difference is the distance from S = 0.5 to this level, which is in
  /// (0, 1) and not 0.5.
  double jnd_at = 0.84134474606854292578;
  bool intervals = true;  ///< Whether to compute likelihood-ratio intervals.
  int num_bootstrap = 0;
  BootstrapKind bootstrap_kind = BootstrapKind::kParametric;
  bool posterior = false;
  /// The prior of free guess and lapse rates in the posterior.
  BetaPrior rate_prior = kUsualRatePrior;
  /// Whether to report the posterior's medians with this prior at each of `kOtherPriorWeights`.
  bool prior_sensitivity = false;
  int num_goodness = 0;  ///< The number of redraws for the p value of the deviance.
  std::uint64_t seed = 1;
};

/// A number with everything that is known of its uncertainty. Fields that were not asked for
/// are absent.
struct CurveValue {
  std::optional<double> value;
  Interval ci95;  ///< The likelihood-ratio interval.
  Interval bootstrap_ci95, bca_ci95;
  std::string bca_reason;  ///< Why there is no BCa interval; "" if there is one.
  std::optional<double> posterior_median;
  Interval posterior_ci95;
  /// The posterior median at each of `kOtherPriorWeights`, if it was asked for.
  std::vector<std::optional<double>> posterior_medians_by_weight;
};

/// The intensity at which S reaches a level.
struct CurveThreshold {
  /// The level of S. It is NaN if a proportion was asked for and there is no fit.
  double at = 0.5;
  /// The proportion of yes there: guess + (1 - guess - lapse) S.
  double proportion = 0.0;
  /// Whether `proportion` was asked for. `at` then follows from it.
  bool is_by_proportion = false;
  CurveValue intensity;
  CurveValue slope;  ///< The slope of the proportion of yes by intensity at the threshold.
};

/// The answers at one intensity, as a figure shows them.
struct CurvePoint {
  double intensity = 0.0;
  double num_yes = 0.0, num_trials = 0.0;
};

/// A fitted curve. If `status` is not kOk, all numbers are absent except those of a posterior.
struct CurveFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  CurveModel model;
  std::int64_t num_trials = 0;
  int num_levels = 0;
  CurveValue location, scale, guess_rate, lapse_rate;
  CurveValue pse;  ///< The intensity where S = 0.5.
  double jnd_at = 0.0;
  CurveValue jnd;  ///< The just noticeable difference in the unit of the intensities, > 0.
  std::vector<CurveThreshold> thresholds;
  std::optional<double> log_likelihood;  ///< The log-likelihood without binomial coefficients.
  std::optional<double> deviance, aic, bic;
  /// Pearson's chi-squared divided by its degrees of freedom.
  std::optional<double> overdispersion;
  std::optional<double> goodness_p_value;
  std::string goodness_reason;
  int num_bootstrap = 0, num_bootstrap_degenerate = 0;
  BootstrapKind bootstrap_kind = BootstrapKind::kParametric;
  std::string posterior_priors, posterior_note;
  std::vector<std::string> warnings;
  /// At most 200 points by ascending intensity. Neighbours are added up.
  std::vector<CurvePoint> points;

  /// P(yes) at an intensity. The fit's `status` must be kOk.
  [[nodiscard]] double probability(double intensity) const;
};

/// Fits a psychometric function by maximum likelihood and finds the global optimum. Free rates
/// lie in [0, 0.5]; a free lapse rate beside a known guess rate lies in [0, 1 - guess).
/// `fit_psychometric` says when the status is `degenerate`. Throws `core::Error` for
/// intensities, counts and rates out of range. Not real time.
[[nodiscard]] CurveFit fit_curve(const std::vector<AnswerCount>& rows,
                                 const CurveOptions& options);

/// A fitted curve with its levels, for further analysis.
struct FoundCurve {
  PsychometricLevels levels;
  PsychometricSearchResult found;
  FreeParameters free = {};
};
[[nodiscard]] FoundCurve found_curve(const std::vector<AnswerCount>& rows,
                                     const CurveModel& model);

/// Whether the answers of all groups together fall as the intensity grows. The covariance of
/// answer and intensity, summed over the groups, must be below 0 by more than two of its
/// standard deviations.
[[nodiscard]] bool answers_fall(const std::vector<std::vector<AnswerCount>>& groups);

/// The level of F at the intensity where S has the level `at`.
[[nodiscard]] inline double level_of_f(const CurveModel& model, double at) noexcept {
  return model.falling ? 1.0 - at : at;
}

}  // namespace jnd::analysis
