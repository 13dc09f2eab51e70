#include <algorithm>
#include <cmath>

#include "analysis/statistics/comparison.h"
#include "analysis/statistics/comparison_parts.h"
#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// The number of ordered differences that lie outside the interval of the median at each end.
/// It is the largest number for which the tail probability is at most 2.5 %.
std::size_t num_outside(std::size_t num_values) {
  const auto n = static_cast<double>(num_values);
  std::size_t outside = 0;
  while (outside < num_values / 2 &&
         fair_trials_at_least(n - static_cast<double>(outside), n) <= 0.025) {
    ++outside;
  }
  return outside;
}

}  // namespace

Comparison sign_test(const std::vector<double>& a, const std::vector<double>& b) {
  require_finite(a, "a");
  require_finite(b, "b");
  core::require(a.size() == b.size(), "b", "as many values as a, " + std::to_string(a.size()),
                static_cast<double>(b.size()));
  Comparison result = started(Comparison::Kind::kSign, "sign test, exact", a.size(), b.size());
  std::vector<double> differences;
  for (std::size_t pair = 0; pair < a.size(); ++pair) differences.push_back(a[pair] - b[pair]);
  if (differences.empty()) {
    result.reason = "no pairs";
    return result;
  }
  std::ranges::sort(differences);
  const std::size_t num = differences.size();
  result.estimate = 0.5 * differences[(num - 1) / 2] + 0.5 * differences[num / 2];
  if (const std::size_t outside = num_outside(num); outside > 0) {
    result.ci95 = {differences[outside - 1], differences[num - outside]};
  }
  const auto num_above = static_cast<double>(
      std::ranges::count_if(differences, [](double difference) { return difference > 0.0; }));
  const auto num_below = static_cast<double>(
      std::ranges::count_if(differences, [](double difference) { return difference < 0.0; }));
  result.num_zeros = static_cast<int>(num) - static_cast<int>(num_above + num_below);
  if (!(num_above + num_below > 0.0)) {
    result.reason = "every pair is equal: no difference has a sign";
    return result;
  }
  result.statistic = num_above;
  result.statistic_name = "num_positive";
  const double more = std::max(num_above, num_below);
  result.p_value = std::min(1.0, 2.0 * fair_trials_at_least(more, num_above + num_below));
  result.status = FitStatus::kOk;
  return result;
}

}  // namespace jnd::analysis
