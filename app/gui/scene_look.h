#pragma once

#include <cstdint>

#include "app/gui/robot_scene.h"

namespace jnd::app::gui {

/// What a picture of the apparatus has to show, and how large it is on the screen.
struct SceneRequest {
  core::Sample sample;
  SurroundingsView surroundings;
  SceneCamera camera;
  SceneColours colours;
  int width_px = 0, height_px = 0;
};

/// What distinguishes one picture from another; the tick stands for the whole sample. The size
/// is the one in which the picture is drawn.
struct SceneLook {
  std::int64_t tick = 0;
  SceneCamera camera;
  SceneColours colours{};
  int width_px = 1, height_px = 1;

  friend bool operator==(const SceneLook&, const SceneLook&) = default;
};

// Monitors hardly show a larger picture beside the scopes. A larger view scales this one up.
inline constexpr int kMostSceneWidth_px = 1600;
inline constexpr int kMostSceneHeight_px = 1200;

/// The picture's size is the size on the screen, reduced in proportion to the most that is
/// allowed. If the processor draws, the picture has at most half the pixels.
[[nodiscard]] SceneLook look_of(const SceneRequest& request, bool is_software) noexcept;

/// Decides when pictures are drawn: at most ten a second, except when colours change, and never
/// one that would look like the last.
class ScenePace {
 public:
  /// Returns true if this picture is to be drawn now; it then counts as drawn.
  [[nodiscard]] bool takes(const SceneLook& wanted, double now_s) noexcept;

 private:
  SceneLook drawn_;
  double drawn_s_ = 0.0;
  bool has_drawn_ = false;
};

}  // namespace jnd::app::gui
