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

/// Keeps GLFW running from before the first window until after the last.
class Glfw {
 public:
  Glfw();
  ~Glfw();
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

/// A rectangle in pixels of the whole screen.
struct ScreenArea {
  int x = 0, y = 0, width = 0, height = 0;

  [[nodiscard]] bool contains(int px, int py) const {
    return px >= x && px < x + width && py >= y && py < y + height;
  }
};

/// The monitor's area without panels.
[[nodiscard]] ScreenArea area_of(GLFWmonitor* monitor);
[[nodiscard]] std::string last_glfw_error();
/// The variable's value; "" if it is not set.
[[nodiscard]] std::string environment(const char* name);

/// What `Window` is made of. Only the window's own sources use it.
struct Window::Implementation {
  explicit Implementation(Window& owner) : window(owner) {}
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void open(const WindowSettings& settings);
  /// Installs GLFW's callbacks, which put the frames' input into the queue. The mouse counts in
  /// the first window only.
  void install_callbacks(GLFWwindow* target, bool with_mouse);
  void on_key(int key, int scancode, int action, int mods);
  void on_mouse_pressed(GLFWwindow* source) const;
  void on_mouse_moved(GLFWwindow* source, double x, double y);
  /// Requests frames. If `urgent`, the next one is drawn at once, not in its turn.
  void something_happened(bool urgent);

  void prepare_fonts();
  /// Called after the letters' texture was made.
  static void sharpen_letters();
  void draw(const Frame& frame);
  void draw_second();
  /// Makes letters for the second window's size. Returns true if that window can be drawn.
  [[nodiscard]] bool prepare_second();
  void load_second_fonts(float scale);
  void make_second(const std::string& title, const std::string& monitor_name);
  /// Follows a monitor whose size or place has changed.
  void keep_second_on_monitor();
  /// The area with most room beside our window; empty if there is none.
  [[nodiscard]] ScreenArea area_beside() const;
  void look_at_monitors();
  /// Clears the window to the ground's colour, which is cheaper than drawing it.
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
  double zoomed_s = -1.0;  ///< When somebody last changed the zoom.
  std::unique_ptr<Ui> ui;
  InputQueue queue;
  WidgetLog widget_log{""};
  FrameTimes frame_times{""};
  GLFWcursor* text_cursor = nullptr;
  GLFWcursor* hand_cursor = nullptr;
  int shown_cursor = 0;

  GLFWwindow* second = nullptr;
  ImGuiContext* second_context = nullptr;
  /// The monitor that the second window fills; "" if it is beside ours.
  std::string second_monitor;
  Theme second_theme;           ///< Its letters grow with the second window.
  unsigned second_letters = 0;  ///< OpenGL's texture of the second window's letters.
  double second_resized_s = -1.0;
  int second_width_px = 0, second_height_px = 0;
  std::unique_ptr<Ui> second_ui;
  InputQueue no_input;
  Frame second_frame;
  bool second_is_unwanted = false;
  bool second_close_is_wanted = false;  ///< Somebody pressed the second window's close button.

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
