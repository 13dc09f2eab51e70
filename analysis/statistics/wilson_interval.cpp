#include "analysis/statistics/wilson_interval.h"

#include <cmath>

#include "core/psychometric_function.h"
#include "core/require.h"

namespace jnd::analysis {

std::pair<double, double> wilson_interval(std::int64_t num_yes, std::int64_t num_trials) {
  core::require(num_yes >= 0 && num_yes <= num_trials, "num_yes", "a count in [0, num_trials]",
                static_cast<double>(num_yes));
  if (num_trials == 0) return {0.0, 1.0};
  const double n = static_cast<double>(num_trials);
  const double p = static_cast<double>(num_yes) / n;
  const double z = core::standard_normal_quantile(0.975);
  const double scale = 1.0 + z * z / n;
  const double centre = (p + z * z / (2.0 * n)) / scale;
  const double reach = z / scale * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  return {num_yes == 0 ? 0.0 : centre - reach, num_yes == num_trials ? 1.0 : centre + reach};
}

}  // namespace jnd::analysis
