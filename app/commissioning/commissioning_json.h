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
/// The single readings that a step rests on, as they are kept beside what it found: a report
/// draws them. The step has been measured.
[[nodiscard]] nlohmann::ordered_json points_json(CommissioningStep step,
                                                 const CommissioningResults& results);
/// Puts them back, into what `read_step_json` has put back. Throws nlohmann's errors.
void read_points_json(CommissioningStep step, const nlohmann::json& points,
                      CommissioningResults& results);
/// Under what a step is measured: all of the plan but the marks, which are points.
[[nodiscard]] nlohmann::ordered_json conditions_json(const MeasuringPlan& plan);
[[nodiscard]] MeasuringConditions conditions_in(const nlohmann::json& conditions);
/// All that was measured, by the names of the steps.
[[nodiscard]] nlohmann::ordered_json results_json(const CommissioningResults& results);

}  // namespace jnd::app
