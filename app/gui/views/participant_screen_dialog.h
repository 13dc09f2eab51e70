#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/participant_place.h"

namespace jnd::app::gui {

struct ParticipantScreenResult {
  std::optional<ScreenChoice> chosen;
  bool is_closed = false;
};

/// Draws the dialog that chooses the monitor of the participant's screen. `problem` says why
/// the screen is not where it was wanted; "" if nothing is wrong.
[[nodiscard]] ParticipantScreenResult draw_participant_screen_dialog(
    Ui& ui, const ScreenChoice& choice, const std::vector<Monitor>& monitors,
    const std::string& problem);

}  // namespace jnd::app::gui
