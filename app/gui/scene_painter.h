#pragma once

#include <cstdint>
#include <memory>

#include "app/gui/scene_look.h"

namespace jnd::app::gui {

/// Draws the apparatus into pictures of its own, which the window then shows like any other:
/// never into the window itself, never more than ten times a second, and with half the pixels
/// where the processor draws. On one thread whose OpenGL context is current from the first to
/// the last moment of it and shares its textures with the window's: see `SceneThread`.
class ScenePainter {
 public:
  /// Throws `core::Error`: no model, or no room for pictures in OpenGL.
  ScenePainter();
  ~ScenePainter();
  ScenePainter(const ScenePainter&) = delete;
  ScenePainter& operator=(const ScenePainter&) = delete;

  /// An OpenGL texture, its first row the lowest one; the last picture's while that is new
  /// enough or nothing has changed. The picture in it is complete and stays for the next two.
  /// `now_s`: any clock that goes forward.
  [[nodiscard]] std::uintptr_t paint(const SceneRequest& request, double now_s);

 private:
  struct Renderer;
  RobotScene scene_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace jnd::app::gui
