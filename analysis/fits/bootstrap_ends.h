#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The estimate after one answer was left out, and the number of answers that would give the
/// same estimate if left out.
struct LeftOut {
  double value = 0.0, num_answers = 0.0;
};

/// The acceleration of BCa: the skewness of the influence of single answers, divided by 6
/// (Efron 1987). It is absent if no answer has any influence.
[[nodiscard]] std::optional<double> acceleration_of(const std::vector<LeftOut>& all);

/// With fewer refits none is expected beyond the 2.5 and the 97.5 percentile.
inline constexpr int kFewestRefits = 39;

/// Says in one sentence that there are fewer refits.
[[nodiscard]] std::string too_few_refits();

/// Intervals of an estimate from its resampled values. Infinite values are included, because
/// leaving them out would narrow the interval.
struct BootstrapEnds {
  /// The 2.5 and 97.5 percentiles. An infinite end is open, and so are both with fewer than
  /// `kFewestRefits`.
  Interval ci95;
  /// The percentile interval would miss the estimate, so both ends are open.
  bool is_refused = false;
  Interval bca_ci95;       ///< The interval corrected for bias and acceleration (Efron 1987).
  std::string bca_reason;  ///< Why there is no corrected interval; "" if there is one.
  std::optional<double> bias_correction;
};

/// `ascending` holds at least one value.
[[nodiscard]] BootstrapEnds bootstrap_ends(const std::vector<double>& ascending,
                                           double estimate, std::optional<double> acceleration);

}  // namespace jnd::analysis
