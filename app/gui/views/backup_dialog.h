#pragma once

#include <string>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// Asks where a backup of the study goes. `folder` is the proposal, and the person may change
/// it. Draws nothing unless `asks`. Returns true when the backup is to be made; `asks` is false
/// then.
[[nodiscard]] bool draw_backup_dialog(Ui& ui, bool& asks, bool& is_new, std::string& folder);

}  // namespace jnd::app::gui
