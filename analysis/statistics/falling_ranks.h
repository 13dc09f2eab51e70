#pragma once

#include <optional>
#include <vector>

namespace jnd::analysis {

/// Tests whether y falls as x grows, by Spearman's rank correlation, one-sided. The p value is
/// the probability that the sum of products of the ranks is as low or lower if every pairing of
/// x and y is equally likely. Ties are midranks. It is exact up to 14 pairs. For more it uses
/// the normal distribution with the exact mean and variance. It is absent if nothing can fall
/// because all x or all y are equal. x and y are finite and equally many. Not real time.
[[nodiscard]] std::optional<double> falling_ranks_p_value(const std::vector<double>& x,
                                                          const std::vector<double>& y);

}  // namespace jnd::analysis
