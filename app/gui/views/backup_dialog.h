#pragma once

#include <string>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// Where a copy of the study goes: `folder` is proposed, and may be typed anew. Nothing is
/// drawn unless `asks`. True when the copy is to be made; `asks` is false then.
[[nodiscard]] bool draw_backup_dialog(Ui& ui, bool& asks, bool& is_new, std::string& folder);

}  // namespace jnd::app::gui
