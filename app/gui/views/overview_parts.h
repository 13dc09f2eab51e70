#pragma once

#include "app/gui/views/overview_view.h"

namespace jnd::app::gui {

// The parts of a study's overview, a file each.

/// How many are done, who comes next, how old the copy is.
void draw_overview_figures(Ui& ui, const Rect& place, const OverviewModel& model,
                           OverviewState& state, OverviewResult& result);
/// How even orders, arms and groups are.
void draw_balance(Ui& ui, const Rect& place, const StudyOverview& overview);
/// How high it wants to be.
[[nodiscard]] float balance_height(const Ui& ui, float width, const StudyOverview& overview);
/// How well each session went.
void draw_quality(Ui& ui, const Rect& place, const StudyOverview& overview,
                  OverviewState& state, OverviewResult& result);
void draw_schedule(Ui& ui, const Rect& place, const OverviewModel& model, OverviewState& state);
void draw_overview_dialog(Ui& ui, const OverviewModel& model, OverviewState& state,
                          OverviewResult& result);

}  // namespace jnd::app::gui
