#pragma once

#include <string>
#include <vector>

#include "experiments/session/plan.h"

namespace jnd::experiments {

/// Counts of how the stimuli of a block are ordered, over the participants of a plan.
struct OrderStatistics {
  std::string block;     ///< Name of the block's stage.
  std::string quantity;  ///< Quantity of a stimulus: "scale", "viscosity_pa_s".
  /// The stimuli; in a production, the starting values.
  std::vector<double> stimuli;  ///< Ascending; in a matching, the standards.
  /// For each stimulus, how often it is at each place of a repetition.
  std::vector<std::vector<int>> at_place;
  /// For each stimulus, how often each stimulus comes next, also from repetition to repetition.
  std::vector<std::vector<int>> followed_by;
};

/// The smallest and the largest of some counts.
struct CountRange {
  int fewest = 0, most = 0;
};
[[nodiscard]] CountRange places_range(const OrderStatistics& statistics);
/// Range over different stimuli; `repeats_range` is about stimuli that follow themselves.
[[nodiscard]] CountRange followers_range(const OrderStatistics& statistics);
[[nodiscard]] CountRange repeats_range(const OrderStatistics& statistics);

/// Returns statistics for each block whose trials are all drawn when it begins, in the order in
/// which the plan first has them. A procedure that draws after each answer has no order in
/// advance.
[[nodiscard]] std::vector<OrderStatistics> order_statistics(
    const std::vector<ParticipantPlan>& plans);

}  // namespace jnd::experiments
