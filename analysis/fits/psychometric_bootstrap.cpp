#include "analysis/fits/psychometric_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/fits/bootstrap_ends.h"
#include "analysis/fits/psychometric_redraw.h"
#include "analysis/fits/psychometric_refit.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using core::kInfinity;

/// The Weber fraction of the refit. Without an optimum it is the limit that the fraction tends
/// to. It is absent if the answers identify nothing.
std::optional<double> fraction_or_limit(const PsychometricRefit& refit,
                                        const PsychometricLevels& levels, int& num_degenerate) {
  const PsychometricSearchResult found = refit.find(levels);
  if (found.supremum == PsychometricSupremum::kAttained) {
    return found.optimum.curve.weber_fraction(levels);
  }
  ++num_degenerate;
  if (found.supremum == PsychometricSupremum::kStep) return 0.0;
  if (found.supremum == PsychometricSupremum::kFlat) return kInfinity;
  return std::nullopt;
}

/// Opens ends at a Weber fraction of 0, which come from refits without an optimum.
void open_at_zero(Interval& interval) {
  if (interval.low && !(*interval.low > 0.0)) interval.low.reset();
  if (interval.high && !(*interval.high > 0.0)) interval.high.reset();
}

/// The acceleration: the skewness of the influence of single answers, divided by 6. It is
/// absent if some refit without one answer has no optimum.
std::optional<double> acceleration_by(const PsychometricRefit& refit,
                                      const PsychometricLevels& levels) {
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
      const auto value = fraction_or_limit(refit, without, num_degenerate);
      without.num_yes[level] += yes;
      without.num_trials[level] += 1.0;
      if (num_degenerate > 0 || !value || !std::isfinite(*value)) return std::nullopt;
      all.push_back({*value, num_answers});
    }
  }
  return acceleration_of(all);
}

}  // namespace

BootstrapInterval bootstrapped_weber_fraction(const PsychometricSearch& search,
                                              const PsychometricLevels& levels,
                                              const PsychometricCurve& fitted,
                                              const BootstrapOptions& options) {
  const bool parametric = options.kind == BootstrapKind::kParametric;
  const AnswerRedraw redraw = parametric ? AnswerRedraw(levels, fitted) : AnswerRedraw(levels);
  const PsychometricRefit refit(search, levels, fitted);
  core::RandomStream random(options.seed, "bootstrap of a psychometric function");
  PsychometricLevels redrawn = levels;
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(options.num_refits));
  BootstrapInterval result;
  result.n = options.num_refits;
  for (int draw = 0; draw < options.num_refits; ++draw) {
    redraw.draw(random, redrawn);
    const auto value = fraction_or_limit(refit, redrawn, result.num_degenerate);
    if (value) values.push_back(*value);
  }
  result.method = parametric ? "parametric, percentile" : "nonparametric, percentile";
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  const std::optional<double> acceleration = acceleration_by(refit, levels);
  BootstrapEnds ends = bootstrap_ends(values, fitted.weber_fraction(levels), acceleration);
  open_at_zero(ends.ci95);
  open_at_zero(ends.bca_ci95);
  result.ci95 = ends.ci95;
  if (ends.is_refused) result.method += "; refused, because it would miss the estimate";
  result.bca_ci95 = ends.bca_ci95;
  result.bca_reason = ends.bca_reason;
  result.bias_correction = ends.bias_correction;
  if (ends.bias_correction) result.acceleration = acceleration;
  return result;
}

}  // namespace jnd::analysis
