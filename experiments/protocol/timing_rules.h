#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks the times of a block's trials: a stimulus that would have to end before it may, a
/// deadline before anybody may answer, and a trial that is expected to be shorter than its
/// stimuli. Another check reports values of the wrong type. Not real time.
void check_timing_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
