#include "analysis/statistics/multiplicity.h"

#include <algorithm>

#include "core/require.h"

namespace jnd::analysis {

std::vector<std::optional<double>> holm_adjusted(
    const std::vector<std::optional<double>>& p_values) {
  std::vector<std::size_t> ascending;
  for (std::size_t test = 0; test < p_values.size(); ++test) {
    if (!p_values[test]) continue;
    core::require(*p_values[test] >= 0.0 && *p_values[test] <= 1.0, "p_value",
                  "a number from 0 to 1", *p_values[test]);
    ascending.push_back(test);
  }
  std::stable_sort(ascending.begin(), ascending.end(),
                   [&](std::size_t a, std::size_t b) { return *p_values[a] < *p_values[b]; });
  std::vector<std::optional<double>> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t place = 0; place < ascending.size(); ++place) {
    const auto num_left = static_cast<double>(ascending.size() - place);
    largest = std::max(largest, std::min(1.0, num_left * *p_values[ascending[place]]));
    adjusted[ascending[place]] = largest;
  }
  return adjusted;
}

}  // namespace jnd::analysis
