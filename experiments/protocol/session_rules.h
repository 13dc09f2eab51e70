#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks a study as a session: stages that nobody would get, media shorter than their own
/// ramp, and a session longer than anyone can endure. Not real time.
void check_session_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
