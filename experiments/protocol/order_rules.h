#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Orders that nobody can draw: constraints that no order of the stimuli keeps to, stimuli that
/// a block has not, methods that a procedure has no use for. Not real time.
void check_order_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
