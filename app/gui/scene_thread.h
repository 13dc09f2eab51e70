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

/// Draws pictures of the apparatus on a thread of its own. So loading the model, compiling
/// OpenGL's programs and drawing a slow picture never delay a frame of the window, nor its
/// heartbeat.
class SceneThread {
 public:
  /// Draws a picture, or returns the last one if that shows the same. Returns an OpenGL texture
  /// with a complete picture. `now_s` is the time of any clock that goes forward.
  using Paint = std::function<std::uintptr_t(const SceneRequest& request, double now_s)>;

  /// `load` runs once on the thread before anything else; what it returns is called and
  /// destroyed there. The thread calls `wake` when there is a new picture, or when none will
  /// come.
  SceneThread(std::function<Paint()> load, std::function<void()> wake);
  /// Waits for a picture that is being drawn.
  ~SceneThread();
  SceneThread(const SceneThread&) = delete;
  SceneThread& operator=(const SceneThread&) = delete;

  /// Asks for this picture, instead of any that is still waiting, and returns the newest
  /// complete one; 0 while the model is loading. Never waits. Throws `core::Error` if something
  /// went wrong on the thread.
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
