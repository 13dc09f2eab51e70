#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/adaptive/quest_plus_model.h"

namespace jnd::experiments {

/// What a marginal says of its parameter.
struct QuestPlusEstimate {
  std::string name;
  double mean = 0.0;  ///< Posterior mean; of a ratio exp(mean of ln).
  double sd = 0.0;    ///< Of the marginal; of a ratio in ln.
  /// Values of the grid that cut off the same probability at either side at most; moved out to
  /// the mean where so coarse a grid would leave it outside.
  double low = 0.0, high = 0.0;
  /// The ends of the grid that the posterior reaches: what lies beyond was ruled out before the
  /// first answer, and where the grid ends decides about mean and interval.
  std::optional<double> reached_low, reached_high;

  [[nodiscard]] bool reaches_an_end() const noexcept { return reached_low || reached_high; }
};

/// The posterior reaches an end of its grid where it is at least exp(-z^2 / 2) as high there as
/// at its highest, z the normal quantile of the interval's ends: a normal posterior is that
/// high where the interval ends, so that at least as much of it lies beyond as is to lie
/// outside on that side. That does not depend on how fine the grid is; so a value that alone
/// has as much probability as is to lie outside is reached as well. A parameter of one value is
/// known, and reaches nothing.
///
/// `weights` of the grid's values sum to 1; `confidence` in (0, 1), of the interval.
[[nodiscard]] QuestPlusEstimate estimate_of(const QuestPlusParameter& parameter,
                                            const std::vector<double>& weights,
                                            double confidence);

}  // namespace jnd::experiments
