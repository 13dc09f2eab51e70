#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks for orders that cannot be drawn: constraints that no order of the stimuli meets,
/// stimuli that a block lacks, and methods that a procedure cannot use. Not real time.
void check_order_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
