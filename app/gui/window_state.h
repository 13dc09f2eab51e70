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

/// Without panels.
[[nodiscard]] ScreenArea area_of(GLFWmonitor* monitor);
[[nodiscard]] std::string last_glfw_error();
/// "" where it is not set.
[[nodiscard]] std::string environment(const char* name);

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
  /// Letters for its size; true where there is something to draw into.
  [[nodiscard]] bool prepare_second();
  void load_second_fonts(float scale);
  void make_second(const std::string& title, const std::string& monitor);
  /// Follows a monitor whose size or place has changed.
  void keep_second_on_monitor();
  /// Where a window has most room beside ours; empty where there is none.
  [[nodiscard]] ScreenArea area_beside() const;
  void look_at_monitors();
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
  std::string second_monitor;   ///< That it fills; "" where it stands beside.
  Theme second_theme;           ///< Its letters grow with it.
  unsigned second_letters = 0;  ///< OpenGL's texture of them.
  double second_resized_s = -1.0;
  int second_width_px = 0, second_height_px = 0;
  std::unique_ptr<Ui> second_ui;
  InputQueue no_input;
  Frame second_frame;
  bool second_is_unwanted = false;
  bool second_close_is_wanted = false;  ///< By its own close button.

  std::string told_monitors_file;
  std::vector<Monitor> monitors;
  double looked_at_monitors_s = -1.0;

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
