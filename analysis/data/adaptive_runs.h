#pragma once

#include <vector>

#include "analysis/data/adaptive_run.h"
#include "analysis/data/study_data.h"
#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// The result of one participant's answers in one adaptive block by its own rule, as plain
/// data. `trials` are in their order and include those that were set aside, because the
/// procedure saw them. `set_aside` has the same length. The caller fills in participant and
/// block. If the answers do not fit the rule, the run's `problem` says so. Not real time.
[[nodiscard]] AdaptiveRun adaptive_run_of(const experiments::Block& block,
                                          const std::vector<core::TrialRow>& trials,
                                          const std::vector<bool>& set_aside);

/// Adds a run for each session of each participant in each adaptive block to `StudyData::runs`.
void add_adaptive_runs(StudyData& data);

}  // namespace jnd::analysis
