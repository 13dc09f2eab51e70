#include "analysis/fits/psychometric_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <numbers>

#include "analysis/fits/interval_order_fit.h"
#include "analysis/fits/psychometric_bootstrap.h"
#include "analysis/fits/psychometric_goodness.h"
#include "analysis/fits/psychometric_interval.h"
#include "analysis/fits/psychometric_posterior.h"
#include "analysis/fits/psychometric_search.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr auto kMaximumLikelihood = PsychometricMethod::kMaximumLikelihood;
/// Half the 95 % quantile of chi-squared with one degree of freedom.
constexpr double kLikelihoodDrop = 1.9207294103470617;

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
    return 0.0;  // Whatever rounding makes of their mean.
  }
  double mean = 0.0;
  for (const double proportion : proportions) mean += proportion;
  mean /= static_cast<double>(proportions.size());
  double sum = 0.0;
  for (const double proportion : proportions) sum += (proportion - mean) * (proportion - mean);
  return sum;
}

/// Derivatives of w in slope, offset and lapse: of exp(c unit / slope) - 1, or, the pse being
/// origin - unit offset / slope, of c unit / (slope origin - unit offset).
Eigen::Vector3d fraction_gradient(const PsychometricLevels& levels,
                                  const PsychometricCurve& curve) {
  const double step = sigmoid_jnd(levels.sigmoid) * levels.unit / curve.slope;
  if (levels.logarithmic()) return {-std::exp(step) * step / curve.slope, 0.0, 0.0};
  const double pse = curve.pse(levels);
  return {-step * levels.origin / (curve.slope * pse * pse),
          step * levels.unit / (curve.slope * pse * pse), 0.0};
}

/// Standard error of w by the delta method, the matrix being that of the information over its
/// `scale`. A lapse on its bound is held there.
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

void add_uncertainty(PsychometricFit& fit, const PsychometricLevels& levels,
                     const PsychometricOptions& options, const FreeParameters& free,
                     const PsychometricOptimum& optimum) {
  const bool free_pse = free[1];
  double drop = kLikelihoodDrop;
  if (options.method == kMaximumLikelihood) {
    fit.standard_error = standard_error(levels, optimum.curve, free, optimum.cost.hessian, 1.0);
  } else {
    const int degrees_of_freedom = fit.num_levels - 1 - free[1] - free[2];
    if (free_pse) fit.pse_ci95 = Interval{};
    if (degrees_of_freedom < 1) return;
    const double variance = optimum.cost.value / degrees_of_freedom;
    fit.standard_error = standard_error(levels, optimum.curve, free,
                                        squared_jacobian(levels, optimum.curve), variance);
    drop =
        variance * boost::math::quantile(boost::math::fisher_f(1.0, degrees_of_freedom), 0.95);
  }
  if (!options.intervals) return;
  fit.weber_fraction_ci95 =
      weber_fraction_interval(levels, options.method, free, optimum, drop);
  if (free_pse) {
    fit.pse_ci95 = pse_interval(levels, options.method, free, optimum, drop);
  }
}

/// The curve in the family's own words.
void add_parameters(PsychometricFit& fit, const PsychometricLevels& levels,
                    const PsychometricCurve& curve) {
  switch (levels.family) {
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

/// Whether the deviance is beyond what chi-squared with as many degrees of freedom has in one
/// of a hundred data sets.
bool is_far_off(const PsychometricFit& fit, int degrees_of_freedom) {
  constexpr double kLevel = 0.01;
  if (degrees_of_freedom < 1 || !fit.deviance) return false;
  const boost::math::chi_squared chance(degrees_of_freedom);
  return boost::math::cdf(boost::math::complement(chance, *fit.deviance)) < kLevel;
}

bool all_alike(const std::vector<AnswerCount>& data) {
  const auto none = [](const AnswerCount& row) { return row.num_yes == 0; };
  const auto every = [](const AnswerCount& row) { return row.num_yes == row.num_trials; };
  return std::ranges::all_of(data, none) || std::ranges::all_of(data, every);
}

/// What the value rests on, where that is less than it seems.
void add_doubts(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                const PsychometricLevels& levels, int degrees_of_freedom) {
  if (all_alike(data)) {
    fit.warnings.emplace_back(
        "every answer is the same: the Weber fraction rests on the assumed pse alone");
  }
  if (*fit.pse * (1.0 + *fit.weber_fraction) > levels.intensity.back()) {
    fit.warnings.emplace_back(
        "the Weber fraction lies beyond the stimuli: no level is as high as where the curve is "
        "84.13 %");
  }
  // Least squares does not seek the lowest deviance, and a simulated p goes before.
  const bool other =
      fit.method == PsychometricMethod::kLeastSquares || fit.goodness.p_value.has_value();
  if (!other && is_far_off(fit, degrees_of_freedom)) {
    fit.warnings.emplace_back(
        "the answers lie farther from the curve than chance has them (deviance, chi-squared: "
        "p < 0.01): the curve is not theirs, and the intervals are too narrow");
  }
}

/// What is known to make the intervals above too narrow.
void add_warnings(PsychometricFit& fit, const PsychometricLevels& levels,
                  const PsychometricOptions& options) {
  constexpr double kFewTrials = 15.0;
  double most_trials = levels.zero_trials;
  for (const double trials : levels.num_trials) most_trials = std::max(most_trials, trials);
  if (fit.bootstrap.n > 0 && most_trials < kFewTrials) {
    fit.warnings.emplace_back(
        "bootstrap intervals cover less than 95 % at so few answers a level (79 to 93 % at "
        "five): rather use the likelihood ratio's");
  }
  const bool free_pse = options.free_pse || traits_of(options.family).always_free_pse;
  if (free_pse && options.intervals && options.method == kMaximumLikelihood &&
      most_trials < kFewTrials) {
    fit.warnings.emplace_back(
        "with a free pse and so few answers a level, likelihood-ratio intervals hold the truth "
        "somewhat too rarely (92 % at five answers a level, not 95 %)");
  }
  if (options.method == PsychometricMethod::kLeastSquares) {
    fit.warnings.emplace_back(
        "least squares takes every level's proportion as equally precise, which they are not: "
        "rather use maximum likelihood's interval");
  }
  if (fit.goodness.p_value && *fit.goodness.p_value < 0.05) {
    fit.warnings.emplace_back(
        "the answers lie farther from the curve than chance has them (p < 0.05): the intervals "
        "are too narrow");
  }
}

}  // namespace

PsychometricFit fit_psychometric(const std::vector<AnswerCount>& data,
                                 const PsychometricOptions& options) {
  const bool free_pse = options.free_pse || traits_of(options.family).always_free_pse;
  const PsychometricLevels levels =
      pooled_levels(data, options.reference, free_pse, options.family);
  if (options.by_order && orders_vary(data)) {
    core::require(options.family == PsychometricFamily::kWeber &&
                      options.method == kMaximumLikelihood && !options.free_lapse &&
                      options.num_bootstrap == 0 && !options.posterior,
                  "by_order", "the Weber curve by maximum likelihood alone", 1.0);
    PsychometricFit fit = fit_by_interval_order(data, options);
    if (fit.status != FitStatus::kOk || !fit.order_effect_ln) return fit;
    add_warnings(fit, levels, options);
    add_doubts(fit, data, levels, fit.num_levels - (options.free_pse ? 3 : 2));
    return fit;
  }
  PsychometricFit fit;
  fit.family = options.family;
  fit.method = options.method;
  fit.num_levels = static_cast<int>(levels.size()) + (levels.zero_trials > 0.0 ? 1 : 0);
  for (const AnswerCount& row : data) fit.num_trials += row.num_trials;

  const PsychometricSearch search(levels, options.method, free_pse, options.free_lapse);
  if (options.posterior) fit.posterior = posterior_on_grid(levels, search.free());
  const PsychometricSearchResult found = search.find(
      levels, options.solver == Solver::kCeres ? minimised_by_ceres : minimised_by_newton);
  if (found.supremum == PsychometricSupremum::kNotConverged) {
    fit.status = FitStatus::kNotConverged;
    fit.reason = "the search for the optimum did not come to rest";
    return fit;
  }
  fit.status = FitStatus::kDegenerate;
  fit.reason = found.reason;
  if (found.supremum != PsychometricSupremum::kAttained) return fit;

  const PsychometricCurve& curve = found.optimum.curve;
  const double weber_fraction = curve.weber_fraction(levels);
  const double pse = free_pse ? curve.pse(levels) : options.reference;
  if (!levels.logarithmic() && !(pse > 0.0)) {
    fit.reason =
        "the pse is not above 0: there is nothing that a Weber fraction is relative to";
    return fit;
  }
  if (!(std::isfinite(weber_fraction) && std::isfinite(pse) && pse > 0.0)) {
    fit.reason = "flat: the answers rise so little that the values exceed the range of numbers";
    return fit;
  }
  fit.status = FitStatus::kOk;
  fit.weber_fraction = weber_fraction;
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
  add_uncertainty(fit, levels, options, search.free(), found.optimum);
  if (options.num_bootstrap > 0) {
    fit.bootstrap = bootstrapped_weber_fraction(
        search, levels, curve, {options.num_bootstrap, options.seed, options.bootstrap_kind});
  }
  if (options.diagnostics) {
    fit.goodness = goodness_of_fit(search, levels, curve, options.num_goodness, options.seed);
  }
  add_warnings(fit, levels, options);
  add_doubts(fit, data, levels,
             residual_degrees_of_freedom(levels, search.free(), curve.lapse));
  return fit;
}

}  // namespace jnd::analysis
