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
  float width = 1600;  ///< In logical pixels; less if the monitor is smaller.
  float height = 1000;
  bool dark = false;
  /// The scale that the person chose; it multiplies the monitor's scale.
  float zoom = 1.0f;
};

/// An OpenGL context that shares its textures with the window's. It is for one other thread,
/// which makes it current and lets it go. The main thread makes and destroys it.
class SharedContext {
 public:
  virtual ~SharedContext() = default;
  virtual void make_current() = 0;
  virtual void let_go() = 0;
};

/// The window on the screen: GLFW, OpenGL and ImGui's renderer, which nothing else knows. It
/// draws when something has happened, and sleeps otherwise. There is one at a time, on the main
/// thread.
///
/// With the environment variable JND_WIDGETS=FILE, every frame that shows something new is also
/// written to FILE (`widget_log.h`), for tests that click. With JND_FRAME_TIMES=FILE, the cost
/// of each frame is appended to FILE (`frame_times.h`), and each frame waits for OpenGL. With
/// JND_MONITORS=FILE, the monitors are those that FILE lists (`told_monitors`), which is read
/// each time.
class Window {
 public:
  /// Throws `core::Error`, beginning with "no display was found" if that is the reason, or if
  /// there is no OpenGL.
  explicit Window(const WindowSettings& settings = {});
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  using Frame = std::function<void(Ui&)>;

  /// Draws frames until `close` is called.
  void run(const Frame& frame);
  void close() noexcept;
  /// Returns true once for each time that the person wanted to close the window. The
  /// application then asks, and calls `close`.
  [[nodiscard]] bool close_requested() noexcept;
  /// Neither minimised nor hidden, as far as the system says so; Wayland does not.
  [[nodiscard]] bool is_in_sight() const noexcept;

  /// There is something new to draw; any thread may call it.
  void wake() noexcept;
  /// If `wanted`, draws frames even without events, at most 30 a second, because something
  /// moves.
  void wants_frames(bool wanted) noexcept;
  /// If `wanted`, calls `on_iteration` at least every 50 ms, with or without a frame, as the
  /// heartbeat needs it.
  void wants_iterations(bool wanted) noexcept;

  /// Called when Escape goes down in any of our windows, before any frame is drawn. Escape then
  /// is also queued like every key.
  std::function<void()> on_escape;
  /// Called when a key goes down or up in any of our windows, before any frame is drawn; also
  /// when the window loses the keyboard while the key is held.
  std::function<void(Key key, bool is_down)> on_key_changed;
  /// Called when the left mouse button goes down, before any frame is drawn; the place is in
  /// logical pixels. The press then is also queued like every other.
  std::function<void(float x, float y)> on_mouse_pressed;
  /// Called when somebody drops files or folders on the window.
  std::function<void(const std::vector<std::filesystem::path>& paths)> on_dropped;
  /// Called on the main thread in each round of the loop.
  std::function<void()> on_iteration;
  /// Called whenever the system says that the mouse has moved; the place is in logical pixels.
  std::function<void(float x, float y)> on_mouse_moved;

  [[nodiscard]] Theme& theme() noexcept;
  [[nodiscard]] float zoom() const noexcept;
  /// Limits the zoom to 0.5 to 2; the letters follow before the next frame.
  void set_zoom(float zoom);

  /// The monitors that are plugged in, as they were at most half a second ago.
  [[nodiscard]] const std::vector<Monitor>& monitors();
  /// Opens a second window, for the participant. It fills the monitor of that name and has no
  /// frame. If the name is "", it is an ordinary window beside ours, or behind ours if there is
  /// no room. It never takes the keyboard; what is typed into it counts as typed into the first
  /// window. It is drawn whenever the first window is, in large letters (`scale_from_afar`). If
  /// it is already open elsewhere, it moves. Throws `core::Error`.
  void open_second(const std::string& title, Frame frame, const std::string& monitor);
  void close_second();
  /// Returns true once for each time that somebody wanted to close the second window by its own
  /// close button.
  [[nodiscard]] bool second_close_requested() noexcept;
  [[nodiscard]] bool second_is_open() const noexcept;

  /// Throws `core::Error` if the context cannot be made. It has to be destroyed before the
  /// window is.
  [[nodiscard]] std::unique_ptr<SharedContext> make_shared_context();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> my_;
};

}  // namespace jnd::app::gui
