#pragma once

#include <cstddef>
#include <vector>

namespace jnd::analysis {

/// Order statistics of all pairs of a sample. They are found by counting, so no time or memory
/// grows with the square of the number of values. Values are ascending and finite. `place`
/// counts from 0. A result that leaves the range of numbers is infinite.

/// The order statistic of the means of every two values, including each value with itself
/// (Walsh averages). There are n (n + 1) / 2.
[[nodiscard]] double walsh_average_at(const std::vector<double>& ascending, std::size_t place);

/// The order statistic of the differences a - b. Their number is the product of the sizes.
[[nodiscard]] double difference_at(const std::vector<double>& ascending_a,
                                   const std::vector<double>& ascending_b, std::size_t place);

}  // namespace jnd::analysis
