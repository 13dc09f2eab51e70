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
  /// Levels of S, the curve between guess and lapse rate, at which thresholds are told: (0, 1).
  std::vector<double> at = {0.5};
  /// Proportions as answered, (0, 1), at which thresholds are told after those of `at`. Where a
  /// rate is free, the level of a proportion is another one for each curve.
  std::vector<double> at_proportion = {};
  /// The just noticeable difference is the distance from S = 0.5 to this: (0, 1), not 0.5.
  double jnd_at = 0.84134474606854292578;
  bool intervals = true;  ///< By the likelihood ratio.
  int num_bootstrap = 0;
  BootstrapKind bootstrap_kind = BootstrapKind::kParametric;
  bool posterior = false;
  BetaPrior rate_prior = kUsualRatePrior;  ///< Of the posterior's free guess and lapse rate.
  /// Also the posterior's medians with that prior at each of `kOtherPriorWeights`.
  bool prior_sensitivity = false;
  int num_goodness = 0;  ///< Redraws for the p value of the deviance.
  std::uint64_t seed = 1;
};

/// A number with all that is known of its uncertainty; what was not asked for is absent.
struct CurveValue {
  std::optional<double> value;
  Interval ci95;  ///< Likelihood ratio.
  Interval bootstrap_ci95, bca_ci95;
  std::string bca_reason;  ///< Why there is no corrected one.
  std::optional<double> posterior_median;
  Interval posterior_ci95;
  /// The median at each of `kOtherPriorWeights`, where that was asked for.
  std::vector<std::optional<double>> posterior_medians_by_weight;
};

/// The intensity where S has a level.
struct CurveThreshold {
  double at = 0.5;                ///< Of S; NaN where a proportion was asked for without a fit.
  double proportion = 0.0;        ///< As answered: guess + (1 - guess - lapse) S.
  bool is_by_proportion = false;  ///< `proportion` was asked for, and `at` follows.
  CurveValue intensity;
  CurveValue slope;  ///< Of the proportion by intensity, there.
};

/// Answers at an intensity, as a picture shows them.
struct CurvePoint {
  double intensity = 0.0;
  double num_yes = 0.0, num_trials = 0.0;
};

/// A fitted curve. Where `status` is not kOk no number is given but what a posterior has.
struct CurveFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  CurveModel model;
  std::int64_t num_trials = 0;
  int num_levels = 0;
  CurveValue location, scale, guess_rate, lapse_rate;
  CurveValue pse;  ///< Where S = 0.5.
  double jnd_at = 0.0;
  CurveValue jnd;  ///< In the unit of the intensities, > 0.
  std::vector<CurveThreshold> thresholds;
  std::optional<double> log_likelihood;  ///< Without binomial coefficients.
  std::optional<double> deviance, aic, bic;
  std::optional<double> overdispersion;  ///< Pearson's chi-squared over its degrees of freedom.
  std::optional<double> goodness_p_value;
  std::string goodness_reason;
  int num_bootstrap = 0, num_bootstrap_degenerate = 0;
  BootstrapKind bootstrap_kind = BootstrapKind::kParametric;
  std::string posterior_priors, posterior_note;
  std::vector<std::string> warnings;
  std::vector<CurvePoint> points;  ///< Ascending; at most 200, neighbours added up.

  /// P(yes) at an intensity; of a fit that is kOk.
  [[nodiscard]] double probability(double intensity) const;
};

/// Fits a psychometric function by maximum likelihood, globally. Rates that are free are in
/// [0, 0.5], a lapse rate beside a known guess rate in [0, 1 - guess). `degenerate` as
/// `fit_psychometric` says. Throws `core::Error` for intensities, counts and rates out of
/// range. Not real time.
[[nodiscard]] CurveFit fit_curve(const std::vector<AnswerCount>& rows,
                                 const CurveOptions& options);

/// A fit whose curve another analysis goes on with.
struct FoundCurve {
  PsychometricLevels levels;
  PsychometricSearchResult found;
  FreeParameters free = {};
};
[[nodiscard]] FoundCurve found_curve(const std::vector<AnswerCount>& rows,
                                     const CurveModel& model);

/// Values of quantities over answers drawn anew, one list each, in the order of the redraws; of
/// a redraw without an optimum the value that it tends to: a JND of 0 where it is a step. The
/// same seed draws the same answers.
struct CurveResamples {
  std::vector<std::vector<double>> values;
  int num_degenerate = 0;
};
[[nodiscard]] CurveResamples resampled(const FoundCurve& fit, const CurveModel& model,
                                       const std::vector<CurveQuantity>& quantities,
                                       int num_redraws, BootstrapKind kind, std::uint64_t seed);

/// Whether the answers of all groups together fall as the intensity grows: by the sum over
/// groups of how yes and intensity vary together, beyond two of its standard deviations.
[[nodiscard]] bool answers_fall(const std::vector<std::vector<AnswerCount>>& groups);

/// Where S has this level F has that.
[[nodiscard]] inline double level_of_f(const CurveModel& model, double at) noexcept {
  return model.falling ? 1.0 - at : at;
}

}  // namespace jnd::analysis
