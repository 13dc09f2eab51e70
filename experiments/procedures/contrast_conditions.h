#pragma once

#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// People with the same levels of the factors between people.
struct ContrastGroup {
  std::string name;  ///< "primed", or "" if there is only one group.
  Levels levels;
};

/// Blocks whose answers a contrast combines.
struct ContrastCondition {
  std::string name;                 ///< "thin, with_vision", or the name of its only block.
  std::vector<std::string> blocks;  ///< Names in the order of the study.
};

/// What a contrast compares: weights of conditions in groups of people.
struct ContrastConditions {
  std::vector<ContrastGroup> groups;
  std::vector<ContrastCondition> conditions;
  /// By group, then by condition. Over all of them the positive weights add up to 1 and the
  /// negative ones to -1; for an interaction of n factors, to 2^(n - 1).
  std::vector<std::vector<double>> weights;
  /// Why there are no conditions, in the words of an error; "" if there are some.
  std::string problem;
};

/// Whether people differ in this factor of a study, because it is a `one_of` counterbalance or
/// a participant field of that name.
[[nodiscard]] bool is_between_people(const Study& study, const std::string& factor);

/// Whether a block's answers can be compared in the contrast's measure. False for practice.
[[nodiscard]] bool has_measure(const Block& block, const PlannedContrast& contrast);

/// Returns the study's blocks that have the measure, with the weights of the contrast. Blocks
/// with the same levels are combined. A factor that the contrast does not name is averaged over
/// its levels. A factor between people that it does not name is averaged as well, if it is one
/// of the study's `factors`. The weights of each factor are scaled so that those above 0 add up
/// to 1 and those below 0 to -1. Not real time.
[[nodiscard]] ContrastConditions contrast_conditions(const Study& study,
                                                     const PlannedContrast& contrast);

}  // namespace jnd::experiments
