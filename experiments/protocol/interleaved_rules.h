#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Rules of blocks whose trials are mixed: what cannot be had among the trials of others.
void check_interleaved_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
