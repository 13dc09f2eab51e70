#pragma once

#include "app/gui/input_queue.h"

namespace jnd::app::gui {

/// What GLFW's key means here: the letter that the person's keyboard layout prints on it, the
/// digit of its row or keypad. `kNone` for keys we have no use for.
[[nodiscard]] Key key_of_glfw(int key, int scancode);

}  // namespace jnd::app::gui
