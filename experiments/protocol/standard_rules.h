#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Checks rules about the standard of a block that involve several keys. `pointer` is that of
/// the block in the file. Appends to `problems`.
void check_standard(const LocatedJson& file, const nlohmann::json& block,
                    const std::string& pointer, std::vector<StudyProblem>& problems);

}  // namespace jnd::experiments
