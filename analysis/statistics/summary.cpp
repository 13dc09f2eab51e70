#include "analysis/statistics/summary.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/distributions.h"
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
  const double t = student_t_quantile(0.975, n - 1.0);
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
  const double reach = student_t_quantile(0.975, n - 1.0) * deviation / std::sqrt(n);
  summary.mean_ci95 = {mean - reach, mean + reach};
  return summary;
}

namespace {

/// Statistics of resamples, ascending, and how many had none.
struct Resamples {
  std::vector<double> values;
  int num_undefined = 0;
};

Resamples resampled(
    std::size_t num_participants, int num_resamples, std::uint64_t seed,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic) {
  core::require(num_participants >= 1, "num_participants", "a number >= 1",
                static_cast<double>(num_participants));
  core::require(num_resamples >= 1, "num_resamples", "a number >= 1", num_resamples);
  Resamples all;
  if (num_participants < kFewestParticipants) return all;
  core::RandomStream random(seed, "bootstrap over participants");
  std::vector<std::size_t> drawn(num_participants);
  all.values.reserve(static_cast<std::size_t>(num_resamples));
  for (int resample = 0; resample < num_resamples; ++resample) {
    for (std::size_t& participant : drawn) participant = random.below(num_participants);
    const std::optional<double> value = statistic(drawn);
    if (value && !std::isnan(*value)) {
      all.values.push_back(*value);
    } else {
      ++all.num_undefined;
    }
  }
  std::sort(all.values.begin(), all.values.end());
  return all;
}

ResampledInterval percentile_interval(const Resamples& all, std::size_t num_participants,
                                      int num_resamples) {
  ResampledInterval result{.num_resamples = num_resamples, .num_undefined = all.num_undefined};
  if (all.values.empty() || 2 * all.num_undefined > num_resamples) return result;
  const double tail = expanded_tail(num_participants);
  const auto end = [&](double probability) -> std::optional<double> {
    const double value = percentile(all.values, probability);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  result.ci95 = {end(tail), end(1.0 - tail)};
  return result;
}

}  // namespace

ResampledInterval resample_participants(
    std::size_t num_participants, int num_resamples, std::uint64_t seed,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic) {
  return percentile_interval(resampled(num_participants, num_resamples, seed, statistic),
                             num_participants, num_resamples);
}

ResampledInterval resample_factor(
    std::size_t num_participants, int num_resamples, std::uint64_t seed, double estimate,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic) {
  constexpr double kMostWithout = 0.025;
  core::require(std::isfinite(estimate) && estimate > 0.0, "estimate", "a number > 0",
                estimate);
  const Resamples all = resampled(num_participants, num_resamples, seed, statistic);
  std::vector<double> logs;
  for (const double value : all.values) {
    if (value > 0.0 && std::isfinite(value)) logs.push_back(std::log(value));
  }
  const double least = (1.0 - kMostWithout) * num_resamples;
  if (logs.size() < 2 || static_cast<double>(logs.size()) < least) {
    return percentile_interval(all, num_participants, num_resamples);
  }
  const auto n = static_cast<double>(num_participants);
  const double t = student_t_quantile(0.975, n - 1.0);
  const double reach =
      t * std::sqrt(n / (n - 1.0)) * summary_of(logs).standard_deviation.value_or(0.0);
  return {.ci95 = {estimate * std::exp(-reach), estimate * std::exp(reach)},
          .num_resamples = num_resamples,
          .num_undefined = all.num_undefined};
}

}  // namespace jnd::analysis
