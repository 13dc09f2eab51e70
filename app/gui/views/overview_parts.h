#pragma once

#include "app/gui/views/overview_view.h"

namespace jnd::app::gui {

// The parts of a study's overview, each in a file of its own.

/// Draws how many participants are done, who comes next, and how old the backup is.
void draw_overview_figures(Ui& ui, const Rect& place, const OverviewModel& model,
                           OverviewState& state, OverviewResult& result);
/// Draws how even orders, arms and groups are.
void draw_balance(Ui& ui, const Rect& place, const StudyOverview& overview);
/// The height that the card of `draw_balance` needs at this width.
[[nodiscard]] float balance_height(const Ui& ui, float width, const StudyOverview& overview);
/// Draws how well each session went.
void draw_quality(Ui& ui, const Rect& place, const StudyOverview& overview,
                  OverviewState& state, OverviewResult& result);
void draw_schedule(Ui& ui, const Rect& place, const OverviewModel& model, OverviewState& state);
void draw_overview_dialog(Ui& ui, const OverviewModel& model, OverviewState& state,
                          OverviewResult& result);

}  // namespace jnd::app::gui
