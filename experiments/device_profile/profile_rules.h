#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks rules across the keys of a profile whose structure is correct: the rotation is a
/// rotation, dates are in order, limits are within what was measured, and measured numbers are
/// unchanged. Appends to `problems`. Not real time.
void check_profile_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
