#include "analysis/statistics/rank_distributions.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostRanks = 50, kMostPaired = 14;

void require_at_most(std::size_t num, std::size_t most) {
  core::require(num <= most, "ranks", "at most " + std::to_string(most),
                static_cast<double>(num));
}

/// The number of ways to reach each sum, from `lowest` on.
struct Ways {
  std::int64_t lowest = 0;
  std::vector<double> num;

  /// Adds every way of `other`, with `step` added to its sum.
  void add(const Ways& other, std::int64_t step) {
    const std::int64_t first = other.lowest + step;
    const std::int64_t end = first + std::ssize(other.num);
    if (num.empty()) lowest = first;
    if (first < lowest) {
      num.insert(num.begin(), static_cast<std::size_t>(lowest - first), 0.0);
      lowest = first;
    }
    if (end > lowest + std::ssize(num)) num.resize(static_cast<std::size_t>(end - lowest));
    double* place = num.data() + (first - lowest);
    for (const double ways : other.num) *place++ += ways;
  }
};

RankDistribution distribution_of(Ways ways) {
  const double all = std::accumulate(ways.num.begin(), ways.num.end(), 0.0);
  for (double& one : ways.num) one /= all;
  return {.lowest = ways.lowest, .probabilities = std::move(ways.num)};
}

}  // namespace

double RankDistribution::up_to(double x) const noexcept {
  double sum = 0.0;
  for (std::size_t at = 0; at < probabilities.size(); ++at) {
    if (static_cast<double>(lowest) + static_cast<double>(at) > x) break;
    sum += probabilities[at];
  }
  return sum;
}

double RankDistribution::from(double x) const noexcept {
  double sum = 0.0;
  for (std::size_t at = probabilities.size(); at-- > 0;) {
    if (static_cast<double>(lowest) + static_cast<double>(at) < x) break;
    sum += probabilities[at];
  }
  return sum;
}

double RankDistribution::two_sided(double x) const noexcept {
  return std::min(1.0, 2.0 * std::min(up_to(x), from(x)));
}

RankDistribution signed_rank_distribution(const std::vector<std::int64_t>& ranks) {
  require_at_most(ranks.size(), kMostRanks);
  Ways ways{.lowest = 0, .num = {1.0}};
  for (const std::int64_t rank : ranks) {
    const Ways without = ways;
    ways.add(without, rank);
  }
  return distribution_of(std::move(ways));
}

RankDistribution rank_sum_distribution(const std::vector<std::int64_t>& ranks,
                                       std::size_t num_a) {
  require_at_most(ranks.size(), kMostRanks);
  core::require(num_a <= ranks.size(), "num_a", "no more than there are ranks",
                static_cast<double>(num_a));
  // Indexed by the number of ranks taken so far.
  std::vector<Ways> ways(num_a + 1);
  ways[0] = {.lowest = 0, .num = {1.0}};
  for (const std::int64_t rank : ranks) {
    for (std::size_t taken = num_a; taken > 0; --taken) {
      if (!ways[taken - 1].num.empty()) ways[taken].add(ways[taken - 1], rank);
    }
  }
  return distribution_of(std::move(ways[num_a]));
}

RankDistribution rank_product_distribution(const std::vector<std::int64_t>& ranks_a,
                                           const std::vector<std::int64_t>& ranks_b) {
  require_at_most(ranks_a.size(), kMostPaired);
  core::require(ranks_a.size() == ranks_b.size(), "ranks_b", "as many ranks as of a",
                static_cast<double>(ranks_b.size()));
  // The keys say, bit by bit, which ranks of b are taken. There is one layer for each rank of
  // a.
  std::map<std::uint32_t, Ways> layer = {{0U, {.lowest = 0, .num = {1.0}}}};
  for (const std::int64_t rank : ranks_a) {
    std::map<std::uint32_t, Ways> next;
    for (const auto& [taken, ways] : layer) {
      for (std::size_t b = 0; b < ranks_b.size(); ++b) {
        const std::uint32_t bit = 1U << b;
        if ((taken & bit) == 0U) next[taken | bit].add(ways, rank * ranks_b[b]);
      }
    }
    layer = std::move(next);
  }
  return distribution_of(std::move(layer.begin()->second));
}

std::vector<std::int64_t> untied_ranks(std::size_t num) {
  std::vector<std::int64_t> ranks(num);
  for (std::size_t i = 0; i < num; ++i) ranks[i] = static_cast<std::int64_t>(i + 1);
  return ranks;
}

}  // namespace jnd::analysis
