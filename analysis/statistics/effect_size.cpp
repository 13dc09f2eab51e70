#include "analysis/statistics/effect_size.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/distributions.h"
#include "analysis/statistics/root_finding.h"

namespace jnd::analysis {
namespace {

constexpr double kLargestT = 1000.0;

/// The noncentrality at which P(T <= t) is `probability`. P falls as the noncentrality grows.
std::optional<double> noncentrality_at(double t, double degrees_of_freedom,
                                       double probability) {
  const auto excess = [&](double noncentrality) {
    return noncentral_t_below(t, degrees_of_freedom, noncentrality) - probability;
  };
  double reach = 2.0;
  double low = t - reach, high = t + reach;
  while (!(excess(low) >= 0.0) || !(excess(high) <= 0.0)) {
    reach *= 2.0;
    if (reach > 8.0 * kLargestT) return std::nullopt;
    if (!(excess(low) >= 0.0)) low = t - reach;
    if (!(excess(high) <= 0.0)) high = t + reach;
  }
  const auto is_close = [](double a, double b) {
    return std::fabs(a - b) <= std::ldexp(1.0, -44) * std::min(std::fabs(a), std::fabs(b));
  };
  const auto [below, above] =
      root_bracket(excess, {low, excess(low)}, {high, excess(high)}, is_close, 198);
  const double found = 0.5 * (below + above);
  return std::isfinite(found) ? std::optional(found) : std::nullopt;
}

Interval scaled(const Interval& interval, double factor) {
  const auto times = [factor](const std::optional<double>& end) {
    return end ? std::optional(*end * factor) : std::nullopt;
  };
  return {times(interval.low), times(interval.high)};
}

}  // namespace

double hedges_factor(double degrees_of_freedom) {
  const double half = 0.5 * degrees_of_freedom;
  return std::exp(log_gamma(half) - log_gamma(half - 0.5)) / std::sqrt(half);
}

Interval noncentrality_ci95(double t, double degrees_of_freedom) {
  if (!(std::fabs(t) <= kLargestT)) return {};
  return {noncentrality_at(t, degrees_of_freedom, 0.975),
          noncentrality_at(t, degrees_of_freedom, 0.025)};
}

void add_effect_of_differences(Comparison& comparison, double cohen_dz, int num_values) {
  const double root = std::sqrt(static_cast<double>(num_values));
  const double degrees_of_freedom = num_values - 1.0;
  comparison.cohen_dz = cohen_dz;
  comparison.cohen_dz_ci95 =
      scaled(noncentrality_ci95(cohen_dz * root, degrees_of_freedom), 1.0 / root);
  if (num_values < 3) return;
  const double factor = hedges_factor(degrees_of_freedom);
  comparison.hedges_g = factor * cohen_dz;
  comparison.hedges_g_ci95 = scaled(comparison.cohen_dz_ci95, factor);
}

void add_effect_of_groups(Comparison& comparison, const PublishedGroup& a,
                          const PublishedGroup& b) {
  const double n_a = a.num_values, n_b = b.num_values;
  const double variance_a = a.standard_deviation * a.standard_deviation;
  const double variance_b = b.standard_deviation * b.standard_deviation;
  const double sum = variance_a + variance_b;
  const double error = variance_a / n_a + variance_b / n_b;
  const double degrees_of_freedom =
      (n_a - 1.0) * (n_b - 1.0) * sum * sum /
      ((n_b - 1.0) * variance_a * variance_a + (n_a - 1.0) * variance_b * variance_b);
  // If a group has two values and the other does not vary, the bias is unknown.
  constexpr double kTooFew = 1.0 + 1e-9;
  if (!(degrees_of_freedom > kTooFew)) return;
  const double of_test = error * error /
                         (variance_a * variance_a / (n_a * n_a * (n_a - 1.0)) +
                          variance_b * variance_b / (n_b * n_b * (n_b - 1.0)));
  const double difference = a.mean - b.mean;
  const double factor = hedges_factor(degrees_of_freedom);
  comparison.hedges_g = factor * difference / std::sqrt(0.5 * sum);
  comparison.hedges_g_ci95 = scaled(noncentrality_ci95(difference / std::sqrt(error), of_test),
                                    factor * std::sqrt(error / (0.5 * sum)));
}

Interval fisher_interval(double r, double standard_error_of_z) {
  if (!(std::fabs(r) < 1.0)) return {};
  const double reach = normal_quantile(0.975) * standard_error_of_z;
  const double z = std::atanh(r);
  return {std::tanh(z - reach), std::tanh(z + reach)};
}

}  // namespace jnd::analysis
