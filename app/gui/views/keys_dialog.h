#pragma once

#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// Every key that does something now: those of the program, and of what `widgets` are on
/// screen, as one reads them. Returns whether it was closed.
[[nodiscard]] bool draw_keys_dialog(Ui& ui, std::vector<Drawn::Widget> widgets);

}  // namespace jnd::app::gui
