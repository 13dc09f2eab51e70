#pragma once

#include <string>

#include "analysis/charts/chart.h"
#include "analysis/charts/figure_source.h"

namespace jnd::analysis {

// What several kinds of charts share.

/// An axis of the block's quantity.
[[nodiscard]] ChartAxis quantity_chart_axis(const std::string& quantity,
                                            const std::string& label);

/// Puts an estimate beside the chart: its value in words, the interval in words, the reason and
/// the cautions. `words`: "w = 0.31", "0.21 Pa s"; used where there is a value. A line at the
/// value where `has_line`.
void add_value(Chart& chart, const std::optional<double>& value, const Interval& ci95,
               const std::string& reason, const std::vector<std::string>& cautions,
               const std::string& words);

}  // namespace jnd::analysis
