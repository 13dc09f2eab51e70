#include "analysis/fits/psychometric_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/fits/psychometric_redraw.h"
#include "analysis/statistics/summary.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using core::kInfinity;
constexpr double kBootstrapTail = 0.025;

/// The refit's Weber fraction or, without an optimum, the limit it tends to; absent if the
/// answers identify nothing.
std::optional<double> fraction_or_limit(const PsychometricSearch& search,
                                        const PsychometricLevels& levels,
                                        const PsychometricCurve& fitted, int& num_degenerate) {
  const PsychometricSearchResult found = search.find(levels, minimised_by_newton, &fitted);
  if (found.supremum == PsychometricSupremum::kAttained) {
    return found.optimum.curve.weber_fraction(levels);
  }
  ++num_degenerate;
  if (found.supremum == PsychometricSupremum::kStep) return 0.0;
  if (found.supremum == PsychometricSupremum::kFlat) return kInfinity;
  return std::nullopt;
}

std::optional<double> end_at(const std::vector<double>& ascending, double probability) {
  const double value = percentile(ascending, probability);
  return std::isfinite(value) && value > 0.0 ? std::optional<double>(value) : std::nullopt;
}

/// Whether the interval was refused, because it would miss the estimate.
bool refused(Interval& interval, double estimate) {
  if (estimate >= interval.low.value_or(0.0) && estimate <= interval.high.value_or(kInfinity)) {
    return false;
  }
  interval = {};
  return true;
}

/// Skewness of the influence of single answers, over 6. Absent where leaving one answer out
/// leaves no fit.
std::optional<double> acceleration_of(const PsychometricSearch& search,
                                      const PsychometricLevels& levels,
                                      const PsychometricCurve& fitted) {
  struct LeftOut {
    double value, num_answers;
  };
  std::vector<LeftOut> all;
  PsychometricLevels without = levels;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (const double yes : {1.0, 0.0}) {
      const double num_answers =
          yes == 1.0 ? levels.num_yes[level] : levels.num_trials[level] - levels.num_yes[level];
      if (num_answers == 0.0 || levels.num_trials[level] < 2.0) continue;
      without.num_yes[level] -= yes;
      without.num_trials[level] -= 1.0;
      int num_degenerate = 0;
      const auto value = fraction_or_limit(search, without, fitted, num_degenerate);
      without.num_yes[level] += yes;
      without.num_trials[level] += 1.0;
      if (num_degenerate > 0 || !value || !std::isfinite(*value)) return std::nullopt;
      all.push_back({*value, num_answers});
    }
  }
  double sum = 0.0, num_answers = 0.0, squares = 0.0, cubes = 0.0;
  for (const LeftOut& one : all) {
    sum += one.num_answers * one.value;
    num_answers += one.num_answers;
  }
  for (const LeftOut& one : all) {
    const double influence = sum / num_answers - one.value;
    squares += one.num_answers * influence * influence;
    cubes += one.num_answers * influence * influence * influence;
  }
  if (!(squares > 0.0)) return std::nullopt;
  return cubes / (6.0 * std::pow(squares, 1.5));
}

/// BCa's place for a tail of the percentile interval.
double corrected_probability(double tail_z, double bias, double acceleration) {
  const double shifted = bias + tail_z;
  return core::standard_normal_cdf(bias + shifted / (1.0 - acceleration * shifted));
}

void add_bca(BootstrapInterval& result, const std::vector<double>& ascending, double estimate,
             std::optional<double> acceleration) {
  double below = 0.0;
  for (const double value : ascending) below += value < estimate ? 1.0 : 0.0;
  for (const double value : ascending) below += value == estimate ? 0.5 : 0.0;
  const double share = below / static_cast<double>(ascending.size());
  if (!(share > 0.0 && share < 1.0)) {
    result.bca_reason = "all refits lie on one side of the estimate";
    return;
  }
  if (!acceleration) {
    result.bca_reason = "without one of the answers there is no fit: no acceleration";
    return;
  }
  const double bias = core::standard_normal_quantile(share);
  const double z = core::standard_normal_quantile(kBootstrapTail);
  const double low = corrected_probability(z, bias, *acceleration);
  const double high = corrected_probability(-z, bias, *acceleration);
  result.bias_correction = bias;
  result.acceleration = acceleration;
  result.bca_ci95 = {.low = end_at(ascending, low), .high = end_at(ascending, high)};
  if (!(low < high) || refused(result.bca_ci95, estimate)) {
    result.bca_ci95 = {};
    result.bca_reason = "refused, because it would miss the estimate";
  }
}

}  // namespace

BootstrapInterval bootstrapped_weber_fraction(const PsychometricSearch& search,
                                              const PsychometricLevels& levels,
                                              const PsychometricCurve& fitted,
                                              const BootstrapOptions& options) {
  const bool parametric = options.kind == BootstrapKind::kParametric;
  const AnswerRedraw redraw = parametric ? AnswerRedraw(levels, fitted) : AnswerRedraw(levels);
  core::RandomStream random(options.seed, "bootstrap of a psychometric function");
  PsychometricLevels redrawn = levels;
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(options.num_refits));
  BootstrapInterval result;
  result.n = options.num_refits;
  for (int refit = 0; refit < options.num_refits; ++refit) {
    redraw.draw(random, redrawn);
    const auto value = fraction_or_limit(search, redrawn, fitted, result.num_degenerate);
    if (value) values.push_back(*value);
  }
  result.method = parametric ? "parametric, percentile" : "nonparametric, percentile";
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  result.ci95 = {.low = end_at(values, kBootstrapTail),
                 .high = end_at(values, 1.0 - kBootstrapTail)};
  const double estimate = fitted.weber_fraction(levels);
  if (refused(result.ci95, estimate)) {
    result.method += "; refused, because it would miss the estimate";
  }
  add_bca(result, values, estimate, acceleration_of(search, levels, fitted));
  return result;
}

}  // namespace jnd::analysis
