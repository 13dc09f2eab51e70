#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/planning/power_run.h"

namespace jnd::analysis {

/// Level of the tests.
inline constexpr double kPlannedLevel = 0.05;

/// Over all runs, of one test at one size.
struct PlannedPower {
  std::int64_t num_runs = 0, num_significant = 0;
  std::int64_t num_undefined = 0;            ///< Without a p value: counted as not significant.
  double power = 0.0;                        ///< Share of runs with p < 0.05.
  double power_low = 0.0, power_high = 1.0;  ///< 95 %, Wilson: how well so many runs tell it.
  std::optional<double> mean_difference;     ///< In ln ln(1 + w).
};

/// Over all runs, of one estimate at one size.
struct PlannedPrecision {
  std::int64_t num_undefined = 0;  ///< Runs without a value.
  std::optional<double> median;    ///< Median of the estimates over all runs.
  std::optional<double> bias;      ///< That median minus the laboratory's true value.
  /// Half width of the 95 % interval over participants: in the median run, and what nine runs
  /// in ten stay below; none where that many intervals are open.
  std::optional<double> half_width_median, half_width_90;
  std::optional<double> coverage;  ///< Share of intervals that hold the true value.
  double coverage_low = 0.0, coverage_high = 1.0;  ///< 95 %, Wilson: how well the runs tell it.
  std::optional<double> degenerate;  ///< Share of participants without a fit of their own.
};

struct PlannedSummary {
  int num_participants = 0;
  std::vector<PlannedPower> tests;          ///< One for each of `test_names`.
  std::vector<PlannedPrecision> estimates;  ///< One for each of `estimate_names`.
  /// By block: share of participants whose posterior of QUEST+ reaches an end of a grid.
  std::vector<double> at_grid_end;
};

/// One summary a size; sums go in the order of the runs, so that the same runs give the same
/// numbers to the last bit. Throws `core::Error` without runs. Not real time.
[[nodiscard]] std::vector<PlannedSummary> summary_of_runs(const PlannedAnalysis& analysis,
                                                          const std::vector<PlannedRun>& runs);

/// How far the compared blocks lie apart in the laboratory, in ln ln(1 + w), first minus
/// second; none where nothing is compared or a true value is not known.
[[nodiscard]] std::optional<double> true_difference(const PlannedAnalysis& analysis);

/// Whether that is as good as nothing, below half a percent of ln(1 + w): then the share of
/// studies with p < 0.05 is the rate of false positives, not a power.
[[nodiscard]] bool nothing_differs(const PlannedAnalysis& analysis);

/// What not to plan on, a sentence each: intervals that hold the true value too rarely, and
/// where nothing differs tests that find a difference too often, where the runs are enough to
/// tell; and grids of QUEST+ that end too early for more than one in twenty. Also that nothing
/// differs, unless the null hypothesis was asked for. Of every estimate and test the largest
/// size speaks; of a quick estimate only where the hierarchical one is not beside it.
[[nodiscard]] std::vector<std::string> planning_doubts(
    const PlannedAnalysis& analysis, const std::vector<PlannedSummary>& summaries,
    bool null_hypothesis);

}  // namespace jnd::analysis
