#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "experiments/study/study_problem.h"

namespace jnd::app {

/// The contract's JSON: `{"problems": [{file, line, column, pointer, message}]}`.
[[nodiscard]] nlohmann::ordered_json problems_json(
    const std::vector<experiments::StudyProblem>& problems);

}  // namespace jnd::app
