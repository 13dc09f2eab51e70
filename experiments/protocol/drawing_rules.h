#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Draws the first trial of every block and reports, at the key, what the procedure lacks. So
/// no session finds it out with a participant in the device. `with_check` also reports blocks
/// that can be drawn but cannot reach their goal (`Procedure::check`). The study must be valid
/// otherwise. Not real time.
void check_drawing(const LocatedJson& file, const Study& study,
                   std::vector<StudyProblem>& problems, bool with_check = true);

}  // namespace jnd::experiments
