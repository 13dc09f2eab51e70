#include "app/gui/scene_look.h"

#include <gtest/gtest.h>

namespace jnd::app::gui {
namespace scene_look_test {

SceneRequest request(int width_px, int height_px) {
  SceneRequest request{.camera = camera_at_first(), .width_px = width_px};
  request.height_px = height_px;
  request.sample.tick = 5;
  return request;
}

TEST(SceneLook, IsAsLargeAsOnTheScreenAndHasHalfThePixelsWhereTheProcessorDraws) {
  const SceneLook sharp = look_of(request(900, 700), false);
  EXPECT_EQ(sharp.width_px, 900);
  EXPECT_EQ(sharp.height_px, 700);
  const SceneLook coarse = look_of(request(900, 700), true);
  EXPECT_NEAR(coarse.width_px * coarse.height_px, 900 * 700 / 2, 10'000);
}

TEST(SceneLook, KeepsItsShapeWithinTheMostThatIsDrawnAndIsNeverEmpty) {
  const SceneLook wide = look_of(request(6400, 1200), false);
  EXPECT_EQ(wide.width_px, kMostSceneWidth_px);
  EXPECT_EQ(wide.height_px, 300);
  for (const bool is_software : {false, true}) {
    EXPECT_EQ(look_of(request(0, -3), is_software).width_px, 1);
    EXPECT_EQ(look_of(request(0, -3), is_software).height_px, 1);
  }
}

TEST(ScenePace, DrawsAtMostTenPicturesASecond) {
  ScenePace pace;
  SceneLook look;
  int count = 0;
  for (int ms = 0; ms < 2000; ms += 33) {
    ++look.tick;
    count += pace.takes(look, 50.0 + 1e-3 * ms) ? 1 : 0;
  }
  EXPECT_GE(count, 14);
  EXPECT_LE(count, 20);
}

TEST(ScenePace, DrawsNothingAnewThatWouldLookTheSame) {
  ScenePace pace;
  SceneLook look = look_of(request(900, 700), true);
  EXPECT_TRUE(pace.takes(look, 0.0));
  EXPECT_FALSE(pace.takes(look, 1.0));
  look.camera.turn(0.1, 0.0);
  EXPECT_TRUE(pace.takes(look, 2.0)) << "turned";
  look.colours.ground[0] += 0.5f;
  EXPECT_TRUE(pace.takes(look, 2.01)) << "dark now, and at once";
  ++look.width_px;
  EXPECT_TRUE(pace.takes(look, 4.0)) << "larger";
  ++look.tick;
  EXPECT_FALSE(pace.takes(look, 4.05)) << "not yet";
  EXPECT_TRUE(pace.takes(look, 4.1001)) << "moved on";
}

}  // namespace scene_look_test
}  // namespace jnd::app::gui
