#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// Returns the JSON pointer of the number that gives a stage this amount of a medium: a test
/// stimulus, a reference, an end of an adjustment. If no number does (free space), it is the
/// pointer of the stage. Returns "" if there is no such stage. `root` is a valid study. Not
/// real time.
[[nodiscard]] std::string stimulus_pointer(const nlohmann::json& root,
                                           const std::string& stage_name,
                                           const MediumSetting& setting);

}  // namespace jnd::experiments
