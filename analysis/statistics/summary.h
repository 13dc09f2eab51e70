#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The summary of one sample. Fields that need more values are absent.
struct Summary {
  int num_values = 0;
  std::optional<double> mean;
  std::optional<double> standard_deviation;  ///< With n - 1. It is absent for one value.
  Interval mean_ci95;                        ///< By Student's t. It is open for one value.
  std::optional<double> median;
};

/// Throws `core::Error` if a value is not finite.
[[nodiscard]] Summary summary_of(const std::vector<double>& values);

/// The part of a summary that needs no quantile.
struct MeanAndDeviation {
  std::optional<double> mean;
  std::optional<double> standard_deviation;  ///< As in `Summary`.
};

/// Throws as `summary_of` does.
[[nodiscard]] MeanAndDeviation mean_and_deviation_of(const std::vector<double>& values);

/// A bootstrap interval from redrawn participants.
struct ResampledInterval {
  Interval ci95;
  int num_resamples = 0;
  int num_undefined = 0;  ///< The number of resamples for which the statistic did not exist.
};

/// Fewer participants give too few different resamples (two give three), and percentiles that
/// no feasible number of resamples reaches.
inline constexpr std::size_t kFewestResampled = 5;

/// The tail probability that gives a bootstrap of n values the reach of Student's t. Plain
/// percentiles are too narrow, by sqrt((n-1)/n) and by the shorter tails of the normal
/// distribution (Hesterberg 2015, expanded percentiles).
[[nodiscard]] double expanded_tail(std::size_t num_values);

/// The bootstrap over participants (Efron 1979), who are drawn with replacement. It shows the
/// variation between repetitions of a study. `statistic` receives the indices of the drawn
/// participants, counted from 0: num_participants of them, with repeats. If the statistic is
/// undefined it returns nothing, and the resample is counted and left out. It returns infinity
/// for a value beyond any bound, which opens an end of the interval. The percentiles are
/// expanded (Hesterberg 2015), because plain ones are too narrow for few people; for 13
/// participants they are 1.2 and 98.8 %. The same seed gives the same interval. Both ends are
/// open if more than half the resamples are undefined, or for fewer than five participants.
[[nodiscard]] ResampledInterval resample_participants(
    std::size_t num_participants, int num_resamples, std::uint64_t seed,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic);

/// Computes several statistics of the same resample, as for `resample_participants`. `values`
/// has an entry for each, which stays empty if the statistic is undefined.
using ResampledStatistics = std::function<void(const std::vector<std::size_t>& drawn,
                                               std::span<std::optional<double>> values)>;

/// One interval for each statistic, the same as if each were resampled alone.
[[nodiscard]] std::vector<ResampledInterval> resample_participants(
    std::size_t num_participants, int num_resamples, std::uint64_t seed,
    std::size_t num_statistics, const ResampledStatistics& statistics);

/// The interval of a value > 0 that comes from a curve through everybody's answers, such as its
/// Weber fraction. It is estimate exp(-+ t s). s is the standard deviation of the logarithms of
/// the resampled values times sqrt(n / (n - 1)), and t the 97.5 % quantile of Student's
/// distribution with n - 1 degrees of freedom (Efron and Tibshirani 1993, ch. 12). For the
/// geometric mean it is the t interval of the logarithms. The slope of a curve through few
/// people's answers is too steep in most resamples. Percentiles therefore hold the truth in
/// only 79 to 94 % at 5 and 13 people, and this interval in 93 to 96 %
/// (data/reference/coverage). If more than 2.5 % of the resampled values are undefined, 0 or
/// infinite, the percentiles are used, whose ends are then open.
[[nodiscard]] ResampledInterval resample_factor(
    std::size_t num_participants, int num_resamples, std::uint64_t seed, double estimate,
    const std::function<std::optional<double>(const std::vector<std::size_t>&)>& statistic);

/// One interval for each of several estimates > 0, from the same resamples.
[[nodiscard]] std::vector<ResampledInterval> resample_factors(
    std::size_t num_participants, int num_resamples, std::uint64_t seed,
    const std::vector<double>& estimates, const ResampledStatistics& statistics);

/// The quantile of ascending values, interpolated between its two neighbours ((n-1) p, type 7
/// of Hyndman and Fan 1996). `ascending` is not empty, and 0 <= probability <= 1. The result is
/// not finite if a neighbour is not finite.
[[nodiscard]] double percentile(const std::vector<double>& ascending,
                                double probability) noexcept;

}  // namespace jnd::analysis
