#pragma once

#include <vector>

#include "analysis/charts/chart.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// The charts as figures of the report. A set becomes panels, one for each participant, in as
/// many figures as needed, or everybody's chart alone. Not real time.
[[nodiscard]] std::vector<Figure> chart_figures(const std::vector<ChartSet>& charts);

}  // namespace jnd::analysis
