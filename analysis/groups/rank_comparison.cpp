#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "analysis/groups/comparison_parts.h"
#include "analysis/groups/effect_size.h"
#include "analysis/groups/summary.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kLargestExact = 50;
constexpr double kNormalQuantile = 1.959963984540054;  ///< 97.5 %

struct Ranks {
  std::vector<double> rank;     ///< Of each value, ties sharing the mean of theirs.
  double tie_correction = 0.0;  ///< Sum of t^3 - t over the ties.
};

Ranks ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t x, std::size_t y) { return values[x] < values[y]; });
  Ranks ranks{.rank = std::vector<double>(values.size())};
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double tied = static_cast<double>(end - first);
    ranks.tie_correction += tied * (tied * tied - 1.0);
    for (std::size_t place = first; place < end; ++place) {
      ranks.rank[order[place]] = 0.5 * static_cast<double>(first + 1 + end);
    }
    first = end;
  }
  return ranks;
}

/// Probabilities of U = 0, 1, ... without ties: the coefficients of the Gaussian binomial.
std::vector<double> u_probabilities(std::size_t num_a, std::size_t num_b) {
  const std::size_t num = num_a * num_b + 1;
  std::vector<double> ways(num, 0.0);
  ways[0] = 1.0;
  for (std::size_t i = 1; i <= num_a; ++i) {
    for (std::size_t u = num; u-- > num_b + i;) ways[u] -= ways[u - num_b - i];
    for (std::size_t u = i; u < num; ++u) ways[u] += ways[u - i];
  }
  const double all = std::accumulate(ways.begin(), ways.end(), 0.0);
  for (double& way : ways) way /= all;
  return ways;
}

double probability_up_to(const std::vector<double>& probabilities, double u) {
  double sum = 0.0;
  for (std::size_t at = 0; at < probabilities.size() && static_cast<double>(at) <= u; ++at) {
    sum += probabilities[at];
  }
  return sum;
}

std::vector<double> all_differences(const std::vector<double>& a,
                                    const std::vector<double>& b) {
  std::vector<double> differences;
  for (const double x : a) {
    for (const double y : b) differences.push_back(x - y);
  }
  std::sort(differences.begin(), differences.end());
  return differences;
}

/// How many differences lie outside the interval at each end: the largest count whose tail
/// probability is at most 2.5 %.
std::size_t num_outside(const std::vector<double>& probabilities, double mean,
                        double deviation) {
  if (probabilities.empty()) {
    return static_cast<std::size_t>(
        std::max(0.0, std::floor(mean - kNormalQuantile * deviation)));
  }
  std::size_t outside = 0;
  while (probability_up_to(probabilities, static_cast<double>(outside)) <= 0.025) ++outside;
  return outside;
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

Comparison rank_sum_test(const std::vector<double>& a, const std::vector<double>& b) {
  require_finite(a, "a");
  require_finite(b, "b");
  Comparison result =
      started(Comparison::Kind::kRankSum, "Wilcoxon's rank sum", a.size(), b.size());
  if (a.empty() || b.empty()) {
    result.reason = "too few values: a rank sum needs one in each group";
    return result;
  }
  result.estimate = finite(*summary_of(a).mean - *summary_of(b).mean);
  std::vector<double> both = a;
  both.insert(both.end(), b.begin(), b.end());
  const Ranks ranks = ranks_of(both);
  const auto num_a = static_cast<double>(a.size()), num_b = static_cast<double>(b.size());
  const double num = num_a + num_b;
  const double deviation = std::sqrt(num_a * num_b / 12.0 *
                                     (num + 1.0 - ranks.tie_correction / (num * (num - 1.0))));
  if (!(deviation > 0.0)) {
    result.reason = "all values are alike: there is nothing to rank";
    return result;
  }
  const double u = std::accumulate(ranks.rank.begin(), ranks.rank.begin() + result.num_a, 0.0) -
                   0.5 * num_a * (num_a + 1.0);
  const double mean = 0.5 * num_a * num_b;
  const bool exact = ranks.tie_correction == 0.0 && both.size() <= kLargestExact;
  const std::vector<double> probabilities =
      exact ? u_probabilities(a.size(), b.size()) : std::vector<double>();
  const double smaller = std::min(u, num_a * num_b - u);
  result.method += exact ? ", exact" : ", normal approximation corrected for ties";
  result.statistic = u;
  result.p_value =
      std::min(1.0, exact ? 2.0 * probability_up_to(probabilities, smaller)
                          : std::erfc((mean - smaller) / deviation / std::numbers::sqrt2));
  result.rank_biserial = u / mean - 1.0;
  const std::vector<double> differences = all_differences(a, b);
  result.hodges_lehmann = finite(percentile(differences, 0.5));
  const std::size_t outside = num_outside(probabilities, mean, deviation);
  if (outside > 0) {
    result.hodges_lehmann_ci95 = {finite(differences[outside - 1]),
                                  finite(differences[differences.size() - outside])};
  }
  result.status = FitStatus::kOk;
  return result;
}

Comparison spearman_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  require_finite(a, "a");
  require_finite(b, "b");
  Comparison result = pearson_correlation(ranks_of(a).rank, ranks_of(b).rank);
  result.kind = Comparison::Kind::kSpearman;
  result.method = "Spearman's rank correlation, p by t, interval by Fisher's z";
  if (result.status != FitStatus::kOk) {
    if (result.estimate) result.reason = "the ranks agree wholly: t is infinite";
    return result;
  }
  const double rho = *result.estimate;
  result.ci95 = {};
  if (a.size() > 3) {
    result.ci95 = fisher_interval(
        rho, std::sqrt((1.0 + 0.5 * rho * rho) / (static_cast<double>(a.size()) - 3.0)));
  }
  return result;
}

}  // namespace jnd::analysis
