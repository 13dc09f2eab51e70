#pragma once

#include <optional>

#include "core/storage/study_rows.h"
#include "experiments/procedures/planned_trial.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// A stored trial as it was drawn.
[[nodiscard]] experiments::PlannedTrial planned_trial(const core::TrialRow& row);

/// Whether the answer was right, where one can be in this block.
[[nodiscard]] std::optional<bool> was_right(const experiments::Block& block,
                                            const core::TrialRow& row);

}  // namespace jnd::analysis
