#pragma once

#include "app/gui/ui.h"
#include "app/operator/session_view.h"

namespace jnd::app::gui {

/// The participant's own window: what to do, in the language of the study, the hand sign that
/// the experimenter shows, and how far the session is. Never a level, a force or the scene.
void draw_participant_view(Ui& ui, const SessionView& view);

}  // namespace jnd::app::gui
