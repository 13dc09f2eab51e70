#include "experiments/adaptive/quest_plus_estimate.h"

#include <algorithm>
#include <cmath>

#include "core/psychometric_function.h"

namespace jnd::experiments {
namespace {

double in_its_scale(const QuestPlusParameter& parameter, double value) noexcept {
  return parameter.is_ratio ? std::log(value) : value;
}

/// Returns the first value up to which the cumulative probability is at least this.
double quantile(const std::vector<double>& values, const std::vector<double>& weights,
                double probability) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    sum += weights[i];
    if (sum >= probability) return values[i];
  }
  return values.back();
}

}  // namespace

QuestPlusEstimate estimate_of(const QuestPlusParameter& parameter,
                              const std::vector<double>& weights, double confidence) {
  const std::vector<double>& values = parameter.grid.values;
  double mean = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    mean += weights[i] * in_its_scale(parameter, values[i]);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double deviation = in_its_scale(parameter, values[i]) - mean;
    variance += weights[i] * deviation * deviation;
  }
  const double tail = 0.5 * (1.0 - confidence);
  const double estimate =
      std::clamp(parameter.is_ratio ? std::exp(mean) : mean, values.front(), values.back());
  const double z = core::standard_normal_quantile(tail);
  const double enough = std::min(
      tail, std::exp(-0.5 * z * z) * *std::max_element(weights.begin(), weights.end()));
  const auto reached = [&](std::size_t end) {
    return values.size() > 1 && weights[end] >= enough ? std::optional(values[end])
                                                       : std::nullopt;
  };
  return {.name = parameter.name,
          .mean = estimate,
          .sd = std::sqrt(variance),
          .low = std::min(estimate, quantile(values, weights, tail)),
          .high = std::max(estimate, quantile(values, weights, 1.0 - tail)),
          .reached_low = reached(0),
          .reached_high = reached(values.size() - 1)};
}

}  // namespace jnd::experiments
