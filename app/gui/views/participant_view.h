#pragma once

#include <string>

#include "app/gui/ui.h"
#include "app/operator/participant_words.h"

namespace jnd::app::gui {

/// Since when a text that takes several pages is being read.
struct ParticipantViewState {
  std::string read;  ///< What it is, told apart by its words.
  double since_s = 0.0;
};

/// The participant's own screen: what to do, what can be answered and how, the hand sign that
/// the experimenter shows, and how far the session is. Letters are as large as fits; a text
/// that is too long for the smallest is shown page by page, each as long as it takes to read.
/// Nothing on it can be used.
void draw_participant_view(Ui& ui, const ParticipantScreen& shown, ParticipantViewState& state);

}  // namespace jnd::app::gui
