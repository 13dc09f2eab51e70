#include "analysis/statistics/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/statistics/pairwise_order.h"
#include "analysis/statistics/rank_distributions.h"
#include "analysis/statistics/ranks.h"

namespace jnd::analysis {
namespace {

constexpr double kNormalQuantile = 1.959963984540054;  ///< The 97.5 % quantile.
constexpr double kContinuity = 0.5;

/// Fills in the median of the Walsh averages, and the interval that the test without ties
/// keeps. There is no interval if all differences are equal.
void fill_median(SignedRanks& result, std::vector<double> nonzero) {
  std::sort(nonzero.begin(), nonzero.end());
  const std::size_t num = nonzero.size(), num_means = num * (num + 1) / 2;
  const double n = static_cast<double>(num);
  result.median = 0.5 * walsh_average_at(nonzero, (num_means - 1) / 2) +
                  0.5 * walsh_average_at(nonzero, num_means / 2);
  const std::vector<double> probabilities =
      result.exact ? signed_rank_distribution(untied_ranks(num)).probabilities
                   : std::vector<double>();
  const std::size_t outside = num_pairs_outside(
      probabilities, n * (n + 1.0) / 4.0, std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0));
  if (outside > 0 && nonzero.front() != nonzero.back()) {
    result.median_ci95 = {walsh_average_at(nonzero, outside - 1),
                          walsh_average_at(nonzero, num_means - outside)};
  }
}

}  // namespace

double signed_rank_cdf(int n, double sum) {
  return signed_rank_distribution(untied_ranks(static_cast<std::size_t>(n))).up_to(sum);
}

std::size_t num_pairs_outside(const std::vector<double>& probabilities, double mean,
                              double standard_deviation) {
  constexpr double kTail = 0.025;
  if (probabilities.empty()) {
    return static_cast<std::size_t>(
        std::max(0.0, std::floor(mean - kNormalQuantile * standard_deviation + kContinuity)));
  }
  std::size_t outside = 0;
  double tail = 0.0;
  for (const double probability : probabilities) {
    tail += probability;
    if (tail > kTail) break;
    ++outside;
  }
  return outside;
}

double two_sided_normal(double sum, double mean, double standard_deviation) {
  const double distance = std::max(0.0, std::fabs(sum - mean) - kContinuity);
  return std::erfc(distance / standard_deviation / std::numbers::sqrt2);
}

SignedRanks signed_ranks(const std::vector<double>& differences,
                         const std::vector<double>& roundings) {
  std::vector<double> nonzero, magnitudes, their_roundings;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const double rounding = roundings.empty() ? 0.0 : roundings[i];
    if (std::fabs(differences[i]) <= rounding) continue;
    nonzero.push_back(differences[i]);
    magnitudes.push_back(std::fabs(differences[i]));
    their_roundings.push_back(rounding);
  }
  SignedRanks result;
  result.num_nonzero = static_cast<int>(nonzero.size());
  result.num_zeros = static_cast<int>(differences.size() - nonzero.size());
  if (nonzero.empty()) return result;
  const Ranks ranks = ranks_of(magnitudes, their_roundings);
  for (std::size_t i = 0; i < nonzero.size(); ++i) {
    (nonzero[i] > 0.0 ? result.positive_sum : result.negative_sum) +=
        0.5 * static_cast<double>(ranks.doubled[i]);
  }
  result.has_ties = ranks.has_ties();
  result.exact = result.num_nonzero <= kLargestExactRanks;
  const double n = result.num_nonzero;
  result.p_value =
      result.exact
          ? signed_rank_distribution(ranks.doubled).two_sided(2.0 * result.positive_sum)
          : two_sided_normal(result.positive_sum, n * (n + 1.0) / 4.0,
                             std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 -
                                       ranks.tie_correction / 48.0));
  fill_median(result, std::move(nonzero));
  return result;
}

}  // namespace jnd::analysis
