#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Adds what is wrong with the times of a block's trials: a stimulus that would have to end
/// before it may, a deadline before which nobody may answer, a trial that is expected to be
/// shorter than its stimuli. Values of the wrong type are another check's. Not real time.
void check_timing_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
