#pragma once

#include "app/gui/plot.h"

namespace jnd::app::gui {

// For `draw_plot` alone: how far its axes reach, and what is inside them.

[[nodiscard]] AxisRange x_range_of(const PlotModel& model);
[[nodiscard]] AxisRange y_range_of(const PlotModel& model, int max_ticks);
/// Makes one range longer, so that a unit is as long on both axes.
void equalise(PlotArea& area);

void draw_band(Ui& ui, const PlotArea& area, const PlotSeries& series);
void draw_curve(Ui& ui, const PlotArea& area, const PlotSeries& series);
void draw_points(Ui& ui, const PlotArea& area, const PlotSeries& series);
void draw_box(Ui& ui, const PlotArea& area, const PlotBox& box, float width);
void draw_mark(Ui& ui, const PlotArea& area, const PlotMark& mark);
/// From one place to another, in ImGui's pixels; `drawn`: how much of the line came before.
void draw_dashes(Ui& ui, float x0, float y0, float x1, float y1, std::uint32_t colour,
                 float thickness, float drawn = 0);

/// What is under the mouse, where something is: a ring around it and its values.
void draw_hover(Ui& ui, const PlotArea& area, const PlotModel& model);

}  // namespace jnd::app::gui
