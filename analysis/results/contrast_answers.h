#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/results/discrimination_answers.h"
#include "analysis/results/discrimination_group.h"
#include "experiments/procedures/contrast_conditions.h"

namespace jnd::analysis {

/// The index of the group to which a participant belongs. It is absent if the contrast has no
/// weight for the participant's arm.
[[nodiscard]] std::optional<std::size_t> group_of(
    const ParticipantData& participant, const experiments::ContrastConditions& conditions);

/// Everybody's comparisons in all blocks of a condition, pooled. Values that depend on the
/// order of the trials use only the first block.
[[nodiscard]] std::vector<DiscriminationAnswers> condition_answers(
    const StudyData& data, const experiments::ContrastCondition& condition);

}  // namespace jnd::analysis
