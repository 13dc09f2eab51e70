#pragma once

#include "app/gui/ui.h"
#include "app/operator/session_view.h"

namespace jnd::app::gui {

/// The sign as a drawing, as large as fits; nothing for `kNone`. It stands on `ground`, which
/// its inside is filled with. Noted as "hand sign fist" among what was drawn.
void draw_hand_sign(Ui& ui, const Rect& place, HandSign sign, Colour ink = Colour::kInk,
                    Colour ground = Colour::kCard);

/// "fist", "one finger"; "" for none.
[[nodiscard]] const char* words(HandSign sign) noexcept;

}  // namespace jnd::app::gui
