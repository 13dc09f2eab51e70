#pragma once

#include <string>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// As many whole words as there is room for in a place that wraps them, with an ellipsis behind
/// them where some are left out; "" where there is no room for a line.
[[nodiscard]] std::string fitted(const Ui& ui, const Rect& place, std::string words,
                                 const TextStyle& style);

/// Draws as many; where some are left out, all of them show when they are pointed at.
float draw_fitted(Ui& ui, const Rect& place, const std::string& words, const TextStyle& style);

}  // namespace jnd::app::gui
