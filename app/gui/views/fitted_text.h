#pragma once

#include <string>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// As many whole words as fit into a place that wraps them, with an ellipsis if some are left
/// out; "" if the place has no room for a line.
[[nodiscard]] std::string fitted(const Ui& ui, const Rect& place, std::string words,
                                 const TextStyle& style);

/// Draws the words that fit. If some are left out, the mouse shows all of them.
float draw_fitted(Ui& ui, const Rect& place, const std::string& words, const TextStyle& style);

}  // namespace jnd::app::gui
