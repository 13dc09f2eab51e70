#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/planning/power_run.h"

namespace jnd::analysis {

/// The alpha of the tests.
inline constexpr double kPlannedLevel = 0.05;

/// The summary of one test at one size over all runs.
struct PlannedPower {
  std::int64_t num_runs = 0, num_significant = 0;
  /// The number of runs without a p value, which count as not significant.
  std::int64_t num_undefined = 0;
  double power = 0.0;  ///< The share of runs with p < 0.05.
  /// The 95 % Wilson interval of the power for this number of runs.
  double power_low = 0.0, power_high = 1.0;
  std::optional<double> mean_difference;  ///< The mean difference in ln ln(1 + w).
};

/// The summary of one estimate at one size over all runs.
struct PlannedPrecision {
  std::int64_t num_undefined = 0;  ///< The number of runs without a value.
  std::optional<double> median;    ///< The median of the estimates over all runs.
  /// The median of the estimates minus the laboratory's true value.
  std::optional<double> bias;
  /// Half widths of the 95 % interval over participants: the median over runs, and the value
  /// below which nine runs in ten stay. They are absent if too many intervals are open.
  std::optional<double> half_width_median, half_width_90;
  std::optional<double> coverage;  ///< The share of intervals that hold the true value.
  /// The 95 % Wilson interval of the coverage for this number of runs.
  double coverage_low = 0.0, coverage_high = 1.0;
  std::optional<double> degenerate;  ///< The share of participants without a fit of their own.
};

struct PlannedSummary {
  int num_participants = 0;
  std::vector<PlannedPower> tests;          ///< One entry for each of `test_names`.
  std::vector<PlannedPrecision> estimates;  ///< One entry for each of `estimate_names`.
  /// For each block, the share of participants whose posterior of QUEST+ reaches an end of a
  /// grid.
  std::vector<double> at_grid_end;
};

/// One summary for each size. Sums are taken in the order of the runs, so the same runs give
/// the same numbers to the last bit. Throws `core::Error` without runs. Not real time.
[[nodiscard]] std::vector<PlannedSummary> summary_of_runs(const PlannedAnalysis& analysis,
                                                          const std::vector<PlannedRun>& runs);

/// The true difference of the compared blocks in the laboratory, in ln ln(1 + w), first minus
/// second. It is absent if nothing is compared or a true value is unknown.
[[nodiscard]] std::optional<double> true_difference(const PlannedAnalysis& analysis);

/// Whether that difference is practically nothing, below half a percent of ln(1 + w). The share
/// of studies with p < 0.05 is then the rate of false positives, not a power.
[[nodiscard]] bool nothing_differs(const PlannedAnalysis& analysis);

/// Warnings about the plan, one sentence each. They name intervals that hold the true value too
/// rarely and, if nothing differs, tests that find a difference too often, provided that there
/// are enough runs to tell. They name grids of QUEST+ that end too early for more than one
/// participant in twenty. They also say that nothing differs, unless the null hypothesis was
/// asked for. Each estimate and test is judged at the largest size. A quick estimate is judged
/// only if the hierarchical one is not computed.
[[nodiscard]] std::vector<std::string> planning_doubts(
    const PlannedAnalysis& analysis, const std::vector<PlannedSummary>& summaries,
    bool null_hypothesis);

}  // namespace jnd::analysis
