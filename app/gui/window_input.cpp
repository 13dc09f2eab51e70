#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "app/gui/window_keys.h"
#include "app/gui/window_state.h"

namespace jnd::app::gui {
namespace {

constexpr float kOutside = -1e6f;

/// How many pixels of a frame there are for each of the system's units, mostly 1.
double pixels_per_unit(GLFWwindow* window) {
  int width = 0;
  int pixels = 0;
  glfwGetWindowSize(window, &width, nullptr);
  glfwGetFramebufferSize(window, &pixels, nullptr);
  return width > 0 ? static_cast<double>(pixels) / width : 1.0;
}

}  // namespace

void Window::Implementation::on_key(int key, int scancode, int action, int mods) {
  // This comes first, whatever else the key means, and waits for no frame.
  if (key == GLFW_KEY_ESCAPE && action == GLFW_PRESS && window.on_escape) window.on_escape();
  if (action != GLFW_REPEAT && window.on_key_changed) {
    window.on_key_changed(key_of_glfw(key, scancode), action == GLFW_PRESS);
  }
  something_happened(true);
  // With Alt or the system's own key, the key is meant for other programs.
  if (action != GLFW_RELEASE && (mods & (GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0) return;
  queue.key({.chord = {.key = key_of_glfw(key, scancode),
                       .control = (mods & GLFW_MOD_CONTROL) != 0,
                       .shift = (mods & GLFW_MOD_SHIFT) != 0},
             .action = action == GLFW_PRESS     ? KeyEvent::Action::kPress
                       : action == GLFW_RELEASE ? KeyEvent::Action::kRelease
                                                : KeyEvent::Action::kRepeat});
}

void Window::Implementation::on_mouse_pressed(GLFWwindow* source) const {
  double x = 0.0;
  double y = 0.0;
  glfwGetCursorPos(source, &x, &y);
  const auto ratio = static_cast<float>(pixels_per_unit(source)) / theme.scale();
  if (window.on_mouse_pressed) {
    window.on_mouse_pressed(static_cast<float>(x) * ratio, static_cast<float>(y) * ratio);
  }
}

void Window::Implementation::on_mouse_moved(GLFWwindow* source, double x, double y) {
  const double ratio = pixels_per_unit(source);
  const auto px = static_cast<float>(x * ratio);
  const auto py = static_cast<float>(y * ratio);
  queue.mouse_moved(px, py);
  something_happened(false);
  if (window.on_mouse_moved) window.on_mouse_moved(px / theme.scale(), py / theme.scale());
}

void Window::Implementation::install_callbacks(GLFWwindow* target, bool with_mouse) {
  // GLFW can call a lambda without captures only; it finds this object by the user pointer.
  using Self = Implementation;
  glfwSetWindowUserPointer(target, this);
  static constexpr auto self = [](GLFWwindow* from) -> Self& {
    return *static_cast<Self*>(glfwGetWindowUserPointer(from));
  };
  glfwSetKeyCallback(target, [](GLFWwindow* from, int key, int scancode, int action, int mods) {
    self(from).on_key(key, scancode, action, mods);
  });
  glfwSetCharCallback(target, [](GLFWwindow* from, unsigned code_point) {
    self(from).queue.character(code_point);
    self(from).something_happened(true);
  });
  glfwSetWindowFocusCallback(target, [](GLFWwindow* from, int is_focused) {
    Self& my = self(from);
    if (is_focused == GLFW_FALSE) my.queue.release_all();
    my.something_happened(false);
    // A window manager may give the keyboard to a new window, or to one that was clicked. It
    // goes back to the experimenter, who would otherwise type without seeing it.
    const bool is_taken =
        from == my.second && is_focused == GLFW_TRUE && !my.second_monitor.empty();
    if (is_taken && glfwGetWindowAttrib(my.main, GLFW_ICONIFIED) == GLFW_FALSE) {
      glfwFocusWindow(my.main);
    }
  });
  glfwSetWindowRefreshCallback(target,
                               [](GLFWwindow* from) { self(from).something_happened(true); });
  glfwSetFramebufferSizeCallback(
      target, [](GLFWwindow* from, int, int) { self(from).something_happened(false); });
  glfwSetWindowContentScaleCallback(
      target, [](GLFWwindow* from, float, float) { self(from).something_happened(false); });
  glfwSetWindowCloseCallback(target, [](GLFWwindow* from) {
    glfwSetWindowShouldClose(from, GLFW_FALSE);
    Self& my = self(from);
    (from == my.main ? my.close_is_wanted : my.second_close_is_wanted) = true;
    my.something_happened(true);
  });
  if (!with_mouse) return;
  glfwSetCursorPosCallback(target, [](GLFWwindow* from, double x, double y) {
    self(from).on_mouse_moved(from, x, y);
  });
  glfwSetCursorEnterCallback(target, [](GLFWwindow* from, int has_entered) {
    if (has_entered == GLFW_FALSE) {
      self(from).queue.mouse_moved(kOutside, kOutside);
    } else {
      // GLFW does not report a mouse that returns to its former place.
      double x = 0.0;
      double y = 0.0;
      glfwGetCursorPos(from, &x, &y);
      self(from).on_mouse_moved(from, x, y);
    }
    self(from).something_happened(false);
  });
  glfwSetMouseButtonCallback(target, [](GLFWwindow* from, int button, int action, int) {
    if (button != GLFW_MOUSE_BUTTON_LEFT) return;
    if (action == GLFW_PRESS) self(from).on_mouse_pressed(from);
    self(from).queue.mouse_button(action == GLFW_PRESS);
    self(from).something_happened(true);
  });
  glfwSetDropCallback(target, [](GLFWwindow* from, int count, const char** paths) {
    const Self& my = self(from);
    if (my.window.on_dropped) my.window.on_dropped({paths, paths + count});
    self(from).something_happened(true);
  });
  glfwSetScrollCallback(target, [](GLFWwindow* from, double, double steps) {
    self(from).queue.wheel(static_cast<float>(steps));
    self(from).something_happened(false);
  });
}

}  // namespace jnd::app::gui
