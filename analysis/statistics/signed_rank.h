#pragma once

#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// So many ranks, in both groups together, have their exact distribution counted; more have the
/// normal one.
inline constexpr int kLargestExactRanks = 50;

/// Wilcoxon's signed ranks of a sample (1945): the ranks of the differences by magnitude, ties
/// sharing the mean of theirs. Differences of 0 are left out before ranking, from the median
/// and its interval, too, as R's wilcox.test has it.
struct SignedRanks {
  int num_nonzero = 0, num_zeros = 0;
  double positive_sum = 0.0, negative_sum = 0.0;  ///< R calls the positive one V.
  bool has_ties = false;
  /// Up to 50 nonzero differences, tied or not: over all signs of the ranks that they have.
  /// Else normal, with the variance corrected for ties and half a rank for continuity.
  bool exact = false;
  double p_value = 1.0;  ///< Two-sided, of symmetry about 0: twice the smaller tail, at most 1.
  /// Median of the means of all pairs, each value with itself too (Hodges and Lehmann 1963);
  /// absent without a difference.
  std::optional<double> median;
  /// Those means that the test of untied ranks does not reject at 5 %, which with ties holds at
  /// least as often (Noether 1967); open below six differences, where it can reject nothing.
  Interval median_ci95;
};

/// `differences` are finite. A difference that is no larger than its own of the `roundings` is
/// 0, and magnitudes that differ by no more than theirs are tied; none: nothing was rounded.
[[nodiscard]] SignedRanks signed_ranks(const std::vector<double>& differences,
                                       const std::vector<double>& roundings = {});

/// Probability that the sum of the positive ranks of n untied differences is <= `sum`, if each
/// sign is a toss-up. n <= 50.
[[nodiscard]] double signed_rank_cdf(int n, double sum);

/// How many ordered pairs lie outside a distribution-free interval at each end: as many sums,
/// from the smallest one, as have a tail probability of at most 2.5 %. `probabilities` of the
/// sums 0, 1, ... without ties; empty: normal with this mean and standard deviation, corrected
/// for continuity.
[[nodiscard]] std::size_t num_pairs_outside(const std::vector<double>& probabilities,
                                            double mean, double standard_deviation);

/// The p value of the normal approximation, twice the smaller tail, corrected for continuity;
/// `sum` moves in steps of 1 without ties.
[[nodiscard]] double two_sided_normal(double sum, double mean, double standard_deviation);

}  // namespace jnd::analysis
