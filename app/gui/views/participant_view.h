#pragma once

#include <string>

#include "app/gui/ui.h"
#include "app/operator/participant_words.h"

namespace jnd::app::gui {

/// Since when the participant has been reading a text of several pages.
struct ParticipantViewState {
  std::string read;  ///< The whole text, which tells it from others.
  double since_s = 0.0;
};

/// The participant's own screen: what to do, what can be answered and how, the hand sign that
/// the experimenter shows, and how far the session is. Letters are as large as fits. A text
/// that is too long even in the smallest letters is shown page by page, each for as long as it
/// takes to read. The screen has no controls.
void draw_participant_view(Ui& ui, const ParticipantScreen& shown, ParticipantViewState& state);

}  // namespace jnd::app::gui
