#include "analysis/statistics/falling_ranks.h"

#include <cmath>
#include <cstdint>
#include <numeric>

#include "analysis/statistics/rank_distributions.h"
#include "analysis/statistics/ranks.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostExact = 14;

/// The sum of squared distances of doubled ranks from their mean, n + 1.
double squares_of(const std::vector<std::int64_t>& doubled_ranks) {
  const auto mean = static_cast<double>(doubled_ranks.size()) + 1.0;
  double squares = 0.0;
  for (const std::int64_t rank : doubled_ranks) {
    const double distance = static_cast<double>(rank) - mean;
    squares += distance * distance;
  }
  return squares;
}

}  // namespace

std::optional<double> falling_ranks_p_value(const std::vector<double>& x,
                                            const std::vector<double>& y) {
  const std::vector<std::int64_t> of_x = ranks_of(x).doubled, of_y = ranks_of(y).doubled;
  const double squares_x = squares_of(of_x), squares_y = squares_of(of_y);
  if (!(squares_x > 0.0 && squares_y > 0.0)) return std::nullopt;
  const auto sum = static_cast<double>(
      std::inner_product(of_x.begin(), of_x.end(), of_y.begin(), std::int64_t{0}));
  if (x.size() <= kMostExact) return rank_product_distribution(of_x, of_y).up_to(sum);
  const auto n = static_cast<double>(x.size());
  const double mean = n * (n + 1.0) * (n + 1.0);
  const double deviation = std::sqrt(squares_x * squares_y / (n - 1.0));
  return core::standard_normal_cdf((sum - mean) / deviation);
}

}  // namespace jnd::analysis
