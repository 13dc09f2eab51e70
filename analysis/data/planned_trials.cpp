#include "analysis/data/planned_trials.h"

#include "experiments/procedures/procedure_registry.h"

namespace jnd::analysis {

experiments::PlannedTrial planned_trial(const core::TrialRow& row) {
  const auto small = [](const std::optional<std::int64_t>& value) {
    return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
  };
  experiments::PlannedTrial planned{.repetition = static_cast<int>(row.repetition),
                                    .position = static_cast<int>(row.position),
                                    .intensity = row.intensity,
                                    .reference_intensity = row.reference_intensity,
                                    .starting_intensity = row.starting_intensity,
                                    .target_percent = row.target_percent,
                                    .is_catch = row.is_catch};
  planned.series = small(row.series);
  planned.test_interval = small(row.test_interval);
  planned.intervals = row.intervals;
  planned.right_interval = small(row.right_interval);
  return planned;
}

std::optional<bool> was_right(const experiments::Block& block, const core::TrialRow& row) {
  if (!row.response) return std::nullopt;
  const std::optional<double> right =
      experiments::procedure_named(row.procedure).right_response(block, planned_trial(row));
  return right ? std::optional(*row.response == *right) : std::nullopt;
}

}  // namespace jnd::analysis
