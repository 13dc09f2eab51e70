#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "analysis/planning/power_summary.h"
#include "app/planning/power_study.h"

namespace jnd::app {

/// Everything that says what the runs are about; it is the same for all shards of a study.
[[nodiscard]] nlohmann::ordered_json to_json(const PowerDesign& design);
/// Reads that JSON. Throws `core::Error` or a JSON exception for anything else.
[[nodiscard]] PowerDesign power_design_of(const nlohmann::ordered_json& json);

/// One run, with every number exactly as it was computed.
[[nodiscard]] nlohmann::ordered_json to_json(const analysis::PlannedRun& run);
[[nodiscard]] analysis::PlannedRun planned_run_of(const nlohmann::ordered_json& json,
                                                  const analysis::PlannedAnalysis& analysis);

/// What `jnd power --json` prints.
[[nodiscard]] nlohmann::ordered_json power_result(
    const PowerDesign& design, const std::vector<analysis::PlannedSummary>& summaries,
    const std::optional<analysis::SequentialPower>& sequential);

}  // namespace jnd::app
