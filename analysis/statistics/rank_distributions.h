#pragma once

#include <cstdint>
#include <vector>

namespace jnd::analysis {

/// The exact distribution of a sum over ranks if every arrangement of the ranks is equally
/// likely. Ranks are whole numbers. With ties they are doubled (see `Ranks`), so ties need no
/// special case. The ways are counted one rank after the other (the shift algorithm of
/// Streitberg and Roehmel 1986), in doubles, which hold these counts exactly.
struct RankDistribution {
  std::int64_t lowest = 0;
  /// The probabilities of `lowest`, `lowest` + 1, and so on.
  std::vector<double> probabilities;

  [[nodiscard]] double up_to(double x) const noexcept;  ///< P(sum <= x)
  [[nodiscard]] double from(double x) const noexcept;   ///< P(sum >= x)
  /// Twice the smaller tail, at most 1. With ties the two tails may differ.
  [[nodiscard]] double two_sided(double x) const noexcept;
};

/// The distribution of the sum of the ranks with a positive sign, if each sign is a fair toss.
/// There are at most 50 ranks.
[[nodiscard]] RankDistribution signed_rank_distribution(const std::vector<std::int64_t>& ranks);

/// The distribution of the sum of the ranks of `num_a` of the values. There are at most 50
/// ranks.
[[nodiscard]] RankDistribution rank_sum_distribution(const std::vector<std::int64_t>& ranks,
                                                     std::size_t num_a);

/// The distribution of the sum of the products of two columns' ranks, if every pairing is
/// equally likely. It counts over the subsets of b, which are 2^n, so there are at most 14
/// ranks. Both columns have the same number.
[[nodiscard]] RankDistribution rank_product_distribution(
    const std::vector<std::int64_t>& ranks_a, const std::vector<std::int64_t>& ranks_b);

/// The ranks 1, 2, ..., n without ties.
[[nodiscard]] std::vector<std::int64_t> untied_ranks(std::size_t num);

}  // namespace jnd::analysis
