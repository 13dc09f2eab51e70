#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/adaptive/quest_plus_model.h"

namespace jnd::experiments {

/// The estimate of a parameter from its marginal.
struct QuestPlusEstimate {
  std::string name;
  double mean = 0.0;  ///< Posterior mean; for a ratio exp(mean of ln).
  double sd = 0.0;    ///< Standard deviation of the marginal; for a ratio in ln.
  /// Grid values that cut off at most the same probability on either side. If the grid is so
  /// coarse that the mean lies outside, the interval is extended to the mean.
  double low = 0.0, high = 0.0;
  /// Ends of the grid that the posterior reaches. Values beyond were excluded before the first
  /// answer, so the end of the grid determines mean and interval.
  std::optional<double> reached_low, reached_high;

  [[nodiscard]] bool reaches_an_end() const noexcept { return reached_low || reached_high; }
};

/// The posterior reaches an end of its grid if it is at least exp(-z^2 / 2) times its maximum
/// there, with z the normal quantile of the interval's ends. A normal posterior has this height
/// at the end of the interval, so at least as much probability may lie beyond the grid as the
/// interval leaves out on that side. This does not depend on how fine the grid is, so a single
/// end value with that much probability counts as reached as well. A parameter with one value
/// is known and reaches no end.
///
/// `weights` of the grid's values sum to 1. `confidence`, of the interval, is in (0, 1).
[[nodiscard]] QuestPlusEstimate estimate_of(const QuestPlusParameter& parameter,
                                            const std::vector<double>& weights,
                                            double confidence);

}  // namespace jnd::experiments
