#include "app/gui/scene_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace jnd::app::gui {
namespace scene_camera_test {

TEST(SceneCamera, TurnsAllTheWayRoundAndNeverOverTheTop) {
  SceneCamera camera = camera_at_first();
  const double before_rad = camera.azimuth_rad;
  camera.turn(2.0 * std::numbers::pi, 0.0);
  EXPECT_NEAR(camera.azimuth_rad, before_rad, 1e-12);
  camera.turn(0.0, -10.0);
  EXPECT_GT(camera.elevation_rad, -std::numbers::pi / 2);
  EXPECT_EQ(camera.elevation_rad, camera_from_above().elevation_rad)
      << "as steep as from above";
  camera.turn(0.0, 10.0);
  EXPECT_LT(camera.elevation_rad, std::numbers::pi / 2);
}

TEST(SceneCamera, ZoomsByAFactorWithinItsRange) {
  SceneCamera camera = camera_at_first();
  const double before_m = camera.distance_m;
  camera.zoom(2.0);
  EXPECT_DOUBLE_EQ(camera.distance_m, before_m / 2.0);
  camera.zoom(1e9);
  EXPECT_DOUBLE_EQ(camera.distance_m, 0.25);
  camera.zoom(1e-9);
  EXPECT_DOUBLE_EQ(camera.distance_m, 5.0);
}

TEST(SceneCamera, StaysWhereItIsWhenToldNothingSensible) {
  const SceneCamera before = camera_at_first();
  SceneCamera camera = before;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  camera.turn(kNan, 0.0);
  camera.turn(0.0, std::numeric_limits<double>::infinity());
  camera.zoom(0.0);
  camera.zoom(-1.0);
  camera.zoom(kNan);
  EXPECT_EQ(camera, before);
}

}  // namespace scene_camera_test
}  // namespace jnd::app::gui
