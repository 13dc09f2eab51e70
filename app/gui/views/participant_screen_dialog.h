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

/// Over everything: where the participant's screen stands, as one of what there is. `problem`:
/// why it is not where it was wanted; "" for nothing.
[[nodiscard]] ParticipantScreenResult draw_participant_screen_dialog(
    Ui& ui, const ScreenChoice& choice, const std::vector<Monitor>& monitors,
    const std::string& problem);

}  // namespace jnd::app::gui
