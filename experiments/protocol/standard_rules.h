#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Rules about what a block has as its standard, which no key shows by itself. `pointer`: of
/// the block in the file. Appends to `problems`.
void check_standard(const LocatedJson& file, const nlohmann::json& block,
                    const std::string& pointer, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
