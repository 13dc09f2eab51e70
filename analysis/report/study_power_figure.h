#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/planning/power_summary.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// What the titles of power figures mention.
struct PowerFigureWords {
  std::string study, laboratory;
  std::int64_t num_runs = 0;
  /// If true, nothing differs, so shares are rates of false positives.
  bool null_hypothesis = false;
};

/// Figures of the power over the number of participants, if something is compared, and of the
/// half width of every estimate's interval.
[[nodiscard]] std::vector<Figure> power_figures(const PlannedAnalysis& analysis,
                                                const std::vector<PlannedSummary>& summaries,
                                                const PowerFigureWords& words);

}  // namespace jnd::analysis
