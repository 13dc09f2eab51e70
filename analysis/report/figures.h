#pragma once

#include <string>
#include <vector>

#include "analysis/charts/figure_source.h"
#include "analysis/movement/movement_analysis.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

// One function a kind of data; each gives the figures there are data for, in the order of the
// report; what the window shows as well are charts, see analysis/charts/charts.h. Not real
// time.

/// Weber fractions (D.21) and difference thresholds (D.22, which calls them absolute ones) of
/// every block.
[[nodiscard]] std::vector<Figure> weber_figures(const FigureSource& source);

/// Repetitions of estimation (D.8), boxes (D.1, D.2, D.10, D.11), ratios of productions (D.13).
[[nodiscard]] std::vector<Figure> magnitude_figures(const FigureSource& source);

/// Published values among simulated studies where those are known, else ours over published,
/// estimate by estimate.
[[nodiscard]] std::vector<Figure> published_figures(const FigureSource& source);

/// Stroke width and speed of every participant, from summaries of strokes (D.17, D.25).
[[nodiscard]] std::vector<Figure> stroke_figures(const FigureSource& source);

/// What takes recordings: trajectories (D.16, D.24), joint angles over a stroke (D.18, D.26),
/// torque over velocity (D.19, D.27), distance of tips to the end effector (D.28), force over
/// speed.
[[nodiscard]] std::vector<Figure> recording_figures(const FigureSource& source,
                                                    const MovementAnalysis& movement);

}  // namespace jnd::analysis
