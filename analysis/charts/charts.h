#pragma once

#include <vector>

#include "analysis/charts/chart.h"
#include "analysis/charts/figure_source.h"

namespace jnd::analysis {

// Each function makes the charts of one kind for all blocks.

/// Means of estimation and production with their power laws, and the law between the two.
[[nodiscard]] std::vector<ChartSet> magnitude_charts(const FigureSource& source);
/// Answers in blocks with a reference, with the curve of the median person and everybody's own
/// curve.
[[nodiscard]] std::vector<ChartSet> psychometric_charts(const FigureSource& source);
/// Matches over standards, with the matching function.
[[nodiscard]] std::vector<ChartSet> matching_charts(const FigureSource& source);
/// Answers of yes-no and same-different blocks with their curves.
[[nodiscard]] std::vector<ChartSet> threshold_charts(const FigureSource& source);
/// Levels of adaptive blocks over the trials, with reversals marked.
[[nodiscard]] std::vector<ChartSet> track_charts(const FigureSource& source);

/// Response times over the stimuli of blocks whose study file lists them.
[[nodiscard]] std::vector<ChartSet> response_time_charts(const FigureSource& source);

/// Ratings and answers to questions after trials over the stimuli, where levels are fixed.
[[nodiscard]] std::vector<ChartSet> rated_charts(const FigureSource& source);

/// In the order of the report and the window. A new kind needs a file of its own and an entry
/// here.
inline constexpr std::vector<ChartSet> (*kChartKinds[])(const FigureSource&) = {
    magnitude_charts, psychometric_charts, matching_charts,     threshold_charts,
    track_charts,     rated_charts,        response_time_charts};

/// All charts for which there are data. Not real time.
[[nodiscard]] std::vector<ChartSet> charts_of(const FigureSource& source);

}  // namespace jnd::analysis
