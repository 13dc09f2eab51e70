#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks names and levels of factors, levels of blocks and weights of contrasts against each
/// other, as the file has them. Not real time.
void check_design_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

/// Checks that every contrast has blocks to compare, and that blocks with the same levels are
/// alike. The study must be valid otherwise. Not real time.
void check_contrasts(const LocatedJson& file, const Study& study,
                     std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
