#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks what participants bring: fields with a name of their own, counterbalances that are
/// stratified by one of them, none that nothing is stratified by. Not real time.
void check_participant_field_rules(const LocatedJson& file,
                                   std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
