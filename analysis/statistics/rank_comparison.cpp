#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/statistics/comparison_parts.h"
#include "analysis/statistics/effect_size.h"
#include "analysis/statistics/pairwise_order.h"
#include "analysis/statistics/rank_distributions.h"
#include "analysis/statistics/ranks.h"
#include "analysis/statistics/signed_rank.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kLargestExactPairs = 14;

/// The ranks as the smallest possible whole numbers. They stay doubled only if there are ties.
std::vector<std::int64_t> whole(const Ranks& ranks, bool doubled) {
  std::vector<std::int64_t> numbers = ranks.doubled;
  for (std::int64_t& rank : numbers) rank /= doubled ? 1 : 2;
  return numbers;
}

std::vector<double> numbers_of(const Ranks& ranks) {
  std::vector<double> numbers;
  for (const std::int64_t rank : ranks.doubled) {
    numbers.push_back(0.5 * static_cast<double>(rank));
  }
  return numbers;
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Fills in the median of the differences a - b, and the interval that the test without ties
/// keeps. There is no interval for two constants, whose differences are all equal.
void fill_shift(Comparison& result, std::vector<double> a, std::vector<double> b, bool exact) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  const std::size_t num = a.size() * b.size();
  result.hodges_lehmann =
      finite(0.5 * difference_at(a, b, (num - 1) / 2) + 0.5 * difference_at(a, b, num / 2));
  const double pairs = static_cast<double>(num);
  const std::vector<double> probabilities =
      exact ? rank_sum_distribution(untied_ranks(a.size() + b.size()), a.size()).probabilities
            : std::vector<double>();
  const std::size_t outside = num_pairs_outside(
      probabilities, 0.5 * pairs,
      std::sqrt(pairs * (static_cast<double>(a.size() + b.size()) + 1.0) / 12.0));
  const bool are_constants = a.front() == a.back() && b.front() == b.back();
  if (outside > 0 && !are_constants) {
    result.hodges_lehmann_ci95 = {finite(difference_at(a, b, outside - 1)),
                                  finite(difference_at(a, b, num - outside))};
  }
}

/// The exact p of Spearman's correlation, if the distribution can be counted or if the ranks
/// agree completely. Only one pairing agrees completely, apart from exchanges of ties.
std::optional<double> exact_spearman_p(const Ranks& a, const Ranks& b, double r) {
  const std::size_t num = a.doubled.size();
  if (num <= kLargestExactPairs) {
    const bool has_ties = a.has_ties() || b.has_ties();
    const std::vector<std::int64_t> of_a = whole(a, has_ties), of_b = whole(b, has_ties);
    const auto sum =
        std::inner_product(of_a.begin(), of_a.end(), of_b.begin(), std::int64_t{0});
    return rank_product_distribution(of_a, of_b).two_sided(static_cast<double>(sum));
  }
  if (std::fabs(r) < 1.0) return std::nullopt;
  std::map<std::int64_t, int> ties;
  for (const std::int64_t rank : a.doubled) ++ties[rank];
  double ln_p = std::log(2.0) - std::lgamma(static_cast<double>(num) + 1.0);
  for (const auto& [rank, tied] : ties) ln_p += std::lgamma(tied + 1.0);
  return std::min(1.0, std::exp(ln_p));
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
  const auto doubled_sum = std::accumulate(
      ranks.doubled.begin(), ranks.doubled.begin() + result.num_a, std::int64_t{0});
  const double u = 0.5 * static_cast<double>(doubled_sum) - 0.5 * num_a * (num_a + 1.0);
  const double mean = 0.5 * num_a * num_b;
  const bool exact = both.size() <= static_cast<std::size_t>(kLargestExactRanks);
  result.method += rank_method(exact, ranks.has_ties());
  result.statistic = u;
  result.statistic_name = "U";
  result.p_value = exact ? rank_sum_distribution(ranks.doubled, a.size())
                               .two_sided(static_cast<double>(doubled_sum))
                         : two_sided_normal(u, mean, deviation);
  result.rank_biserial = u / mean - 1.0;
  fill_shift(result, a, b, exact);
  result.status = FitStatus::kOk;
  return result;
}

Comparison spearman_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  require_finite(a, "a");
  require_finite(b, "b");
  const Ranks ranks_a = ranks_of(a), ranks_b = ranks_of(b);
  Comparison result = pearson_correlation(numbers_of(ranks_a), numbers_of(ranks_b));
  result.kind = Comparison::Kind::kSpearman;
  result.method = "Spearman's rank correlation";
  result.ci95 = {};
  if (!result.estimate) return result;
  const double rho = *result.estimate;
  const auto n = static_cast<double>(a.size());
  if (result.statistic) result.other_statistics = {{"t", *result.statistic}};
  result.statistic = (n * n * n - n) / 6.0 * (1.0 - rho);
  result.statistic_name = "S";
  if (const auto p_value = exact_spearman_p(ranks_a, ranks_b, rho)) {
    result.p_value = p_value;
    result.degrees_of_freedom = std::nullopt;
    result.other_statistics.clear();
    result.method += rank_method(true, ranks_a.has_ties() || ranks_b.has_ties());
  } else {
    result.method += ", p by t";
  }
  result.reason = "";
  if (a.size() > 3 && std::fabs(rho) < 1.0) {
    result.method += ", interval by Fisher's z";
    result.ci95 = fisher_interval(rho, std::sqrt((1.0 + 0.5 * rho * rho) / (n - 3.0)));
  }
  result.status = FitStatus::kOk;
  return result;
}

std::string rank_method(bool exact, bool has_ties) {
  if (!exact) {
    return has_ties ? ", normal approximation, corrected for ties and continuity"
                    : ", normal approximation, corrected for continuity";
  }
  return has_ties ? ", exact with ties" : ", exact";
}

}  // namespace jnd::analysis
