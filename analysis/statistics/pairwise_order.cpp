#include "analysis/statistics/pairwise_order.h"
#include "core/require.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>

namespace jnd::analysis {
namespace {

using core::kInfinity;

/// Maps numbers to integers in the same order, so that halving an interval ends after 64 steps.
std::int64_t ordinal_of(double value) {
  const auto bits = std::bit_cast<std::int64_t>(value);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}

double number_at(std::int64_t ordinal) {
  return std::bit_cast<double>(
      ordinal >= 0 ? ordinal : std::numeric_limits<std::int64_t>::min() - ordinal);
}

/// The smallest number that is at least as large as more than `place` of the pairs.
template <typename CountUpTo>
double smallest_with(std::size_t place, const CountUpTo& count_up_to) {
  std::int64_t low = ordinal_of(-kInfinity), high = ordinal_of(kInfinity);
  while (low < high) {
    const std::int64_t middle = std::midpoint(low, high);
    if (count_up_to(number_at(middle)) > place) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return number_at(low) + 0.0;  // Adding 0 turns -0 into 0.
}

}  // namespace

double walsh_average_at(const std::vector<double>& ascending, std::size_t place) {
  return smallest_with(place, [&](double most) {
    // Among the ordered pairs, each counts twice except those of a value with itself.
    std::size_t pairs = 0, own = 0;
    std::size_t end = ascending.size();
    for (const double x : ascending) {
      while (end > 0 && !(0.5 * x + 0.5 * ascending[end - 1] <= most)) --end;
      pairs += end;
      own += 0.5 * x + 0.5 * x <= most ? 1 : 0;
    }
    return (pairs + own) / 2;
  });
}

double difference_at(const std::vector<double>& ascending_a,
                     const std::vector<double>& ascending_b, std::size_t place) {
  return smallest_with(place, [&](double most) {
    std::size_t pairs = 0, first = 0;
    for (const double x : ascending_a) {
      while (first < ascending_b.size() && !(x - ascending_b[first] <= most)) ++first;
      pairs += ascending_b.size() - first;
    }
    return pairs;
  });
}

}  // namespace jnd::analysis
