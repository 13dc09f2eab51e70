#pragma once

#include <optional>
#include <vector>

#include "core/random_stream.h"

namespace jnd::experiments {

/// The task of ordering items by labels: how many items each label has, and the constraints.
/// Labels are indices. It is for `mixed_order`, which checks the constraints and words the
/// errors.
struct LabelProblem {
  std::vector<int> counts;         ///< One for each label, >= 1.
  std::vector<bool> may_be_first;  ///< One for each label.
  std::optional<int> max_in_a_row;
  int min_distance = 1;

  [[nodiscard]] int num_items() const noexcept;
};

/// A label for each place, or why there is no order.
struct LabelOrder {
  enum class Outcome {
    kFound,
    kInfeasible,  ///< It is proven that no order exists.
    kGaveUp,      ///< The limit came before an order was found or proven impossible.
  };
  Outcome outcome = Outcome::kGaveUp;
  std::vector<int> labels;
};

/// Draws an order with the same probability as shuffling the items until they meet the
/// constraints. It goes place by place and weighs each label by the number of ways to continue.
/// It counts these by recursion over states that contain only what matters: how many items are
/// left of each label, whatever its name, and which labels were used last. So it also decides
/// whether an order exists. It gives up beyond `max_states`. Not real time.
[[nodiscard]] LabelOrder counted_order(const LabelProblem& problem, int max_states,
                                       core::RandomStream& stream);

/// Builds an order place by place. Each label is drawn in proportion to its remaining items,
/// among those that leave room for the rest. If none does, the last place is taken back. The
/// orders are not equally likely. It starts again after a twentieth of `max_steps` and gives up
/// after all of them. Not real time.
[[nodiscard]] LabelOrder searched_order(const LabelProblem& problem, int max_steps,
                                        core::RandomStream& stream);

}  // namespace jnd::experiments
