#pragma once

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
};

/// `weights` of the grid's values sum to 1; `confidence` in (0, 1), of the interval.
[[nodiscard]] QuestPlusEstimate estimate_of(const QuestPlusParameter& parameter,
                                            const std::vector<double>& weights,
                                            double confidence);

}  // namespace jnd::experiments
