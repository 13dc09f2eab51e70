#pragma once

#include "app/gui/plot.h"

namespace jnd::app::gui {

// Parts of `draw_plot`: how far its axes reach, and what is drawn inside them.

[[nodiscard]] AxisRange x_range_of(const PlotModel& model);
[[nodiscard]] AxisRange y_range_of(const PlotModel& model, int max_ticks);
/// Lengthens one of the ranges, so that a unit is equally long on both axes.
void equalise(PlotArea& area);

void draw_band(Ui& ui, const PlotArea& area, const PlotSeries& series);
void draw_curve(Ui& ui, const PlotArea& area, const PlotSeries& series);
void draw_points(Ui& ui, const PlotArea& area, const PlotSeries& series);
void draw_box(Ui& ui, const PlotArea& area, const PlotBox& box, float width);
void draw_mark(Ui& ui, const PlotArea& area, const PlotMark& mark);
/// Draws a dashed line between two places in ImGui's pixels. `drawn` is the length of the
/// dashed line that came before, so that the dashes go on evenly.
void draw_dashes(Ui& ui, float x0, float y0, float x1, float y1, std::uint32_t colour,
                 float thickness, float drawn = 0);

/// Draws a ring around what is under the mouse, if anything, and its values.
void draw_hover(Ui& ui, const PlotArea& area, const PlotModel& model);

}  // namespace jnd::app::gui
