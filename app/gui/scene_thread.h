#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/gui/scene_look.h"

namespace jnd::app::gui {

/// Draws pictures of the apparatus on a thread of its own. Loading the model, compiling what
/// OpenGL draws with, and a picture that takes long hold up no frame of the window, and so none
/// of its heartbeats.
class SceneThread {
 public:
  /// Draws one, or returns the last one where that shows the same; an OpenGL texture whose
  /// picture is complete. `now_s`: any clock that goes forward.
  using Paint = std::function<std::uintptr_t(const SceneRequest& request, double now_s)>;

  /// `load` runs on the thread, once, before anything else; what it returns is called and
  /// destroyed there. `wake`: there is a new picture, or none will come; from the thread.
  SceneThread(std::function<Paint()> load, std::function<void()> wake);
  /// Waits for a picture that is being drawn.
  ~SceneThread();
  SceneThread(const SceneThread&) = delete;
  SceneThread& operator=(const SceneThread&) = delete;

  /// Asks for this picture, in place of any that was asked for and not begun, and returns the
  /// newest one that is complete; 0 while it still loads. Never waits. Throws `core::Error` for
  /// what went wrong on the thread.
  [[nodiscard]] std::uintptr_t paint(const SceneRequest& request, double now_s);

 private:
  struct Wanted {
    SceneRequest request;
    double now_s = 0.0;
  };
  void run() noexcept;
  void draw_what_is_wanted(const Paint& paint);

  std::function<Paint()> load_;
  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable asked_;
  std::optional<Wanted> wanted_;
  std::uintptr_t newest_ = 0;
  std::string problem_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace jnd::app::gui
