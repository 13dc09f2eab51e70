#pragma once

#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// What the person asked for in the dialog.
struct KeysResult {
  bool closed = false;
  bool opens_manual = false;  ///< Opens the manual's page about the view below.
};

/// Lists every key that does something now: the program's keys, and those of the `widgets` on
/// the screen in reading order. A button leads to the manual.
[[nodiscard]] KeysResult draw_keys_dialog(Ui& ui, std::vector<Drawn::Widget> widgets);

}  // namespace jnd::app::gui
