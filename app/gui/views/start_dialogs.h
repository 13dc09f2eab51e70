#pragma once

#include "app/gui/views/start_view.h"

namespace jnd::app::gui {

// The dialogs of the start view.

void open_new_dialog(const StartModel& model, StartViewState& state);
void open_open_dialog(StartViewState& state);

void draw_new_dialog(Ui& ui, const StartModel& model, StartViewState& state,
                     StartViewResult& result);
/// Draws the dialog that finds a study file for the new study.
void draw_browse_dialog(Ui& ui, const EntriesOf& entries_of, StartViewState& state);
void draw_open_dialog(Ui& ui, const EntriesOf& entries_of, StartViewState& state,
                      StartViewResult& result);

}  // namespace jnd::app::gui
