#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/gui/frame_times.h"
#include "app/gui/input_queue.h"
#include "app/gui/theme.h"
#include "app/gui/widget_log.h"
#include "app/gui/window.h"

struct GLFWcursor;
struct GLFWmonitor;
struct GLFWwindow;
struct ImGuiContext;

namespace jnd::app::gui {

/// GLFW from before the first window to after the last.
class Glfw {
 public:
  Glfw();
  ~Glfw();
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

/// Pixels of the whole screen.
struct ScreenArea {
  int x = 0, y = 0, width = 0, height = 0;

  [[nodiscard]] bool contains(int px, int py) const {
    return px >= x && px < x + width && py >= y && py < y + height;
  }
};

[[nodiscard]] ScreenArea area_of(GLFWmonitor* monitor);
[[nodiscard]] std::vector<GLFWmonitor*> monitors();
/// That the middle of the window is on; nullptr for none.
[[nodiscard]] GLFWmonitor* monitor_of(GLFWwindow* window);
[[nodiscard]] std::string last_glfw_error();

/// For the window's own sources alone.
struct Window::Implementation {
  explicit Implementation(Window& owner) : window(owner) {}
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void open(const WindowSettings& settings);
  /// What the frames get to see, from GLFW's callbacks to the queue. The mouse is the first
  /// window's alone.
  void install_callbacks(GLFWwindow* target, bool with_mouse);
  void on_key(int key, int scancode, int action, int mods);
  void on_mouse_pressed(GLFWwindow* source) const;
  void on_mouse_moved(GLFWwindow* source, double x, double y);
  /// `urgent`: shown at once, not in its turn.
  void something_happened(bool urgent);

  void prepare_fonts();
  /// Once their texture is made.
  static void sharpen_letters();
  void draw(const Frame& frame);
  void draw_second();
  /// The ground, without the cost of drawing it.
  void clear() const;
  void close_second();
  void show_cursor();
  [[nodiscard]] double next_frame_s(double now_s) const;
  void wait(double now_s) const;

  Glfw glfw;
  Window& window;
  GLFWwindow* main = nullptr;
  ImGuiContext* context = nullptr;
  bool has_renderer = false;
  Theme theme;
  float zoom = 1.0f;
  double zoomed_s = -1.0;  ///< When somebody last changed it.
  std::unique_ptr<Ui> ui;
  InputQueue queue;
  WidgetLog widget_log{""};
  FrameTimes frame_times{""};
  GLFWcursor* text_cursor = nullptr;
  GLFWcursor* hand_cursor = nullptr;
  int shown_cursor = 0;

  GLFWwindow* second = nullptr;
  ImGuiContext* second_context = nullptr;
  std::unique_ptr<Ui> second_ui;
  InputQueue no_input;
  Frame second_frame;
  bool second_is_unwanted = false;

  bool is_closed = false;
  bool close_is_wanted = false;
  bool frames_are_wanted = false;
  bool iterations_are_wanted = false;
  std::atomic<bool> is_woken{false};
  int frames_left = 1;
  bool is_urgent = true;
  double last_frame_s = 0.0;
};

}  // namespace jnd::app::gui
