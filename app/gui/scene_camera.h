#pragma once

#include <array>

namespace jnd::app::gui {

/// From where the apparatus is seen, workspace frame: from `distance_m` in front of
/// `look_at_m`, looking along (cos azimuth cos elevation, sin azimuth cos elevation,
/// sin elevation).
struct SceneCamera {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;  ///< Negative looks down; less than a right angle either way.
  double distance_m = 1.0;     ///< [0.25, 5]
  std::array<double, 3> look_at_m{};

  friend bool operator==(const SceneCamera&, const SceneCamera&) = default;

  void turn(double azimuth_rad_more, double elevation_rad_more) noexcept;
  /// Nearer by this factor, or further where it is below 1.
  void zoom(double factor) noexcept;
};

/// Where the person looks from who opens the view: from the participant's right.
[[nodiscard]] SceneCamera camera_at_first() noexcept;
/// +x to the right, +y up: as the path is drawn.
[[nodiscard]] SceneCamera camera_from_above() noexcept;
/// As the participant sees it: +x to the right, +z up.
[[nodiscard]] SceneCamera camera_from_front() noexcept;
/// From the participant's right: +y to the right, +z up.
[[nodiscard]] SceneCamera camera_from_side() noexcept;

}  // namespace jnd::app::gui
