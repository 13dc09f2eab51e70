#pragma once

#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// People of the same levels of the factors that people differ in.
struct ContrastGroup {
  std::string name;  ///< "primed", or "" where nobody differs.
  Levels levels;
};

/// Blocks whose answers a contrast takes together.
struct ContrastCondition {
  std::string name;                 ///< "thin, with_vision", or that of its only block.
  std::vector<std::string> blocks;  ///< Names, in the order of the study.
};

/// What a contrast compares: weights of conditions in groups of people.
struct ContrastConditions {
  std::vector<ContrastGroup> groups;
  std::vector<ContrastCondition> conditions;
  /// By group, then by condition. Over all of them the positive ones add up to 1 and the
  /// negative ones to -1; of an interaction of n factors to 2^(n - 1).
  std::vector<std::vector<double>> weights;
  std::string problem;  ///< Why there are none, as an error says it; "" if there are.
};

/// Whether people differ in this factor of a study: it is a `one_of` counterbalance or a
/// participant field of that name.
[[nodiscard]] bool is_between_people(const Study& study, const std::string& factor);

/// Whether a block's answers can be compared in what the contrast compares. Not of practice.
[[nodiscard]] bool has_measure(const Block& block, const PlannedContrast& contrast);

/// The study's blocks that have the measure, taken together where all levels that they state
/// are the same, with the weights that the contrast gives them. A factor that it does not name
/// is averaged over its levels; a factor of people that it does not name as well, where it is
/// one of the study's `factors`. Weights of each factor are scaled so that those above 0 add up
/// to 1 and those below 0 to -1. Not real time.
[[nodiscard]] ContrastConditions contrast_conditions(const Study& study,
                                                     const PlannedContrast& contrast);

}  // namespace jnd::experiments
