#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/results/discrimination_answers.h"
#include "analysis/results/discrimination_group.h"
#include "experiments/procedures/contrast_conditions.h"

namespace jnd::analysis {

/// The place of the group that a participant belongs to; none where the contrast has no weight
/// for their arm.
[[nodiscard]] std::optional<std::size_t> group_of(
    const ParticipantData& participant, const experiments::ContrastConditions& conditions);

/// Everybody's comparisons in all blocks of a condition together. What depends on the order of
/// the trials is that of the first block alone.
[[nodiscard]] std::vector<DiscriminationAnswers> condition_answers(
    const StudyData& data, const experiments::ContrastCondition& condition);

}  // namespace jnd::analysis
