#pragma once

#include <array>

namespace jnd::app::gui {

/// The viewpoint from which the apparatus is seen, in the workspace frame. The camera is
/// `distance_m` in front of `look_at_m` and looks along (cos azimuth cos elevation, sin azimuth
/// cos elevation, sin elevation).
struct SceneCamera {
  double azimuth_rad = 0.0;
  /// Within a right angle of level; a negative value looks down.
  double elevation_rad = 0.0;
  double distance_m = 1.0;  ///< The distance from `look_at_m`, in [0.25, 5].
  std::array<double, 3> look_at_m{};

  friend bool operator==(const SceneCamera&, const SceneCamera&) = default;

  void turn(double azimuth_rad_more, double elevation_rad_more) noexcept;
  /// Brings the camera nearer by this factor; a factor below 1 moves it away.
  void zoom(double factor) noexcept;
};

/// The camera when the view opens: from the participant's right.
[[nodiscard]] SceneCamera camera_at_first() noexcept;
/// From above, with +x to the right and +y up, as the path is drawn.
[[nodiscard]] SceneCamera camera_from_above() noexcept;
/// From where the participant looks, with +x to the right and +z up.
[[nodiscard]] SceneCamera camera_from_front() noexcept;
/// From the participant's right, with +y to the right and +z up.
[[nodiscard]] SceneCamera camera_from_side() noexcept;

}  // namespace jnd::app::gui
