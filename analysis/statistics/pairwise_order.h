#pragma once

#include <cstddef>
#include <vector>

namespace jnd::analysis {

/// Order statistics of all pairs of a sample, found by counting: nothing grows with the square
/// of the number of values. Values are ascending and finite; `place` counts from 0. A result
/// past the range of numbers is infinite.

/// The means of every two values, each with itself too (Walsh averages): n (n + 1) / 2.
[[nodiscard]] double walsh_average_at(const std::vector<double>& ascending, std::size_t place);

/// The differences a - b: as many as the product of the sizes.
[[nodiscard]] double difference_at(const std::vector<double>& ascending_a,
                                   const std::vector<double>& ascending_b, std::size_t place);

}  // namespace jnd::analysis
