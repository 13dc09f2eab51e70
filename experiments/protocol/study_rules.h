#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks what involves several keys: names that must differ, stimuli that must fit each other,
/// arms that must exist. It looks only at values of the right type, so that one mistake is not
/// reported twice; `StructureCheck` reports the others. Not real time.
void check_study_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
