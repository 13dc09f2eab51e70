#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/participant_place.h"

namespace jnd::app::gui {

struct WindowSettings {
  std::string title = "jnd";
  float width = 1600;  ///< Logical pixels; less where the monitor has less.
  float height = 1000;
  bool dark = false;
  float zoom = 1.0f;  ///< What the person chose, on top of the monitor's scale.
};

/// An OpenGL context beside the window's, whose textures are the window's too: for one other
/// thread, which makes it current and lets go of it. Made and destroyed on the main thread.
class SharedContext {
 public:
  virtual ~SharedContext() = default;
  virtual void make_current() = 0;
  virtual void let_go() = 0;
};

/// The window on the screen: GLFW, OpenGL and ImGui's renderer, of which nothing else knows. It
/// draws when something happened and sleeps otherwise. One at a time, on the main thread.
///
/// With the environment variable JND_WIDGETS=FILE every frame that shows something new is also
/// written to FILE (`widget_log.h`), for tests that click. With JND_FRAME_TIMES=FILE
/// what each frame cost is appended to FILE (`frame_times.h`); each then waits for OpenGL.
/// With JND_MONITORS=FILE the monitors are those that FILE tells (`told_monitors`), whenever it
/// is looked for them.
class Window {
 public:
  /// Throws `core::Error` beginning with "no display was found", or when there is no OpenGL.
  explicit Window(const WindowSettings& settings = {});
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  using Frame = std::function<void(Ui&)>;

  /// Draws frames until `close`.
  void run(const Frame& frame);
  void close() noexcept;
  /// Once for each time the person wanted to close it; the application asks, and calls `close`.
  [[nodiscard]] bool close_requested() noexcept;
  /// Neither minimised nor hidden, as far as the system says so; Wayland does not.
  [[nodiscard]] bool is_in_sight() const noexcept;

  /// From any thread: there is something new to draw.
  void wake() noexcept;
  /// Frames even without events, at most 30 a second: something moves.
  void wants_frames(bool wanted) noexcept;
  /// `on_iteration` is called at least every 50 ms, drawn or not: the heartbeat.
  void wants_iterations(bool wanted) noexcept;

  /// Escape went down, in any window of ours: called before any frame is drawn. Escape then
  /// goes the way of all keys, too.
  std::function<void()> on_escape;
  /// A key went down or up, in any window of ours: called before any frame is drawn; also when
  /// the window loses the keyboard while it is held.
  std::function<void(Key key, bool is_down)> on_key_changed;
  /// The left button went down: called before any frame is drawn; logical pixels. The press
  /// then goes the way of all others, too.
  std::function<void(float x, float y)> on_mouse_pressed;
  /// Files or folders were dropped on the window from elsewhere.
  std::function<void(const std::vector<std::filesystem::path>& paths)> on_dropped;
  /// Each time the loop comes round, on the main thread.
  std::function<void()> on_iteration;
  /// The mouse moved, as often as the system says so: logical pixels.
  std::function<void(float x, float y)> on_mouse_moved;

  [[nodiscard]] Theme& theme() noexcept;
  [[nodiscard]] float zoom() const noexcept;
  /// Within 0.5 to 2; the letters follow before the next frame.
  void set_zoom(float zoom);

  /// Those that are plugged in: as they were half a second ago or later.
  [[nodiscard]] const std::vector<Monitor>& monitors();
  /// A second window, for the participant: without a frame and filling the monitor of that
  /// name, or, where the name is "", a plain one beside ours, behind it where there is no room.
  /// It never takes the keyboard; what is typed into it counts as typed into the first. What is
  /// drawn into it is drawn whenever the first is, in large letters (`scale_from_afar`). It
  /// moves where it is open already and somewhere else. Throws `core::Error`.
  void open_second(const std::string& title, Frame frame, const std::string& monitor);
  void close_second();
  /// Once for each time that somebody wanted to close it by its own button.
  [[nodiscard]] bool second_close_requested() noexcept;
  [[nodiscard]] bool second_is_open() const noexcept;

  /// Throws `core::Error` where there cannot be one. It has to be gone before the window is.
  [[nodiscard]] std::unique_ptr<SharedContext> make_shared_context();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> my_;
};

}  // namespace jnd::app::gui
