#include "analysis/fits/psychometric_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/fits/calibrated_drop.h"
#include "analysis/fits/chance_level.h"
#include "analysis/fits/falling_test.h"
#include "analysis/fits/interval_order_fit.h"
#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/psychometric_beta_binomial.h"
#include "analysis/fits/psychometric_bootstrap.h"
#include "analysis/fits/psychometric_goodness.h"
#include "analysis/fits/psychometric_interval.h"
#include "analysis/fits/psychometric_posterior.h"
#include "analysis/fits/psychometric_search.h"
#include "analysis/fits/psychometric_warnings.h"
#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using enum PsychometricMethod;
constexpr char kNotRelative[] =
    "the pse is not above 0: there is nothing that a Weber fraction is relative to";

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

/// Sum of squares of the proportions about their mean.
double sum_about_mean(const PsychometricLevels& levels) {
  std::vector<double> proportions;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    proportions.push_back(levels.proportion(level));
  }
  if (levels.zero_trials > 0.0) proportions.push_back(levels.zero_yes / levels.zero_trials);
  if (std::all_of(proportions.begin(), proportions.end(),
                  [&](double proportion) { return proportion == proportions[0]; })) {
    return 0.0;  // It is exactly 0, whatever rounding makes of the mean.
  }
  double mean = 0.0;
  for (const double proportion : proportions) mean += proportion;
  mean /= static_cast<double>(proportions.size());
  double sum = 0.0;
  for (const double proportion : proportions) sum += (proportion - mean) * (proportion - mean);
  return sum;
}

/// The derivatives of w by slope, offset and lapse. w is exp(c unit / slope) - 1 on a
/// logarithmic abscissa. On a linear one the pse is origin - unit offset / slope, so w is c
/// unit / (slope origin - unit offset).
Eigen::Vector3d fraction_gradient(const PsychometricLevels& levels,
                                  const PsychometricCurve& curve) {
  const double step = sigmoid_jnd(levels.sigmoid) * levels.unit / curve.slope;
  if (levels.logarithmic()) return {-std::exp(step) * step / curve.slope, 0.0, 0.0};
  const double pse = curve.pse(levels);
  return {-step * levels.origin / (curve.slope * pse * pse),
          step * levels.unit / (curve.slope * pse * pse), 0.0};
}

/// The standard error of w by the delta method. Its matrix is `information` divided by `scale`.
/// A lapse rate on its bound is held there.
std::optional<double> standard_error(const PsychometricLevels& levels,
                                     const PsychometricCurve& curve, const FreeParameters& free,
                                     Eigen::Matrix3d information, double scale) {
  for (int parameter = 0; parameter < 3; ++parameter) {
    const bool moving =
        free[static_cast<std::size_t>(parameter)] && !(parameter == 2 && curve.lapse <= 0.0);
    if (moving) continue;
    information.row(parameter).setZero();
    information.col(parameter).setZero();
    information(parameter, parameter) = 1.0;
  }
  const Eigen::Vector3d by_curve = fraction_gradient(levels, curve);
  return finite(std::sqrt(by_curve.dot(information.inverse() * by_curve) * scale));
}

/// The 95 % quantile of F with 1 and `degrees_of_freedom` degrees of freedom.
double fisher_quantile(int degrees_of_freedom) {
  return fisher_f_quantile(0.95, 1.0, degrees_of_freedom);
}

/// The calibrated drops of the curve, which is a line in the scaled abscissa; see
/// `PsychometricOptions::num_calibration`.
CalibratedDrops drops_of(const PsychometricLevels& levels, const PsychometricCurve& curve,
                         const PsychometricOptions& options) {
  const auto size = static_cast<Eigen::Index>(levels.size());
  Eigen::MatrixXd design = Eigen::MatrixXd::Ones(size, 2);
  design.col(0) = Eigen::Map<const Eigen::VectorXd>(levels.abscissa.data(), size);
  return calibrated_drops(
      design, Eigen::Map<const Eigen::VectorXd>(levels.num_trials.data(), size),
      Eigen::Vector2d(curve.slope, curve.offset), true, options.num_calibration, options.seed);
}

void add_uncertainty(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                     const PsychometricLevels& levels, const PsychometricOptions& options,
                     const FreeParameters& free, const PsychometricOptimum& optimum) {
  const bool free_pse = free[1];
  double drop = kLikelihoodDrop, pse_drop = kLikelihoodDrop;
  if (options.method == kMaximumLikelihood) {
    double scale = 1.0;
    if (options.overdispersion == Overdispersion::kScaled) {
      const PsychometricLevels by_row = levels_by_row(data, levels);
      const int degrees_of_freedom = residual_degrees_of_freedom(by_row, free, optimum.curve);
      if (degrees_of_freedom < 1) {
        fit.overdispersion.note =
            "no degree of freedom is left to tell how far answers scatter";
        if (free_pse) fit.pse_ci95 = Interval{};
        return;
      }
      scale = std::max(1.0, pearson_statistic(by_row, optimum.curve) / degrees_of_freedom);
      fit.overdispersion.factor = scale;
      drop = pse_drop = 0.5 * scale * fisher_quantile(degrees_of_freedom);
    }
    fit.standard_error = standard_error(levels, optimum.curve, free,
                                        optimum.cost.hessian.topLeftCorner<3, 3>(), scale);
  } else {
    const int degrees_of_freedom = fit.num_levels - 1 - free[1] - free[2];
    if (free_pse) fit.pse_ci95 = Interval{};
    if (degrees_of_freedom < 1) return;
    const double variance = optimum.cost.value / degrees_of_freedom;
    fit.standard_error = standard_error(levels, optimum.curve, free,
                                        squared_jacobian(levels, optimum.curve), variance);
    drop = pse_drop = variance * fisher_quantile(degrees_of_freedom);
  }
  if (!fit.weber_fraction) fit.standard_error.reset();
  if (!options.intervals) return;
  if (options.num_calibration > 0 && free_pse && have_fewer_answers(levels, kCalibratedBelow)) {
    const CalibratedDrops drops = drops_of(levels, optimum.curve, options);
    drop = drops.slope;
    pse_drop = drops.pse;
    fit.calibration = {options.num_calibration, drop, pse_drop};
  }
  if (fit.weber_fraction) {
    fit.weber_fraction_ci95 =
        weber_fraction_interval(levels, options.method, free, optimum, drop);
  }
  if (free_pse) {
    fit.pse_ci95 = pse_interval(levels, options.method, free, optimum, pse_drop);
  }
}

void add_uncertainty(PsychometricFit& fit, const BetaBinomialFit& scattered) {
  fit.standard_error = scattered.standard_error;
  fit.weber_fraction_ci95 = scattered.weber_fraction_ci95;
  fit.pse_ci95 = scattered.pse_ci95;
  fit.overdispersion.correlation = scattered.correlation;
  fit.overdispersion.log_likelihood = scattered.log_likelihood;
}

/// Adds the curve's parameters in the family's own words.
void add_parameters(PsychometricFit& fit, const PsychometricLevels& levels,
                    const PsychometricCurve& curve) {
  switch (fit.family) {
    case PsychometricFamily::kWeber:
      break;
    case PsychometricFamily::kGauss:
      fit.parameters = {{"mean", *fit.pse}, {"standard_deviation", levels.unit / curve.slope}};
      break;
    case PsychometricFamily::kWeibull: {
      const double shape = curve.slope / levels.unit;
      const double scale = *fit.pse * std::pow(std::numbers::ln2, -1.0 / shape);
      fit.parameters = {{"scale", scale}, {"shape", shape}};
      break;
    }
  }
}

}  // namespace

PsychometricFit fit_psychometric(const std::vector<AnswerCount>& data,
                                 const PsychometricOptions& options) {
  const bool free_pse = options.free_pse || traits_of(options.family).always_free_pse;
  const PsychometricLevels levels =
      pooled_levels(data, options.reference, free_pse, options.family,
                    {options.guess_rate, options.symmetric_lapse,
                     options.free_lapse ? 0.0 : options.lapse_rate});
  core::require(options.overdispersion == Overdispersion::kNone ||
                    (options.method == kMaximumLikelihood && options.num_bootstrap == 0 &&
                     !options.posterior && !options.by_order),
                "overdispersion", "maximum likelihood without bootstrap, posterior and orders",
                1.0);
  core::require(options.num_calibration == 0 || options.num_calibration >= kFewestCalibrations,
                "num_calibration", "0, or 200 and more", options.num_calibration);
  core::require(
      options.num_calibration == 0 ||
          (options.family == PsychometricFamily::kWeber &&
           options.method == kMaximumLikelihood && levels.ends.are_bare(options.free_lapse) &&
           options.overdispersion == Overdispersion::kNone),
      "num_calibration",
      "the Weber curve by maximum likelihood without lapses, guesses and "
      "overdispersion",
      options.num_calibration);
  if (options.by_order && orders_vary(data)) {
    core::require(options.family == PsychometricFamily::kWeber &&
                      options.method == kMaximumLikelihood &&
                      levels.ends.are_bare(options.free_lapse) && options.num_bootstrap == 0 &&
                      !options.posterior,
                  "by_order", "the Weber curve by maximum likelihood alone", 1.0);
    PsychometricOptions its = options;
    if (!have_fewer_answers(levels, kCalibratedBelow)) its.num_calibration = 0;
    PsychometricFit fit = fit_by_interval_order(data, its);
    if (fit.status != FitStatus::kOk || !fit.order_effect_ln) return fit;
    add_psychometric_warnings(fit, data, levels, options, false);
    return fit;
  }
  PsychometricFit fit;
  fit.family = options.family;
  fit.method = options.method;
  fit.guess_rate = options.guess_rate;
  fit.overdispersion.model = options.overdispersion;
  fit.symmetric_lapse = options.symmetric_lapse;
  fit.num_levels = static_cast<int>(levels.size()) + (levels.zero_trials > 0.0 ? 1 : 0);
  for (const AnswerCount& row : data) fit.num_trials += row.num_trials;

  const std::optional<double> falls = options.advice ? significant_fall(data) : std::nullopt;
  if (falls) {
    fit.warnings.push_back(falling_warning(*falls));
  } else if (options.guess_unknown) {
    if (const auto chance = suspected_chance(data)) {
      fit.warnings.push_back(chance_warning(*chance));
    }
  }
  const PsychometricSearch search(levels, options.method, free_pse, options.free_lapse);
  if (options.posterior) {
    fit.posterior = posterior_on_grid(levels, search.free(), options.rate_prior);
    if (options.prior_sensitivity && fit.posterior.status == FitStatus::kOk) {
      fit.posterior.prior_effects =
          posterior_prior_effects(levels, search.free(), options.rate_prior);
    }
  }
  const PsychometricSearchResult found = search.find(
      levels, options.solver == Solver::kCeres ? minimised_by_ceres : minimised_by_newton);
  if (found.supremum == PsychometricSupremum::kNotConverged) {
    fit.status = FitStatus::kNotConverged;
    fit.reason = "the search for the optimum did not come to rest";
    return fit;
  }
  fit.status = FitStatus::kDegenerate;
  fit.reason = found.reason;
  fit.is_separated = found.supremum == PsychometricSupremum::kStep;
  if (found.supremum != PsychometricSupremum::kAttained) return fit;

  PsychometricCurve curve = found.optimum.curve;
  std::optional<BetaBinomialFit> scattered;
  if (options.overdispersion == Overdispersion::kBetaBinomial) {
    scattered =
        fit_beta_binomial(levels_by_row(data, levels), search.free(), curve, options.intervals);
    fit.status = scattered->status;
    fit.reason = scattered->reason;
    if (fit.status != FitStatus::kOk) return fit;
    curve = scattered->curve;
  }
  const double weber_fraction = curve.weber_fraction(levels);
  const double pse = free_pse ? curve.pse(levels) : options.reference;
  const bool relative = levels.logarithmic() || pse > 0.0;
  if (!std::isfinite(pse) || (relative && !(std::isfinite(weber_fraction) && pse > 0.0))) {
    fit.reason = "flat: the answers rise so little that the values exceed the range of numbers";
    return fit;
  }
  fit.status = FitStatus::kOk;
  fit.reason = relative ? "" : kNotRelative;
  if (relative) fit.weber_fraction = weber_fraction;
  fit.pse = pse;
  fit.lapse_rate = curve.lapse;
  const double log_likelihood = -psychometric_cost(levels, kMaximumLikelihood, curve).value;
  fit.log_likelihood = finite(log_likelihood);
  if (fit.log_likelihood) fit.deviance = deviance_of(levels, log_likelihood);
  add_parameters(fit, levels, curve);
  if (options.method == PsychometricMethod::kLeastSquares) {
    const double about_mean = sum_about_mean(levels);
    if (about_mean > 0.0) fit.r_squared = 1.0 - found.optimum.cost.value / about_mean;
  }
  if (scattered) {
    add_uncertainty(fit, *scattered);
  } else {
    add_uncertainty(fit, data, levels, options, search.free(), found.optimum);
  }
  if (options.num_bootstrap > 0 && relative) {
    fit.bootstrap = bootstrapped_weber_fraction(
        search, levels, curve, {options.num_bootstrap, options.seed, options.bootstrap_kind});
  }
  if (options.diagnostics) {
    fit.goodness =
        goodness_of_fit(search, levels, curve,
                        {options.num_goodness, options.seed, options.goodness_of_correlation});
  }
  if (options.intervals) fit.misfit_p_value = misfit_p_value(levels, search.free(), curve);
  add_psychometric_warnings(fit, data, levels, options, falls.has_value());
  return fit;
}

}  // namespace jnd::analysis
