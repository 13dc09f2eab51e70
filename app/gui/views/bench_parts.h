#pragma once

#include "app/gui/views/bench_view.h"

namespace jnd::app::gui {

// Parts of the device's view, each in a file of its own.

/// Draws the device, its profile, and what was measured.
void draw_device_card(Ui& ui, const Rect& place, const BenchModel& model, BenchViewState& state,
                      BenchViewResult& result);
/// Draws the commissioning, the daily check, the small force or the watch.
void draw_work_card(Ui& ui, const Rect& place, const BenchModel& model, BenchViewState& state,
                    BenchViewResult& result);
void draw_bench_dialog(Ui& ui, const BenchModel& model, BenchViewState& state,
                       BenchViewResult& result);

/// Draws a line in two columns, where the left one is no wider than needed. Returns its height.
float draw_device_line(Ui& ui, const Rect& place, const DeviceLine& line);

}  // namespace jnd::app::gui
