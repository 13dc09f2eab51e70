#pragma once

#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// Up to this number of ranks, in both groups together, the exact distribution is counted. For
/// more it is normal.
inline constexpr int kLargestExactRanks = 50;

/// Wilcoxon's signed ranks of a sample (1945): the midranks of the differences by magnitude.
/// Differences of 0 are left out before ranking. They are left out of the median and its
/// interval too, as in R's wilcox.test.
struct SignedRanks {
  int num_nonzero = 0, num_zeros = 0;
  double positive_sum = 0.0, negative_sum = 0.0;  ///< R calls the positive sum V.
  bool has_ties = false;
  /// Whether p is exact over all signs of the ranks, which it is up to 50 nonzero differences,
  /// tied or not. Otherwise it is normal, with the variance corrected for ties and a continuity
  /// correction of half a rank.
  bool exact = false;
  /// The two-sided p of symmetry about 0: twice the smaller tail, at most 1.
  double p_value = 1.0;
  /// The median of the means of all pairs, including each value with itself (Hodges and Lehmann
  /// 1963). It is absent if there is no nonzero difference.
  std::optional<double> median;
  /// The interval of those means that the test of untied ranks does not reject at 5 %. With
  /// ties its coverage is at least as high (Noether 1967). It is open below six differences,
  /// where the test cannot reject anything.
  Interval median_ci95;
};

/// `differences` are finite. A difference that is no larger than its entry in `roundings`
/// counts as 0, and magnitudes that differ by no more than their roundings are tied. Empty
/// `roundings` mean that nothing was rounded.
[[nodiscard]] SignedRanks signed_ranks(const std::vector<double>& differences,
                                       const std::vector<double>& roundings = {});

/// The probability that the sum of the positive ranks of n untied differences is <= `sum`, if
/// each sign is a fair toss. n is at most 50.
[[nodiscard]] double signed_rank_cdf(int n, double sum);

/// The number of ordered pairs that lie outside a distribution-free interval at each end. It is
/// the number of sums, from the smallest one, whose tail probability is at most 2.5 %.
/// `probabilities` are those of the sums 0, 1, ... without ties. If it is empty, the sum is
/// normal with this mean and standard deviation, corrected for continuity.
[[nodiscard]] std::size_t num_pairs_outside(const std::vector<double>& probabilities,
                                            double mean, double standard_deviation);

/// The p value of the normal approximation: twice the smaller tail, corrected for continuity.
/// Without ties `sum` moves in steps of 1.
[[nodiscard]] double two_sided_normal(double sum, double mean, double standard_deviation);

}  // namespace jnd::analysis
