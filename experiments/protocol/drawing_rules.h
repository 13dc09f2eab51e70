#pragma once

#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Has every block draw its first trial, and tells at its key what the procedure then misses,
/// so that no session finds it out with a participant in the device; `with_check`: and what a
/// block that can be drawn cannot come to (`Procedure::check`). For a study that is sound
/// otherwise. Not real time.
void check_drawing(const LocatedJson& file, const Study& study,
                   std::vector<StudyProblem>& problems, bool with_check = true);

}  // namespace jnd::experiments
