#include "analysis/statistics/sequential_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "analysis/statistics/distributions.h"
#include "analysis/statistics/root_finding.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// The z that is exceeded with this probability. It is always finite.
double z_above(double probability) {
  constexpr double kSmallest = std::numeric_limits<double>::min();
  // The smaller tail has more accurate digits.
  if (probability > 0.5) return -z_above(1.0 - probability);
  return normal_quantile_above(std::max(probability, kSmallest));
}

/// The z that is exceeded with the same probability as this t.
double z_of_t(double t, double degrees_of_freedom) {
  return std::copysign(z_above(student_t_above(std::fabs(t), degrees_of_freedom)), t);
}

/// The boundary that a normal statistic with mean `mean` and standard deviation 1 exceeds as
/// often as a noncentral t exceeds the boundary of t. At mean 0 it is the boundary of z itself.
double boundary_under(double z_boundary, double degrees_of_freedom, double mean) {
  if (!std::isfinite(z_boundary)) return z_boundary;
  const double tail = 0.5 * std::erfc(z_boundary / std::sqrt(2.0));
  const double t_boundary = student_t_quantile_above(tail, degrees_of_freedom);
  // Here almost all or nothing lies beyond the boundary. The approximation of Johnson and Welch
  // (1940) decides which.
  constexpr double kFar = 30.0;
  if (std::fabs(mean) > kFar) {
    const double spread = std::sqrt(1.0 + 0.5 * t_boundary * t_boundary / degrees_of_freedom);
    return z_boundary + mean * (1.0 - 1.0 / spread);
  }
  // If a series does not converge, its last value is close enough to 0 or 1.
  const double above =
      std::clamp(noncentral_t_above(t_boundary, degrees_of_freedom, mean), 0.0, 1.0);
  const double below =
      std::clamp(noncentral_t_below(t_boundary, degrees_of_freedom, mean), 0.0, 1.0);
  return mean + (above < below ? z_above(above) : -z_above(below));
}

}  // namespace

std::optional<SequentialEstimate> SequentialEstimate::of(const SequentialBoundaries& boundaries,
                                                         const SequentialOutcome& outcome) {
  if (!outcome.ended || outcome.estimates.empty() || !outcome.estimates.back()) {
    return std::nullopt;
  }
  return SequentialEstimate(boundaries, outcome);
}

double SequentialEstimate::probability_above(double effect) const {
  const std::vector<int>& looks = boundaries_.rule.looks;
  const std::size_t num_taken = outcome_.estimates.size();
  const EffectEstimate& last = *outcome_.estimates.back();
  // If the test is one-sided, signs are turned so that the boundary is above.
  const bool is_turned = boundaries_.rule.tail == Tail::kLess;
  const double sign = is_turned ? -1.0 : 1.0;
  const double people = looks[num_taken - 1];
  const double drift = sign * effect / (last.standard_error * std::sqrt(people));
  SequentialPaths paths({looks.begin(), looks.begin() + static_cast<std::ptrdiff_t>(num_taken)},
                        drift);
  double above = 0.0;
  for (std::size_t look = 0; look + 1 < num_taken; ++look) {
    const auto& estimate = outcome_.estimates[look];
    const double mean = drift * std::sqrt(looks[look]);
    double upper = core::kInfinity, lower = -core::kInfinity;
    if (estimate) {
      const double z = boundaries_.z[look], df = estimate->degrees_of_freedom;
      upper = boundary_under(z, df, mean);
      if (boundaries_.rule.tail == Tail::kTwoSided) lower = -boundary_under(z, df, -mean);
    }
    above += paths.above(upper);
    paths.go_on(lower, upper);
  }
  const double own =
      z_of_t(sign * (last.effect - effect) / last.standard_error, last.degrees_of_freedom);
  above += paths.above(own + drift * std::sqrt(people));
  above = std::clamp(above, 0.0, 1.0);
  return is_turned ? 1.0 - above : above;
}

double SequentialEstimate::probability_below(double effect) const {
  return 1.0 - probability_above(effect);
}

double SequentialEstimate::p_value() const {
  const double above = probability_above(0.0);
  switch (boundaries_.rule.tail) {
    case Tail::kGreater:
      return above;
    case Tail::kLess:
      return 1.0 - above;
    case Tail::kTwoSided:
      break;
  }
  return 2.0 * std::min(above, 1.0 - above);
}

std::optional<double> SequentialEstimate::effect_at(double probability) const {
  const EffectEstimate& last = *outcome_.estimates.back();
  double low = last.effect, high = low, reach = last.standard_error;
  // The larger the effect, the more likely is a higher outcome.
  constexpr int kDoublings = 12;
  for (int i = 0; i < kDoublings && probability_above(low) >= probability; ++i) {
    low -= reach;
    reach *= 2.0;
  }
  reach = last.standard_error;
  for (int i = 0; i < kDoublings && probability_above(high) <= probability; ++i) {
    high += reach;
    reach *= 2.0;
  }
  if (!(probability_above(low) < probability && probability < probability_above(high))) {
    return std::nullopt;
  }
  const double tolerance = 1e-6 * last.standard_error;
  const auto excess = [&](double effect) { return probability_above(effect) - probability; };
  std::tie(low, high) = root_bracket(
      excess, {low, excess(low)}, {high, excess(high)},
      [=](double a, double b) { return std::fabs(b - a) <= tolerance; }, 98);
  return 0.5 * (low + high);
}

std::optional<double> SequentialEstimate::median_unbiased() const { return effect_at(0.5); }

Interval SequentialEstimate::interval(double confidence) const {
  core::require(confidence > 0.0 && confidence < 1.0, "confidence", "a number between 0 and 1",
                confidence);
  const double outside = 0.5 * (1.0 - confidence);
  return {effect_at(outside), effect_at(1.0 - outside)};
}

}  // namespace jnd::analysis
