#pragma once

#include <vector>

#include "analysis/data/adaptive_run.h"
#include "analysis/data/study_data.h"
#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// What the answers of one participant in one adaptive block come to by its own rule, as plain
/// data. `trials` in their order, those set aside among them, for the procedure saw them;
/// `set_aside` of the same length. Participant and block are the caller's to name. A rule that
/// the answers do not fit is a problem that the run names. Not real time.
[[nodiscard]] AdaptiveRun adaptive_run_of(const experiments::Block& block,
                                          const std::vector<core::TrialRow>& trials,
                                          const std::vector<bool>& set_aside);

/// Adds one for each session of each participant in each adaptive block: `StudyData::runs`.
void add_adaptive_runs(StudyData& data);

}  // namespace jnd::analysis
