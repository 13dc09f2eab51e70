#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks that answers which a participant has to tell apart have different words: the two
/// answers of a block, the options of a choice, the ends of a scale. Not real time.
void check_label_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
