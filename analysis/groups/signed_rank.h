#pragma once

#include <vector>

#include "analysis/fits/fit_status.h"

namespace jnd::analysis {

/// Wilcoxon's signed ranks of a sample (1945): the differences' ranks by magnitude, ties
/// sharing the mean of theirs, zeros dropped.
struct SignedRanks {
  int num_nonzero = 0;
  double positive_sum = 0.0, negative_sum = 0.0;
  bool exact = false;    ///< At most 50 differences, without ties or zeros.
  double p_value = 1.0;  ///< Two-sided, of symmetry about 0.
  /// Median of the means of all pairs, each value with itself too (Hodges and Lehmann 1963);
  /// absent without a difference.
  std::optional<double> median;
  /// Those means that the test at 5 % does not reject; open below six differences, where it can
  /// reject nothing.
  Interval median_ci95;
};

/// `differences` are finite.
[[nodiscard]] SignedRanks signed_ranks(const std::vector<double>& differences);

/// Probability that the sum of the positive ranks of n untied differences is <= `sum`, if each
/// sign is a toss-up. n <= 50.
[[nodiscard]] double signed_rank_cdf(int n, double sum);

}  // namespace jnd::analysis
