#include "analysis/groups/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/groups/summary.h"

namespace jnd::analysis {
namespace {

constexpr int kLargestExact = 50;
constexpr double kNormalQuantile = 1.959963984540054;  ///< 97.5 %

/// How many of the Walsh averages lie outside the interval at each end: the largest count whose
/// tail probability is at most 2.5 %.
std::size_t num_outside(int n, bool exact, double mean, double standard_deviation) {
  if (!exact) {
    return static_cast<std::size_t>(
        std::max(0.0, std::floor(mean - kNormalQuantile * standard_deviation)));
  }
  std::size_t outside = 0;
  while (signed_rank_cdf(n, static_cast<double>(outside)) <= 0.025) ++outside;
  return outside;
}

}  // namespace

double signed_rank_cdf(int n, double sum) {
  // Ways to reach each sum, one rank after the other.
  std::vector<double> ways(static_cast<std::size_t>(n * (n + 1) / 2 + 1), 0.0);
  ways[0] = 1.0;
  for (int rank = 1; rank <= n; ++rank) {
    for (int total = rank * (rank + 1) / 2; total >= rank; --total) {
      ways[static_cast<std::size_t>(total)] += ways[static_cast<std::size_t>(total - rank)];
    }
  }
  double below = 0.0;
  for (std::size_t total = 0; total < ways.size() && static_cast<double>(total) <= sum;
       ++total) {
    below += ways[total];
  }
  return std::ldexp(below, -n);
}

SignedRanks signed_ranks(const std::vector<double>& differences) {
  std::vector<double> nonzero;
  for (const double difference : differences) {
    if (difference != 0.0) nonzero.push_back(difference);
  }
  SignedRanks result;
  result.num_nonzero = static_cast<int>(nonzero.size());
  if (nonzero.empty()) return result;
  std::sort(nonzero.begin(), nonzero.end(),
            [](double x, double y) { return std::fabs(x) < std::fabs(y); });
  double tie_correction = 0.0;
  for (std::size_t first = 0; first < nonzero.size();) {
    std::size_t end = first;
    while (end < nonzero.size() && std::fabs(nonzero[end]) == std::fabs(nonzero[first])) ++end;
    const double rank = 0.5 * static_cast<double>(first + 1 + end);
    const double tied = static_cast<double>(end - first);
    tie_correction += tied * (tied * tied - 1.0) / 48.0;
    for (; first < end; ++first) {
      (nonzero[first] > 0.0 ? result.positive_sum : result.negative_sum) += rank;
    }
  }
  const double n = result.num_nonzero;
  const double smaller = std::min(result.positive_sum, result.negative_sum);
  const double mean = n * (n + 1.0) / 4.0;
  const double deviation = std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - tie_correction);
  result.exact = result.num_nonzero <= kLargestExact && tie_correction == 0.0 &&
                 nonzero.size() == differences.size();
  result.p_value = std::min(
      1.0, result.exact ? 2.0 * signed_rank_cdf(result.num_nonzero, smaller)
                        : std::erfc((mean - smaller) / deviation / std::numbers::sqrt2));

  std::vector<double> means;
  for (std::size_t i = 0; i < nonzero.size(); ++i) {
    for (std::size_t j = i; j < nonzero.size(); ++j) {
      means.push_back(0.5 * (nonzero[i] + nonzero[j]));
    }
  }
  std::sort(means.begin(), means.end());
  result.median = percentile(means, 0.5);
  const std::size_t outside = num_outside(result.num_nonzero, result.exact, mean, deviation);
  if (outside > 0) {
    result.median_ci95 = {means[outside - 1], means[means.size() - outside]};
  }
  return result;
}

}  // namespace jnd::analysis
