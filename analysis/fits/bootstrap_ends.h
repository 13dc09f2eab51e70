#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// A value found anew without one answer, and how many answers are like it.
struct LeftOut {
  double value = 0.0, num_answers = 0.0;
};

/// Skewness of the influence of single answers, over 6 (Efron 1987); absent where none has any.
[[nodiscard]] std::optional<double> acceleration_of(const std::vector<LeftOut>& all);

/// Intervals of an estimate over values found anew, infinite ones included: where leaving them
/// out would narrow it.
struct BootstrapEnds {
  Interval ci95;            ///< The 2.5 and 97.5 percentiles; an infinite end is open.
  bool is_refused = false;  ///< It would miss the estimate, so both ends are open.
  Interval bca_ci95;        ///< Corrected for bias and acceleration (Efron 1987).
  std::string bca_reason;   ///< Why there is none; "" if there is.
  std::optional<double> bias_correction;
};

/// `ascending` has one value or more.
[[nodiscard]] BootstrapEnds bootstrap_ends(const std::vector<double>& ascending,
                                           double estimate, std::optional<double> acceleration);

}  // namespace jnd::analysis
