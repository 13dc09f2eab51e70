#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Adds what is wrong with how blocks ask: tasks that a procedure cannot follow, trials that
/// have to be the same and differ, feedback that would unblind, practice that cannot end.
/// Values of the wrong type are another check's. Not real time.
void check_task_rules(const LocatedJson& file, std::vector<StudyProblem>& problems);

/// Catch trials of a repetition of a block with so many test stimuli, as it is written.
[[nodiscard]] double num_catch_trials(const nlohmann::json& block, std::size_t num_tests);

}  // namespace jnd::experiments
