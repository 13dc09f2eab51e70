#pragma once

#include "app/gui/views/sessions_view.h"

namespace jnd::app::gui {

/// The height that `draw_work` needs.
[[nodiscard]] float work_height(const Ui& ui, float width, const StudyWork& work);
/// Draws the work in the background with its progress and "Cancel" (F2), or how the last work
/// ended. Returns true to cancel the work.
[[nodiscard]] bool draw_work(Ui& ui, Rect place, const StudyWork& work);

}  // namespace jnd::app::gui
