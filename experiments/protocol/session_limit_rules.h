#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Compares what participants are expected to do with the limits of their study: the duration,
/// and the trials from break to break. The study must be valid otherwise. Not real time.
void check_session_limit_rules(const LocatedJson& file, const Study& study,
                               std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
