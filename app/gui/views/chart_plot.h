#pragma once

#include "analysis/charts/chart.h"
#include "app/gui/plot.h"
#include "app/operator/results_model.h"

namespace jnd::app::gui {

/// One chart of the set, for the plot widget. Proportions are shown in percent.
[[nodiscard]] PlotModel chart_plot(const analysis::ChartSet& set, const analysis::Chart& chart);
[[nodiscard]] PlotModel box_plot(const results::BoxFigure& figure);

}  // namespace jnd::app::gui
