#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Rules of `masking_noise` and `cues`: one level each, a band that is one, a cue for a moment,
/// and that what is heard tells nobody which block it is who should not know.
void check_sound_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
