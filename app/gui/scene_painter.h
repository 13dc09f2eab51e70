#pragma once

#include <cstdint>
#include <memory>

#include "app/gui/scene_look.h"

namespace jnd::app::gui {

/// Draws the apparatus into pictures of its own, which the window then shows like any other
/// picture. It never draws into the window itself, draws at most ten pictures a second, and
/// halves their pixels if the processor draws. It lives on one thread, whose OpenGL context is
/// current all the time and shares its textures with the window's context: see `SceneThread`.
class ScenePainter {
 public:
  /// Throws `core::Error` if the model cannot be read, or if OpenGL has no room for the
  /// pictures.
  ScenePainter();
  ~ScenePainter();
  ScenePainter(const ScenePainter&) = delete;
  ScenePainter& operator=(const ScenePainter&) = delete;

  /// Returns an OpenGL texture whose first row is the lowest one. If the last picture is
  /// recent, or nothing has changed, it is that one. The picture is complete, and the next two
  /// pictures leave it as it is. `now_s` is the time of any clock that goes forward.
  [[nodiscard]] std::uintptr_t paint(const SceneRequest& request, double now_s);

 private:
  struct Renderer;
  RobotScene scene_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace jnd::app::gui
