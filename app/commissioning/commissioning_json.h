#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/commissioning/commissioning.h"

namespace jnd::app {

/// What a step found, as it is kept and printed. The step has been measured.
[[nodiscard]] nlohmann::ordered_json step_json(CommissioningStep step,
                                               const CommissioningResults& results);
/// Puts it back. Throws nlohmann's errors where something is missing.
void read_step_json(CommissioningStep step, const nlohmann::json& found,
                    CommissioningResults& results);
/// All that was measured, by the names of the steps.
[[nodiscard]] nlohmann::ordered_json results_json(const CommissioningResults& results);

}  // namespace jnd::app
