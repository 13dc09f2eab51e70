#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// Visits every stage of a study, as its file has it, with its JSON pointer: each before what
/// is inside it, arms before `between`, and a group before its `blocks`. Whatever is no stage
/// is passed over; `root` need not be a sound study.
void for_each_written_stage(
    const nlohmann::json& root,
    const std::function<void(const nlohmann::json& stage, const std::string& pointer)>& visit);

/// The same stages in the same order, once they were built; of a group its blocks alone.
void for_each_stage(const std::vector<Stage>& stages,
                    const std::function<void(const Stage& stage)>& visit);

}  // namespace jnd::experiments
