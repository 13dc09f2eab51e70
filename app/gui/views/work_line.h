#pragma once

#include "app/gui/views/sessions_view.h"

namespace jnd::app::gui {

/// How high it wants to be.
[[nodiscard]] float work_height(const Ui& ui, float width, const StudyWork& work);
/// What goes on beside the window with its progress and "Cancel" (F2), or what came of the last
/// of it. Returns whether to cancel.
[[nodiscard]] bool draw_work(Ui& ui, Rect place, const StudyWork& work);

}  // namespace jnd::app::gui
