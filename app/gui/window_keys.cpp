#include "app/gui/window_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>

namespace jnd::app::gui {
namespace {

constexpr Key digit(int value) { return static_cast<Key>('0' + value); }

Key named_key(int key) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return Key::kSpace;
    case GLFW_KEY_ESCAPE:
      return Key::kEscape;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return Key::kEnter;
    case GLFW_KEY_TAB:
      return Key::kTab;
    case GLFW_KEY_BACKSPACE:
      return Key::kBackspace;
    case GLFW_KEY_DELETE:
      return Key::kDelete;
    case GLFW_KEY_LEFT:
      return Key::kLeft;
    case GLFW_KEY_RIGHT:
      return Key::kRight;
    case GLFW_KEY_UP:
      return Key::kUp;
    case GLFW_KEY_DOWN:
      return Key::kDown;
    case GLFW_KEY_PAGE_UP:
      return Key::kPageUp;
    case GLFW_KEY_PAGE_DOWN:
      return Key::kPageDown;
    case GLFW_KEY_HOME:
      return Key::kHome;
    case GLFW_KEY_END:
      return Key::kEnd;
    case GLFW_KEY_KP_ADD:
      return Key::kPlus;
    case GLFW_KEY_KP_SUBTRACT:
      return Key::kMinus;
    case GLFW_KEY_KP_DECIMAL:
      return Key::kPeriod;
    default:
      return Key::kNone;
  }
}

}  // namespace

Key key_of_glfw(int key, int scancode) {
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) {
    return static_cast<Key>(static_cast<int>(Key::kF1) + key - GLFW_KEY_F1);
  }
  // Keys of the row of digits are digits, even where a layout needs Shift for them.
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return digit(key - GLFW_KEY_0);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return digit(key - GLFW_KEY_KP_0);
  if (const Key named = named_key(key); named != Key::kNone) return named;
  if (key < GLFW_KEY_SPACE || key > GLFW_KEY_WORLD_2) return Key::kNone;

  const char* name = glfwGetKeyName(key, scancode);
  const bool is_ascii = name != nullptr && name[0] > ' ' &&
                        static_cast<unsigned char>(name[0]) < 0x7f && name[1] == 0;
  // If a layout has no Latin letters, the letters are where an American keyboard has them.
  const int code = is_ascii ? std::toupper(static_cast<unsigned char>(name[0])) : key;
  if (code >= 0x7f) return Key::kNone;
  // On many keyboards "+" is Shift and "=", and none of our keys is called "=".
  return code == '=' ? Key::kPlus : static_cast<Key>(code);
}

}  // namespace jnd::app::gui
