#pragma once

#include <cstdint>
#include <vector>

namespace jnd::analysis {

/// Exact distribution of a sum over ranks, every arrangement of the ranks being as likely as
/// any other. Ranks are whole numbers: with ties the doubled ones (see `Ranks`), so that ties
/// are no exception. Ways are counted one rank after the other (the shift algorithm of
/// Streitberg and Roehmel 1986), in doubles, which hold these counts exactly.
struct RankDistribution {
  std::int64_t lowest = 0;
  std::vector<double> probabilities;  ///< Of `lowest`, the next number, and so on.

  [[nodiscard]] double up_to(double x) const noexcept;  ///< P(sum <= x)
  [[nodiscard]] double from(double x) const noexcept;   ///< P(sum >= x)
  /// Twice the smaller tail, at most 1: with ties the two tails may differ.
  [[nodiscard]] double two_sided(double x) const noexcept;
};

/// Signed ranks: the sum of the ranks with a positive sign, each sign being a toss-up. At most
/// 50 ranks.
[[nodiscard]] RankDistribution signed_rank_distribution(const std::vector<std::int64_t>& ranks);

/// Rank sum: the sum of the ranks of `num_a` values out of all. At most 50 ranks.
[[nodiscard]] RankDistribution rank_sum_distribution(const std::vector<std::int64_t>& ranks,
                                                     std::size_t num_a);

/// Spearman: the sum of the products of two columns' ranks, every pairing being as likely.
/// Counts subsets of b for the first so many of a: 2^n steps, so at most 14 ranks each, as many
/// in both.
[[nodiscard]] RankDistribution rank_product_distribution(
    const std::vector<std::int64_t>& ranks_a, const std::vector<std::int64_t>& ranks_b);

/// 1, 2, ... n: ranks without ties.
[[nodiscard]] std::vector<std::int64_t> untied_ranks(std::size_t num);

}  // namespace jnd::analysis
