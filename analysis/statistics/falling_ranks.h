#pragma once

#include <optional>
#include <vector>

namespace jnd::analysis {

/// Whether y falls as x grows: Spearman's rank correlation, one-sided. The p value is the
/// probability of a sum of products of the ranks as low or lower, were every pairing of x and y
/// equally likely, ties being ranks as they are: exact up to 14 pairs, beyond that of the
/// normal distribution with the exact mean and variance. Absent where nothing can fall: all x
/// alike, or all y. As many x as y, finite. Not real time.
[[nodiscard]] std::optional<double> falling_ranks_p_value(const std::vector<double>& x,
                                                          const std::vector<double>& y);

}  // namespace jnd::analysis
