#pragma once

#include "app/gui/plot.h"
#include "app/operator/results_model.h"

namespace jnd::app::gui {

// What the results view plots, from its model.

/// In percent: rings with intervals, or where levels are many rings that grow with the answers.
[[nodiscard]] PlotSeries answer_points(const std::vector<results::Proportion>& proportions,
                                       bool has_fixed_levels);
[[nodiscard]] PlotModel psychometric_plot(const results::Discrimination& block,
                                          const results::PsychometricFigure& figure);
[[nodiscard]] PlotModel magnitude_plot(const results::Magnitude& magnitude,
                                       const results::MagnitudeFigure& figure);
[[nodiscard]] PlotModel box_plot(const results::BoxFigure& figure);

}  // namespace jnd::app::gui
