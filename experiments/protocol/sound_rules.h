#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks `masking_noise` and `cues`: each has one level, a band is valid, and each cue has a
/// moment. What is heard must not tell participants which block it is if they should not know.
void check_sound_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
