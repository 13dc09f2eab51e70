#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/results/planned_contrasts.h"
#include "analysis/statistics/sequential_test.h"

namespace jnd::analysis {

/// The rule of a study that plans looks, with the alpha and direction of the contrast that
/// decides. Throws `core::Error` if the study has no such contrast.
[[nodiscard]] SequentialRule sequential_rule(const experiments::Study& study);

/// The estimate from people's own contrasts at each look, over the people who took part until
/// then. `people_by_look` holds the names of those who came since the look before.
/// Not real time.
[[nodiscard]] std::vector<std::optional<EffectEstimate>> estimates_at_looks(
    const StudyData& data, const std::vector<std::vector<std::string>>& people_by_look);

/// For a study that plans looks, replaces the deciding contrast by the adjusted one (median
/// unbiased estimate, interval and p value in the stage-wise order), and keeps the unadjusted
/// one beside it. If the rule has not ended the study, and for other contrasts, a caution says
/// that nothing is adjusted. Not real time.
void adjust_for_looks(std::vector<ContrastResult>& results, const StudyData& data);

}  // namespace jnd::analysis
