#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// JSON pointer of the number that gives a stage this much of a medium, wherever it stands: a
/// test stimulus, a reference, an end of an adjustment. That of the stage where no number does
/// (free space), "" where there is no such stage. `root` is a sound study. Not real time.
[[nodiscard]] std::string stimulus_pointer(const nlohmann::json& root,
                                           const std::string& stage_name,
                                           const MediumSetting& setting);

}  // namespace jnd::experiments
