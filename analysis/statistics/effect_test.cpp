#include "analysis/statistics/effect_test.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/distributions.h"
#include "analysis/statistics/summary.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

double above(const EffectEstimate& estimate, double threshold) {
  return student_t_above((estimate.effect - threshold) / estimate.standard_error,
                         estimate.degrees_of_freedom);
}

}  // namespace

double p_value_of(const EffectEstimate& estimate, Tail tail) {
  const double greater = above(estimate, 0.0);
  if (tail == Tail::kGreater) return greater;
  const EffectEstimate turned{-estimate.effect, estimate.standard_error,
                              estimate.degrees_of_freedom};
  const double less = above(turned, 0.0);
  return tail == Tail::kLess ? less : std::min(1.0, 2.0 * std::min(greater, less));
}

Interval interval_of(const EffectEstimate& estimate, double confidence) {
  core::require(confidence > 0.0 && confidence < 1.0, "confidence", "a number between 0 and 1",
                confidence);
  const double reach =
      estimate.standard_error *
      student_t_quantile_above(0.5 * (1 - confidence), estimate.degrees_of_freedom);
  return {estimate.effect - reach, estimate.effect + reach};
}

double equivalence_p_value(const EffectEstimate& estimate, double margin) {
  core::require(margin > 0.0, "margin", "a number > 0", margin);
  const EffectEstimate turned{-estimate.effect, estimate.standard_error,
                              estimate.degrees_of_freedom};
  // The two tests are that the effect is not at or below -margin, and that it is not at or
  // above the margin.
  return std::max(above(estimate, -margin), above(turned, -margin));
}

std::optional<EffectEstimate> contrast_estimate(
    const std::vector<std::vector<double>>& scores_by_group) {
  double effect = 0.0, variance = 0.0, squares = 0.0;
  for (const std::vector<double>& scores : scores_by_group) {
    const Summary summary = summary_of(scores);
    if (!summary.standard_deviation) return std::nullopt;
    const auto n = static_cast<double>(scores.size());
    const double own = *summary.standard_deviation * *summary.standard_deviation / n;
    effect += *summary.mean;
    variance += own;
    squares += own * own / (n - 1.0);
  }
  if (!(variance > 0.0) || !(squares > 0.0)) return std::nullopt;
  return EffectEstimate{effect, std::sqrt(variance), variance * variance / squares};
}

std::vector<std::optional<double>> bonferroni_adjusted(
    const std::vector<std::optional<double>>& p_values) {
  const auto num_tests = static_cast<double>(std::ranges::count_if(
      p_values, [](const std::optional<double>& one) { return one.has_value(); }));
  std::vector<std::optional<double>> adjusted = p_values;
  for (std::optional<double>& one : adjusted) {
    if (one) one = std::min(1.0, *one * num_tests);
  }
  return adjusted;
}

}  // namespace jnd::analysis
