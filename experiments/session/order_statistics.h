#pragma once

#include <string>
#include <vector>

#include "experiments/session/plan.h"

namespace jnd::experiments {

/// How the stimuli of a block come, counted over the participants of a plan.
struct OrderStatistics {
  std::string block;     ///< Name of its stage.
  std::string quantity;  ///< What a stimulus is: "scale", "viscosity_pa_s".
  /// In a production starting values.
  std::vector<double> stimuli;  ///< Ascending; of a matching its standards.
  /// Of each stimulus, how often it stands at each place of a repetition.
  std::vector<std::vector<int>> at_place;
  /// Of each stimulus, how often each one comes next, from repetition to repetition as well.
  std::vector<std::vector<int>> followed_by;
};

/// Fewest and most of some counts.
struct CountRange {
  int fewest = 0, most = 0;
};
[[nodiscard]] CountRange places_range(const OrderStatistics& statistics);
/// Of different stimuli; how often one follows itself is in `repeats_range`.
[[nodiscard]] CountRange followers_range(const OrderStatistics& statistics);
[[nodiscard]] CountRange repeats_range(const OrderStatistics& statistics);

/// For each block whose trials are all drawn when it begins, in the order in which the plan
/// first has them. What a procedure draws answer by answer has no order beforehand.
[[nodiscard]] std::vector<OrderStatistics> order_statistics(
    const std::vector<ParticipantPlan>& plans);

}  // namespace jnd::experiments
