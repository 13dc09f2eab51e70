#pragma once

#include <string>
#include <vector>

#include "app/gui/plot.h"
#include "app/operator/scope_trace.h"

namespace jnd::app::gui {

inline constexpr double kScopeSeconds = 10.0;

/// The least height of a scope, in the channel's unit; smaller changes are of no interest.
[[nodiscard]] double least_scope_span(const std::string& unit);

/// A range around all points. Its ends are multiples of about an eighth of its height, so that
/// it does not move with every sample.
[[nodiscard]] AxisRange scope_range(const std::vector<ScopePoint>& points,
                                    const std::string& unit);

/// The visible part of a channel in a place of this size with this range. Each column of pixels
/// has a line from the least to the largest value, so that no spike is lost, or a point if that
/// line is shorter than a pixel. The curve is broken where samples were lost. Times are in
/// seconds before the picture's newest sample.
[[nodiscard]] PlotSeries scope_curve(const std::vector<ScopePoint>& points,
                                     const ScopePicture& picture, const Rect& place,
                                     const AxisRange& range);

}  // namespace jnd::app::gui
