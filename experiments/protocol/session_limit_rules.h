#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Holds what participants are expected to do against the limits of their study: its duration,
/// trials from break to break. For a study that is sound otherwise. Not real time.
void check_session_limit_rules(const LocatedJson& file, const Study& study,
                               std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
