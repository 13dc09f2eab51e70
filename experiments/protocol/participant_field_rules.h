#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks participant fields: their names must be unique, counterbalances must be stratified by
/// one of them, and every field must be used for stratification. Not real time.
void check_participant_field_rules(const LocatedJson& file,
                                   std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
