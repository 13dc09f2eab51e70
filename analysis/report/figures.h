#pragma once

#include <string>
#include <vector>

#include "analysis/charts/figure_source.h"
#include "analysis/movement/movement_analysis.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

// There is one function for each kind of data. Each returns the figures for which there are
// data, in the order of the report. What the window shows too is a chart; see
// analysis/charts/charts.h. Not real time.

/// Weber fractions (D.21) and difference thresholds (D.22, where they are called absolute
/// thresholds) of every block.
[[nodiscard]] std::vector<Figure> weber_figures(const FigureSource& source);

/// Repetitions of estimation (D.8), boxes (D.1, D.2, D.10, D.11), ratios of productions (D.13).
[[nodiscard]] std::vector<Figure> magnitude_figures(const FigureSource& source);

/// Published values among those of simulated studies, if these are available. Otherwise our
/// values divided by the published ones, for each estimate.
[[nodiscard]] std::vector<Figure> published_figures(const FigureSource& source);

/// The stroke width and speed of every participant, from summaries of strokes (D.17, D.25).
[[nodiscard]] std::vector<Figure> stroke_figures(const FigureSource& source);

/// Figures that need recordings: trajectories (D.16, D.24), joint angles over a stroke
/// (D.18, D.26), torque over velocity (D.19, D.27), distance of tips from the end effector
/// (D.28), and force over speed.
[[nodiscard]] std::vector<Figure> recording_figures(const FigureSource& source,
                                                    const MovementAnalysis& movement);

}  // namespace jnd::analysis
