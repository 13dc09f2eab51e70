#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/commissioning/commissioning.h"

namespace jnd::app {

/// What a step found, as it is stored and printed. The step has to be measured.
[[nodiscard]] nlohmann::ordered_json step_json(CommissioningStep step,
                                               const CommissioningResults& results);
/// Reads that JSON into `results`. Throws nlohmann's errors if something is missing.
void read_step_json(CommissioningStep step, const nlohmann::json& found,
                    CommissioningResults& results);
/// The single readings on which a step rests, as they are stored beside what it found; a report
/// draws them. The step has to be measured.
[[nodiscard]] nlohmann::ordered_json points_json(CommissioningStep step,
                                                 const CommissioningResults& results);
/// Reads these points into what `read_step_json` has read. Throws nlohmann's errors.
void read_points_json(CommissioningStep step, const nlohmann::json& points,
                      CommissioningResults& results);
/// The conditions under which a step is measured: the whole plan except the marks, which are
/// points.
[[nodiscard]] nlohmann::ordered_json conditions_json(const MeasuringPlan& plan);
[[nodiscard]] MeasuringConditions conditions_in(const nlohmann::json& conditions);
/// Everything that was measured, by the names of the steps.
[[nodiscard]] nlohmann::ordered_json results_json(const CommissioningResults& results);

}  // namespace jnd::app
