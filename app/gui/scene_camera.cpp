#include "app/gui/scene_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jnd::app::gui {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
// A camera that looks straight down has no direction for "up".
constexpr double kSteepest_rad = 89.0 * kDegree_rad;
constexpr double kNearest_m = 0.25;
constexpr double kFurthest_m = 5.0;
// The camera looks at the middle of the strokes, a little towards the arm.
constexpr std::array<double, 3> kLookAt_m = {0.0, 0.03, -0.06};

SceneCamera looking(double azimuth_rad, double elevation_rad, double distance_m) {
  return {.azimuth_rad = azimuth_rad,
          .elevation_rad = elevation_rad,
          .distance_m = distance_m,
          .look_at_m = kLookAt_m};
}

}  // namespace

void SceneCamera::turn(double azimuth_rad_more, double elevation_rad_more) noexcept {
  if (!std::isfinite(azimuth_rad_more + elevation_rad_more)) return;
  azimuth_rad = std::remainder(azimuth_rad + azimuth_rad_more, 2.0 * std::numbers::pi);
  elevation_rad = std::clamp(elevation_rad + elevation_rad_more, -kSteepest_rad, kSteepest_rad);
}

void SceneCamera::zoom(double factor) noexcept {
  if (!(factor > 0.0) || !std::isfinite(factor)) return;
  distance_m = std::clamp(distance_m / factor, kNearest_m, kFurthest_m);
}

SceneCamera camera_at_first() noexcept {
  return looking(112.0 * kDegree_rad, -24.0 * kDegree_rad, 1.05);
}

SceneCamera camera_from_above() noexcept {
  return looking(90.0 * kDegree_rad, -kSteepest_rad, 1.3);
}

SceneCamera camera_from_front() noexcept {
  return looking(90.0 * kDegree_rad, -4.0 * kDegree_rad, 1.3);
}

SceneCamera camera_from_side() noexcept {
  return looking(180.0 * kDegree_rad, -4.0 * kDegree_rad, 1.3);
}

}  // namespace jnd::app::gui
