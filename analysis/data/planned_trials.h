#pragma once

#include <optional>

#include "core/storage/study_rows.h"
#include "experiments/procedures/planned_trial.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// A stored trial in the form in which it was drawn.
[[nodiscard]] experiments::PlannedTrial planned_trial(const core::TrialRow& row);

/// Whether the answer was right, if an answer can be right in this block.
[[nodiscard]] std::optional<bool> was_right(const experiments::Block& block,
                                            const core::TrialRow& row);

}  // namespace jnd::analysis
