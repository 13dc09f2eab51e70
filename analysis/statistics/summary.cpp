#include "analysis/statistics/summary.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/distributions.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
double expanded_tail(std::size_t num_values) {
  if (num_values < 2) return 0.025;
  const auto n = static_cast<double>(num_values);
  const double t = student_t_quantile(0.975, n - 1.0);
  return core::standard_normal_cdf(-t * std::sqrt(n / (n - 1.0)));
}

double percentile(const std::vector<double>& ascending, double probability) noexcept {
  const double place = probability * static_cast<double>(ascending.size() - 1);
  const double below = std::floor(place);
  const double low = ascending[static_cast<std::size_t>(below)];
  if (place == below) return low;
  const double high = ascending[static_cast<std::size_t>(below) + 1];
  return low == high ? low : low + (place - below) * (high - low);
}

MeanAndDeviation mean_and_deviation_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  double sum = 0.0;
  for (const double value : values) {
    core::require(std::isfinite(value), "value", "a finite number", value);
    sum += value;
  }
  const double n = static_cast<double>(values.size());
  const double mean = sum / n;
  if (values.size() < 2) return {.mean = mean};
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {.mean = mean, .standard_deviation = std::sqrt(squares / (n - 1.0))};
}

Summary summary_of(const std::vector<double>& values) {
  const MeanAndDeviation moments = mean_and_deviation_of(values);
  Summary summary{.num_values = static_cast<int>(values.size()),
                  .mean = moments.mean,
                  .standard_deviation = moments.standard_deviation};
  if (values.empty()) return summary;
  std::vector<double> ascending = values;
  std::sort(ascending.begin(), ascending.end());
  summary.median = percentile(ascending, 0.5);
  if (values.size() < 2) return summary;
  const double n = static_cast<double>(values.size());
  const double reach =
      student_t_quantile(0.975, n - 1.0) * *summary.standard_deviation / std::sqrt(n);
  summary.mean_ci95 = {*summary.mean - reach, *summary.mean + reach};
  return summary;
}

namespace {

/// The values of a statistic over all resamples, ascending, and the number of resamples without
/// a value.
struct Resamples {
  std::vector<double> values;
  int num_undefined = 0;
};

std::vector<Resamples> resampled(std::size_t num_participants, int num_resamples,
                                 std::uint64_t seed, std::size_t num_statistics,
                                 const ResampledStatistics& statistics) {
  core::require(num_participants >= 1, "num_participants", "a number >= 1",
                static_cast<double>(num_participants));
  core::require(num_resamples >= 1, "num_resamples", "a number >= 1", num_resamples);
  std::vector<Resamples> all(num_statistics);
  if (num_participants < kFewestResampled) return all;
  core::RandomStream random(seed, "bootstrap over participants");
  std::vector<std::size_t> drawn(num_participants);
  std::vector<std::optional<double>> values(num_statistics);
  for (Resamples& one : all) one.values.reserve(static_cast<std::size_t>(num_resamples));
  for (int resample = 0; resample < num_resamples; ++resample) {
    for (std::size_t& participant : drawn) participant = random.below(num_participants);
    std::ranges::fill(values, std::nullopt);
    statistics(drawn, values);
    for (std::size_t i = 0; i < num_statistics; ++i) {
      if (values[i] && !std::isnan(*values[i])) {
        all[i].values.push_back(*values[i]);
      } else {
        ++all[i].num_undefined;
      }
    }
  }
  for (Resamples& one : all) std::ranges::sort(one.values);
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

ResampledInterval factor_interval(const Resamples& all, std::size_t num_participants,
                                  int num_resamples, double estimate) {
  constexpr double kMostWithout = 0.025;
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

/// Wraps one statistic as a list of statistics.
ResampledStatistics only(
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic) {
  return [&statistic](const std::vector<std::size_t>& drawn,
                      std::span<std::optional<double>> values) {
    values.front() = statistic(drawn);
  };
}

}  // namespace

std::vector<ResampledInterval> resample_participants(std::size_t num_participants,
                                                     int num_resamples, std::uint64_t seed,
                                                     std::size_t num_statistics,
                                                     const ResampledStatistics& statistics) {
  std::vector<ResampledInterval> intervals;
  for (const Resamples& one :
       resampled(num_participants, num_resamples, seed, num_statistics, statistics)) {
    intervals.push_back(percentile_interval(one, num_participants, num_resamples));
  }
  return intervals;
}

ResampledInterval resample_participants(
    std::size_t num_participants, int num_resamples, std::uint64_t seed,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic) {
  return resample_participants(num_participants, num_resamples, seed, 1, only(statistic))
      .front();
}

std::vector<ResampledInterval> resample_factors(std::size_t num_participants, int num_resamples,
                                                std::uint64_t seed,
                                                const std::vector<double>& estimates,
                                                const ResampledStatistics& statistics) {
  for (const double estimate : estimates) {
    core::require(std::isfinite(estimate) && estimate > 0.0, "estimate", "a number > 0",
                  estimate);
  }
  const std::vector<Resamples> all =
      resampled(num_participants, num_resamples, seed, estimates.size(), statistics);
  std::vector<ResampledInterval> intervals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    intervals.push_back(factor_interval(all[i], num_participants, num_resamples, estimates[i]));
  }
  return intervals;
}

ResampledInterval resample_factor(
    std::size_t num_participants, int num_resamples, std::uint64_t seed, double estimate,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic) {
  return resample_factors(num_participants, num_resamples, seed, {estimate}, only(statistic))
      .front();
}

}  // namespace jnd::analysis
