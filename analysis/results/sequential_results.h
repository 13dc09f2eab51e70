#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/results/planned_contrasts.h"
#include "analysis/statistics/sequential_test.h"

namespace jnd::analysis {

/// The rule of a study that plans looks, with the alpha and direction of the contrast that
/// decides. Throws `core::Error` where the study has no such contrast.
[[nodiscard]] SequentialRule sequential_rule(const experiments::Study& study);

/// What people's own contrasts come to at each look, of those who came until then. By the names
/// of those who came to each look since the one before. Not real time.
[[nodiscard]] std::vector<std::optional<EffectEstimate>> estimates_at_looks(
    const StudyData& data, const std::vector<std::vector<std::string>>& people_by_look);

/// Of a study that plans looks: the contrast that decides becomes the adjusted one (median
/// unbiased estimate, interval and p value in the stage-wise order), with what is not adjusted
/// beside it; where the rule has not ended the study, or for other contrasts, a caution says
/// that nothing is adjusted. Not real time.
void adjust_for_looks(std::vector<ContrastResult>& results, const StudyData& data);

}  // namespace jnd::analysis
