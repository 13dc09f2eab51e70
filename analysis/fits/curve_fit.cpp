#include "analysis/fits/curve_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "analysis/fits/bootstrap_ends.h"
#include "analysis/fits/curve_profile.h"
#include "analysis/fits/curve_resamples.h"
#include "analysis/fits/posterior_axis.h"
#include "analysis/fits/psychometric_goodness.h"
#include "analysis/fits/psychometric_posterior.h"
#include "analysis/fits/psychometric_warnings.h"
#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using Kind = CurveQuantity::Kind;
using enum PsychometricMethod;

/// A search over many curves uses at most this many levels.
constexpr std::size_t kMostLevelsOfMany = 2048;
constexpr std::size_t kMostPoints = 200;

/// A quantity, and the field of the result that receives it.
struct Told {
  CurveQuantity quantity;
  CurveValue* value;
};

std::vector<Told> told_of(CurveFit& fit, const FreeParameters& free) {
  const double half = 0.5;
  std::vector<Told> all = {
      {{Kind::kLocation, half}, &fit.location},
      {{Kind::kScale, half}, &fit.scale},
      {{Kind::kThreshold, half}, &fit.pse},
      {{Kind::kDistance, level_of_f(fit.model, fit.jnd_at)}, &fit.jnd},
      {{Kind::kGuess, half}, &fit.guess_rate},
      {{Kind::kLapse, half}, &fit.lapse_rate},
  };
  // A known rate has no interval.
  if (!free[3] && !free[2]) all.resize(4);
  for (CurveThreshold& one : fit.thresholds) {
    if (one.is_by_proportion) {
      all.push_back({{Kind::kThresholdOfProportion, one.proportion}, &one.intensity});
      all.push_back({{Kind::kSlopeOfProportion, one.proportion}, &one.slope});
      continue;
    }
    const double level = level_of_f(fit.model, one.at);
    all.push_back({{Kind::kThreshold, level}, &one.intensity});
    all.push_back({{Kind::kSlope, level}, &one.slope});
  }
  return all;
}

std::vector<CurveQuantity> quantities_of(const std::vector<Told>& all) {
  std::vector<CurveQuantity> quantities;
  for (const Told& one : all) quantities.push_back(one.quantity);
  return quantities;
}

std::optional<double> finite_value(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

FoundCurve of_many(const FoundCurve& fit) {
  if (fit.levels.size() <= kMostLevelsOfMany) return fit;
  FoundCurve result{
      .levels = binned(fit.levels, kMostLevelsOfMany), .found = fit.found, .free = fit.free};
  result.found.optimum =
      minimised_by_newton(result.levels, kMaximumLikelihood, fit.free, fit.found.optimum.curve);
  return result;
}

void add_bootstrap(CurveFit& fit, std::vector<Told>& all, const FoundCurve& found,
                   const CurveOptions& options) {
  const std::vector<CurveQuantity> quantities = quantities_of(all);
  CurveResamples drawn = resampled(found, fit.model, quantities, options.num_bootstrap,
                                   options.bootstrap_kind, options.seed);
  fit.num_bootstrap = options.num_bootstrap;
  fit.bootstrap_kind = options.bootstrap_kind;
  fit.num_bootstrap_degenerate = drawn.num_degenerate;
  const auto acceleration = accelerations(found, fit.model, quantities);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<double>& values = drawn.values[i];
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty() || !all[i].value->value) continue;
    std::ranges::sort(values);
    const BootstrapEnds ends = bootstrap_ends(values, *all[i].value->value, acceleration[i]);
    all[i].value->bootstrap_ci95 = ends.ci95;
    all[i].value->bca_ci95 = ends.bca_ci95;
    all[i].value->bca_reason = ends.bca_reason;
  }
}

/// Adds the posterior medians that follow from other weights of the rates' prior.
void add_prior_effects(const CurveFit& fit, std::vector<Told>& all,
                       const PsychometricLevels& levels, const FreeParameters& free,
                       const BetaPrior& rates) {
  for (const double weight : kOtherPriorWeights) {
    const PosteriorGrid grid = posterior_grid(levels, free, rates.weighed(weight));
    for (const Told& one : all) {
      const auto quantiles = grid.quantiles([&](const PsychometricCurve& curve) {
        return value_of(one.quantity, fit.model, levels, curve);
      });
      one.value->posterior_medians_by_weight.push_back(finite_value(quantiles[0]));
    }
  }
}

void add_posterior(CurveFit& fit, std::vector<Told>& all, const PsychometricLevels& every_level,
                   const FreeParameters& free, const CurveOptions& options) {
  const PsychometricLevels levels = binned(every_level, 200);
  const PosteriorGrid grid = posterior_grid(levels, free, options.rate_prior);
  if (!grid.reason.empty()) {
    fit.posterior_note = "no posterior: " + grid.reason;
    return;
  }
  fit.posterior_priors = grid.priors;
  for (const Told& one : all) {
    const auto [median, low, high] = grid.quantiles([&](const PsychometricCurve& curve) {
      return value_of(one.quantity, fit.model, levels, curve);
    });
    one.value->posterior_median = finite_value(median);
    one.value->posterior_ci95 = {finite_value(low), finite_value(high)};
  }
  if (options.prior_sensitivity) {
    add_prior_effects(fit, all, levels, free, options.rate_prior);
  }
  constexpr double kMuch = 0.025;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (const bool at_high : {false, true}) {
      const PosteriorAxis& its = grid.axes[axis];
      const double end = at_high ? grid.prior[axis].high : grid.prior[axis].low;
      const bool reaches = std::fabs((at_high ? its.high : its.low) - end) < 0.5 * its.step();
      if (reaches &&
          mass_beyond(its, grid.marginals[axis], at_high, its.high - its.low) > kMuch) {
        fit.posterior_note =
            "the answers do not bound the curve within the prior: the posterior rests on it";
      }
    }
  }
}

/// The p value of the misfit. The exact moments of the deviance need a sum over every possible
/// count. If a level has very many answers, chi-squared replaces them.
std::optional<double> misfit_of(const CurveFit& fit, const PsychometricLevels& levels,
                                const FreeParameters& free, const PsychometricCurve& curve) {
  constexpr double kManyAnswers = 1e4;
  const bool are_many = std::ranges::any_of(
      levels.num_trials, [](double num_trials) { return num_trials > kManyAnswers; });
  if (!are_many) return misfit_p_value(binned(levels, kMostLevelsOfMany), free, curve);
  const int degrees_of_freedom = residual_degrees_of_freedom(levels, free, curve);
  if (degrees_of_freedom < 1 || !fit.deviance) return std::nullopt;
  return chi_squared_above(*fit.deviance, degrees_of_freedom);
}

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// The proportion of yes at the curve's upper or lower end.
double one_end(const CurveFit& fit, bool is_upper) {
  const double lapse = fit.lapse_rate.value.value_or(0.0);
  if (is_upper) return 1.0 - lapse;
  return fit.guess_rate.value.value_or(0.0) + (fit.model.symmetric ? lapse : 0.0);
}

/// Computes the levels that belong to the requested proportions. A curve that never reaches a
/// proportion has no threshold and no interval there, so its entries are removed from `all`.
void settle_proportions(CurveFit& fit, std::vector<Told>& all, const PsychometricLevels& levels,
                        const PsychometricCurve& curve) {
  for (CurveThreshold& one : fit.thresholds) {
    if (!one.is_by_proportion) continue;
    const double level = level_of_proportion(fit.model, levels, curve, one.proportion);
    one.at = fit.model.falling ? 1.0 - level : level;
    if (level > 0.0 && level < 1.0) continue;
    std::erase_if(all, [&one](const Told& told) {
      return told.value == &one.intensity || told.value == &one.slope;
    });
  }
}

void add_warnings(CurveFit& fit, const PsychometricLevels& levels, const FreeParameters& free,
                  const PsychometricCurve& curve, const CurveOptions& options) {
  const bool are_few = have_fewer_answers(levels, kFewAnswers);
  if (fit.num_bootstrap > 0 && fit.num_bootstrap < kFewestRefits) {
    fit.warnings.push_back(too_few_refits());
  }
  if (fit.num_bootstrap > 0 && are_few) {
    fit.warnings.emplace_back(
        "bootstrap intervals hold the truth too rarely at so few answers a level: rather use "
        "the likelihood ratio's");
  }
  if (options.intervals && are_few && levels.size() < 30) {
    fit.warnings.emplace_back(
        "with so few answers a level, likelihood-ratio intervals hold the truth somewhat too "
        "rarely (91 to 93 % at five answers a level, not 95 %)");
  }
  for (const CurveThreshold& one : fit.thresholds) {
    if (!one.intensity.value && one.is_by_proportion) {
      fit.warnings.push_back("no threshold at a proportion of " + shown(one.proportion) +
                             ": the fitted curve runs from " + shown(one_end(fit, false)) +
                             " to " + shown(one_end(fit, true)) + " and never has that");
    }
    if (!one.intensity.value) continue;
    const double at = *one.intensity.value;
    if (at < levels.intensity.front() || at > levels.intensity.back()) {
      fit.warnings.push_back("the threshold at " + shown(one.at) +
                             " lies beyond the stimuli: it rests on the curve's form alone");
    }
  }
  const auto misfit = misfit_of(fit, levels, free, curve);
  const bool is_far = fit.goodness_p_value ? *fit.goodness_p_value < 0.05
                                           : misfit.has_value() && *misfit < 0.01;
  if (is_far) {
    fit.warnings.push_back(
        "the answers lie farther from the curve than chance has them: the curve is not theirs, "
        "and the intervals are too narrow" +
        std::string(free[2] || free[3] ? "" : "; --lapse free fits a lapse rate"));
  }
  const double lapses = fit.lapse_rate.value.value_or(0.0);
  if (options.model.free_lapse && lapses > 0.2) {
    fit.warnings.emplace_back(
        "more than one answer in five looks like a lapse: few answers lie on the upper end, or "
        "the curve is not theirs");
  }
}

std::vector<CurvePoint> points_of(const PsychometricLevels& every_level, bool falling) {
  const PsychometricLevels levels = binned(every_level, kMostPoints);
  std::vector<CurvePoint> points;
  const auto add = [&](double intensity, double yes, double trials) {
    points.push_back({intensity, falling ? trials - yes : yes, trials});
  };
  if (levels.zero_trials > 0.0) add(0.0, levels.zero_yes, levels.zero_trials);
  const bool is_binned = every_level.size() > kMostPoints;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    add(is_binned ? levels.intensity_at(levels.abscissa[i]) : levels.intensity[i],
        levels.num_yes[i], levels.num_trials[i]);
  }
  return points;
}

void require_levels(const CurveOptions& options) {
  for (const double at : options.at) {
    core::require(at > 0.0 && at < 1.0, "at", "a number between 0 and 1", at);
  }
  for (const double proportion : options.at_proportion) {
    core::require(proportion > 0.0 && proportion < 1.0, "at_proportion",
                  "a number between 0 and 1", proportion);
  }
  core::require(options.jnd_at > 0.0 && options.jnd_at < 1.0 && options.jnd_at != 0.5, "jnd_at",
                "a number between 0 and 1 that is not 0.5", options.jnd_at);
}

}  // namespace

double CurveFit::probability(double intensity) const {
  const double guess = guess_rate.value.value_or(0.0), lapse = lapse_rate.value.value_or(0.0);
  const Sigmoid sigmoid = traits_of(model.family).sigmoid;
  const bool weibull = model.family == CurveFamily::kWeibull;
  double f = 0.0;
  if (intensity > 0.0 || !model.is_logarithmic()) {
    const double x = model.is_logarithmic() ? std::log(intensity) : intensity;
    const double from = weibull ? std::log(*location.value) : *location.value;
    const double standard = weibull ? (x - from) * *scale.value : (x - from) / *scale.value;
    f = sigmoid_tails(sigmoid,
                      standard + sigmoid_quantile(sigmoid, traits_of(model.family).at_location))
            .lower;
  }
  const double s = model.falling ? 1.0 - f : f;
  return model.symmetric ? guess + lapse + (1.0 - guess - 2.0 * lapse) * s
                         : guess + (1.0 - guess - lapse) * s;
}

FoundCurve found_curve(const std::vector<AnswerCount>& rows, const CurveModel& model) {
  FoundCurve result{.levels = levels_of(rows, model), .found = {}};
  // The lapses of a falling curve are the guesses of the engine's rising curve.
  const bool exchanged = model.falling && !model.symmetric;
  const bool free_upper = exchanged ? model.free_guess : model.free_lapse;
  // A grid over very many levels is slow, and their likelihood has few minima, so the levels
  // are binned. Without a grid all levels are used, because they decide exactly whether an
  // optimum exists.
  constexpr std::size_t kMostLevelsOfGrid = 200;
  const auto search_over = [&](const PsychometricLevels& levels) {
    const PsychometricSearch search(levels, kMaximumLikelihood, true, free_upper);
    result.free = search.free();
    return search.find(levels, minimised_by_newton);
  };
  const PsychometricLevels few = binned(result.levels, kMostLevelsOfGrid);
  if (few.size() == result.levels.size() || result.levels.ends.are_bare(free_upper)) {
    result.found = search_over(result.levels);
    return result;
  }
  result.found = search_over(few);
  if (result.found.supremum != PsychometricSupremum::kAttained) return result;
  result.found.optimum = minimised_by_newton(result.levels, kMaximumLikelihood, result.free,
                                             result.found.optimum.curve);
  if (!result.found.optimum.converged) {
    result.found.supremum = PsychometricSupremum::kNotConverged;
  }
  return result;
}

CurveFit fit_curve(const std::vector<AnswerCount>& rows, const CurveOptions& options) {
  require_levels(options);
  CurveFit fit;
  fit.model = options.model;
  fit.jnd_at = options.jnd_at;
  for (const AnswerCount& row : rows) fit.num_trials += row.num_trials;
  for (const double at : options.at)
    fit.thresholds.push_back({.at = at, .intensity = {}, .slope = {}});
  for (const double proportion : options.at_proportion) {
    fit.thresholds.push_back({.at = std::nan(""),
                              .proportion = proportion,
                              .is_by_proportion = true,
                              .intensity = {},
                              .slope = {}});
  }
  const FoundCurve found = found_curve(rows, options.model);
  const PsychometricLevels& levels = found.levels;
  fit.num_levels = static_cast<int>(levels.size()) + (levels.zero_trials > 0.0 ? 1 : 0);
  fit.points = points_of(levels, options.model.falling);
  std::vector<Told> all = told_of(fit, found.free);
  if (options.posterior) add_posterior(fit, all, levels, found.free, options);
  if (found.found.supremum == PsychometricSupremum::kNotConverged) {
    fit.status = FitStatus::kNotConverged;
    fit.reason = "the search for the optimum did not come to rest";
    return fit;
  }
  fit.status = FitStatus::kDegenerate;
  fit.reason = found.found.reason;
  if (found.found.supremum != PsychometricSupremum::kAttained) return fit;

  const PsychometricCurve& curve = found.found.optimum.curve;
  const CurveRates rates = rates_of(options.model, levels, curve);
  fit.guess_rate.value = rates.guess;
  fit.lapse_rate.value = rates.lapse;
  settle_proportions(fit, all, levels, curve);
  for (const Told& one : all) {
    one.value->value = finite_value(value_of(one.quantity, options.model, levels, curve));
  }
  if (!fit.location.value || !fit.scale.value || !fit.pse.value) {
    fit.reason = "flat: the answers rise so little that the values exceed the range of numbers";
    return fit;
  }
  fit.status = FitStatus::kOk;
  fit.reason.clear();
  for (CurveThreshold& one : fit.thresholds) {
    if (one.is_by_proportion) continue;
    const double low = options.model.symmetric ? rates.guess + rates.lapse : rates.guess;
    one.proportion = low + one.at * levels.ends.rise(curve.lapse, curve.guess);
  }
  const double log_likelihood = -found.found.optimum.cost.value;
  const int k = options.model.num_parameters();
  fit.log_likelihood = finite_value(log_likelihood);
  fit.deviance = deviance_of(levels, log_likelihood);
  fit.aic = 2.0 * k - 2.0 * log_likelihood;
  fit.bic = k * std::log(static_cast<double>(fit.num_trials)) - 2.0 * log_likelihood;
  const int degrees_of_freedom = residual_degrees_of_freedom(levels, found.free, curve);
  if (degrees_of_freedom > 0) {
    fit.overdispersion = pearson_statistic(levels, curve) / degrees_of_freedom;
  }
  const FoundCurve few = of_many(found);
  if (options.intervals) {
    for (const Told& one : all) {
      one.value->ci95 = profile_interval(one.quantity, options.model, few.levels, few.free,
                                         few.found.optimum);
    }
  }
  if (options.num_bootstrap > 0) add_bootstrap(fit, all, few, options);
  if (options.num_goodness > 0) {
    const PsychometricSearch search(few.levels, kMaximumLikelihood, true, few.free[2]);
    const PsychometricGoodness goodness = goodness_of_fit(
        search, few.levels, few.found.optimum.curve,
        {.num = options.num_goodness, .seed = options.seed, .correlation = false});
    fit.goodness_p_value = goodness.p_value;
    fit.goodness_reason = goodness.reason;
  }
  add_warnings(fit, levels, found.free, curve, options);
  return fit;
}

bool answers_fall(const std::vector<std::vector<AnswerCount>>& groups) {
  constexpr double kBeyond = -2.0;
  double sum = 0.0, variance = 0.0;
  for (const std::vector<AnswerCount>& rows : groups) {
    double trials = 0.0, yes = 0.0, x = 0.0;
    for (const AnswerCount& row : rows) {
      trials += static_cast<double>(row.num_trials);
      yes += static_cast<double>(row.num_yes);
      x += static_cast<double>(row.num_trials) * row.intensity;
    }
    if (!(trials > 1.0)) continue;
    const double share = yes / trials, mean = x / trials;
    double squares = 0.0, together = 0.0;
    for (const AnswerCount& row : rows) {
      const double from_mean = row.intensity - mean;
      together +=
          (static_cast<double>(row.num_yes) - share * static_cast<double>(row.num_trials)) *
          from_mean;
      squares += static_cast<double>(row.num_trials) * from_mean * from_mean;
    }
    if (!(squares > 0.0)) continue;
    // Dividing by the deviation makes groups with different units comparable.
    const double unit = std::sqrt(squares);
    sum += together / unit;
    variance += share * (1.0 - share);
  }
  return variance > 0.0 && sum / std::sqrt(variance) < kBeyond;
}

}  // namespace jnd::analysis
