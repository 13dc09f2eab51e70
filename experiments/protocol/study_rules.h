#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks what no single key can show: names that must differ, stimuli that must fit one
/// another, arms that must exist. Looks only at values of the right type, so that one mistake
/// is not told twice; `StructureCheck` tells of the others. Not real time.
void check_study_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
