#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// Visits every stage of a study, as its file has it, with its JSON pointer. A stage comes
/// before those inside it, arms before `between`, and a group before its `blocks`. It skips
/// what is no stage; `root` need not be a valid study.
void for_each_written_stage(
    const nlohmann::json& root,
    const std::function<void(const nlohmann::json& stage, const std::string& pointer)>& visit);

/// Visits the same stages in the same order after they were built. Of a group it visits only
/// the blocks.
void for_each_stage(const std::vector<Stage>& stages,
                    const std::function<void(const Stage& stage)>& visit);

}  // namespace jnd::experiments
