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

/// Psychometric curves (fig. 5, D.5, D.6, D.20, D.23 of the thesis).
[[nodiscard]] std::vector<Figure> discrimination_figures(const FigureSource& source);
/// Weber fractions (D.21) and difference thresholds (D.22, which calls them absolute ones) of
/// every block.
[[nodiscard]] std::vector<Figure> weber_figures(const FigureSource& source);

/// Curves of estimation and production (fig. 4a and b, D.3, D.9, D.12, D.14), repetitions
/// (D.8), boxes (D.1, D.2, D.10, D.11), ratios of productions (D.13).
[[nodiscard]] std::vector<Figure> magnitude_figures(const FigureSource& source);

/// The power laws of both and between them (fig. 4c, D.4, D.15).
[[nodiscard]] std::vector<Figure> power_law_figures(const FigureSource& source);

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
