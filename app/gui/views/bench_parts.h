#pragma once

#include "app/gui/views/bench_view.h"

namespace jnd::app::gui {

// The parts of the view of a device, a file each.

/// Which device, its profile, and what was measured.
void draw_device_card(Ui& ui, const Rect& place, const BenchModel& model, BenchViewState& state,
                      BenchViewResult& result);
/// Commissioning, daily check, a small force.
void draw_work_card(Ui& ui, const Rect& place, const BenchModel& model, BenchViewState& state,
                    BenchViewResult& result);
void draw_bench_dialog(Ui& ui, const BenchModel& model, BenchViewState& state,
                       BenchViewResult& result);

/// Two columns of a line, the words at the left no wider than needed; returns its height.
float draw_device_line(Ui& ui, const Rect& place, const DeviceLine& line);

}  // namespace jnd::app::gui
