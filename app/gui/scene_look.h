#pragma once

#include <cstdint>

#include "app/gui/robot_scene.h"

namespace jnd::app::gui {

/// What a picture of the apparatus is to show, and how large it is on the screen.
struct SceneRequest {
  core::Sample sample;
  SurroundingsView surroundings;
  SceneCamera camera;
  SceneColours colours;
  int width_px = 0, height_px = 0;
};

/// What tells one picture from another: the sample by its tick, and the size it is drawn in.
struct SceneLook {
  std::int64_t tick = 0;
  SceneCamera camera;
  SceneColours colours{};
  int width_px = 1, height_px = 1;

  friend bool operator==(const SceneLook&, const SceneLook&) = default;
};

// More than a monitor shows of it beside the scopes; the picture is drawn larger from there on.
inline constexpr int kMostSceneWidth_px = 1600;
inline constexpr int kMostSceneHeight_px = 1200;

/// As large as on the screen, of the same shape, within the most; with half the pixels where
/// the processor draws.
[[nodiscard]] SceneLook look_of(const SceneRequest& request, bool is_software) noexcept;

/// When pictures are drawn: at most ten a second but for a change of colours, and none that
/// would show the same again.
class ScenePace {
 public:
  /// True if this one is to be drawn now; it then counts as drawn.
  [[nodiscard]] bool takes(const SceneLook& wanted, double now_s) noexcept;

 private:
  SceneLook drawn_;
  double drawn_s_ = 0.0;
  bool has_drawn_ = false;
};

}  // namespace jnd::app::gui
