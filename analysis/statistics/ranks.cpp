#include "analysis/statistics/ranks.h"

#include <algorithm>
#include <numeric>

namespace jnd::analysis {

Ranks ranks_of(const std::vector<double>& values, const std::vector<double>& roundings) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t x, std::size_t y) { return values[x] < values[y]; });
  const auto are_tied = [&](std::size_t below, std::size_t above) {
    const double rounding =
        roundings.empty() ? 0.0 : std::max(roundings[below], roundings[above]);
    return values[above] - values[below] <= rounding;
  };
  Ranks ranks{.doubled = std::vector<std::int64_t>(values.size())};
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && are_tied(order[end - 1], order[end])) ++end;
    const double tied = static_cast<double>(end - first);
    ranks.tie_correction += tied * (tied * tied - 1.0);
    for (std::size_t place = first; place < end; ++place) {
      ranks.doubled[order[place]] = static_cast<std::int64_t>(first + 1 + end);
    }
    first = end;
  }
  return ranks;
}

}  // namespace jnd::analysis
