#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Rules across the keys of a profile whose structure is sound: a rotation that is one, dates
/// in order, limits within what was measured, and numbers that are still those that were
/// measured. Appends to `problems`. Not real time.
void check_profile_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
