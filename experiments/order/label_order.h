#pragma once

#include <optional>
#include <vector>

#include "core/random_stream.h"

namespace jnd::experiments {

/// How many items of each label there are to be put in order, and under which constraints;
/// labels are indices. For `mixed_order`, which words and checks it.
struct LabelProblem {
  std::vector<int> counts;         ///< One for each label, >= 1.
  std::vector<bool> may_be_first;  ///< One for each label.
  std::optional<int> max_in_a_row;
  int min_distance = 1;

  [[nodiscard]] int num_items() const noexcept;
};

/// A label for each place, or why there is none.
struct LabelOrder {
  enum class Outcome {
    kFound,
    kInfeasible,  ///< Proven: there is none.
    kGaveUp,      ///< Before it was found or proven.
  };
  Outcome outcome = Outcome::kGaveUp;
  std::vector<int> labels;
};

/// An order drawn with the same probability as a shuffle of the items that turned out to meet
/// the constraints: place by place, each label weighed by the number of ways to go on from it.
/// The numbers are found by recursion over states that differ in what matters alone: how many
/// items are left of each label, whatever its name, and which were used last. So whether there
/// is an order at all is decided as well. Gives up beyond `max_states`. Not real time.
[[nodiscard]] LabelOrder counted_order(const LabelProblem& problem, int max_states,
                                       core::RandomStream& stream);

/// An order built place by place, each label drawn by how many of it are left, among those that
/// leave room for the rest; where there is none, the last place is taken back. Not uniform.
/// Begins anew after a twentieth of `max_steps`, gives up after all of them. Not real time.
[[nodiscard]] LabelOrder searched_order(const LabelProblem& problem, int max_steps,
                                        core::RandomStream& stream);

}  // namespace jnd::experiments
