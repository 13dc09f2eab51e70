#pragma once

#include <string>
#include <vector>

#include "app/gui/plot.h"
#include "app/operator/scope_trace.h"

namespace jnd::app::gui {

inline constexpr double kScopeSeconds = 10.0;

/// What less than this is of no interest, in a channel's unit: a scope's whole height.
[[nodiscard]] double least_scope_span(const std::string& unit);

/// Around all points, on multiples of about an eighth of its height: it does not move with
/// every sample.
[[nodiscard]] AxisRange scope_range(const std::vector<ScopePoint>& points,
                                    const std::string& unit);

/// What can be seen of a channel in a place of this size with this range: in each column of
/// pixels from the least to the largest value, so no spike is lost; a point where that is less
/// than a pixel. Broken where samples were lost. Times are before the picture's newest.
[[nodiscard]] PlotSeries scope_curve(const std::vector<ScopePoint>& points,
                                     const ScopePicture& picture, const Rect& place,
                                     const AxisRange& range);

}  // namespace jnd::app::gui
