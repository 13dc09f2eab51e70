#pragma once

#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// What was asked in the dialog.
struct KeysResult {
  bool closed = false;
  bool opens_manual = false;  ///< The page about the view below.
};

/// Every key that does something now: those of the program, and of what `widgets` are on
/// screen, as one reads them; and the way to the manual.
[[nodiscard]] KeysResult draw_keys_dialog(Ui& ui, std::vector<Drawn::Widget> widgets);

}  // namespace jnd::app::gui
