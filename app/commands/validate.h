#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/study/study_problem.h"

namespace jnd::app {

/// The problems as the JSON that docs/reference/json.md describes: `{"problems": [{file, line,
/// column, pointer, message}]}`.
[[nodiscard]] nlohmann::ordered_json problems_json(
    const std::vector<experiments::StudyProblem>& problems);

/// What a command prints with `--json` before exit code 1 if it has nothing else: `problems` of
/// a study file, or `{"error": sentence}`.
[[nodiscard]] std::string error_json(const core::Error& error);

}  // namespace jnd::app
