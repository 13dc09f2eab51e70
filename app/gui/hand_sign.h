#pragma once

#include "app/gui/ui.h"
#include "app/operator/session_view.h"

namespace jnd::app::gui {

/// Draws the sign as large as fits; nothing for `kNone`. Its inside is filled with `ground`,
/// the colour on which it is drawn. The log of widgets notes it as, for example, "hand sign
/// fist".
void draw_hand_sign(Ui& ui, const Rect& place, HandSign sign, Colour ink = Colour::kInk,
                    Colour ground = Colour::kCard);

/// The sign in words: "fist", "one finger"; "" for none.
[[nodiscard]] const char* words(HandSign sign) noexcept;

}  // namespace jnd::app::gui
