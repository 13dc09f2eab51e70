#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks how blocks ask: tasks that a procedure cannot follow, trials that would have to be
/// both the same and different, feedback that would unblind, and practice that cannot end.
/// Another check reports values of the wrong type. Not real time.
void check_task_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

/// Returns the catch trials in a repetition of a block with this many test stimuli, as the file
/// states them.
[[nodiscard]] double num_catch_trials(const nlohmann::json& block, std::size_t num_tests);

}  // namespace jnd::experiments
