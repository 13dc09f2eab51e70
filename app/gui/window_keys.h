#pragma once

#include "app/gui/input_queue.h"

namespace jnd::app::gui {

/// Our key for one of GLFW's: the letter that the keyboard's layout prints on it, or the digit
/// of its row or keypad. `kNone` for keys that we do not use.
[[nodiscard]] Key key_of_glfw(int key, int scancode);

}  // namespace jnd::app::gui
