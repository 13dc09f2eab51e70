#include "analysis/groups/summary.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// Fewer draw too few different resamples: two persons give three.
constexpr std::size_t kFewestParticipants = 5;

/// The tail that gives a bootstrap of n values the reach of Student's t: plain percentiles are
/// too narrow by sqrt((n-1)/n) and by the normal's shorter tails (Hesterberg 2015, expanded
/// percentiles).
double expanded_tail(std::size_t num_values) {
  if (num_values < 2) return 0.025;
  const auto n = static_cast<double>(num_values);
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
  return core::standard_normal_cdf(-t * std::sqrt(n / (n - 1.0)));
}

}  // namespace

double percentile(const std::vector<double>& ascending, double probability) noexcept {
  const double place = probability * static_cast<double>(ascending.size() - 1);
  const double below = std::floor(place);
  const double low = ascending[static_cast<std::size_t>(below)];
  if (place == below) return low;
  const double high = ascending[static_cast<std::size_t>(below) + 1];
  return low == high ? low : low + (place - below) * (high - low);
}

Summary summary_of(const std::vector<double>& values) {
  Summary summary;
  summary.num_values = static_cast<int>(values.size());
  if (values.empty()) return summary;
  double sum = 0.0;
  for (const double value : values) {
    core::require(std::isfinite(value), "value", "a finite number", value);
    sum += value;
  }
  const double n = static_cast<double>(values.size());
  const double mean = sum / n;
  summary.mean = mean;
  std::vector<double> ascending = values;
  std::sort(ascending.begin(), ascending.end());
  summary.median = percentile(ascending, 0.5);
  if (values.size() < 2) return summary;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double deviation = std::sqrt(squares / (n - 1.0));
  summary.standard_deviation = deviation;
  const double reach =
      boost::math::quantile(boost::math::students_t(n - 1.0), 0.975) * deviation / std::sqrt(n);
  summary.mean_ci95 = {mean - reach, mean + reach};
  return summary;
}

ResampledInterval resample_participants(
    std::size_t num_participants, int num_resamples, std::uint64_t seed,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic) {
  core::require(num_participants >= 1, "num_participants", "a number >= 1",
                static_cast<double>(num_participants));
  core::require(num_resamples >= 1, "num_resamples", "a number >= 1", num_resamples);
  core::RandomStream random(seed, "bootstrap over participants");
  ResampledInterval result;
  result.num_resamples = num_resamples;
  if (num_participants < kFewestParticipants) return result;
  std::vector<std::size_t> drawn(num_participants);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(num_resamples));
  for (int resample = 0; resample < num_resamples; ++resample) {
    for (std::size_t& participant : drawn) participant = random.below(num_participants);
    const std::optional<double> value = statistic(drawn);
    if (value && !std::isnan(*value)) {
      values.push_back(*value);
    } else {
      ++result.num_undefined;
    }
  }
  if (2 * result.num_undefined > num_resamples) return result;
  std::sort(values.begin(), values.end());
  const double tail = expanded_tail(num_participants);
  const auto end = [&](double probability) -> std::optional<double> {
    const double value = percentile(values, probability);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  result.ci95 = {end(tail), end(1.0 - tail)};
  return result;
}

}  // namespace jnd::analysis
