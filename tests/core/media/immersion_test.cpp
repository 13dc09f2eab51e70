#include "core/media/immersion.h"

#include <gtest/gtest.h>

#include <limits>

namespace jnd::core {
namespace immersion_test {

TEST(Immersion, TheInfiniteSurfaceAsksForTheHeightAlone) {
  const Immersion immersion;
  EXPECT_TRUE(immersion.contains({1000.0, -1000.0, -0.001}));
  EXPECT_TRUE(immersion.contains({0.0, 0.0, -1000.0}));
  EXPECT_FALSE(immersion.contains({0.0, 0.0, 0.0}));
  EXPECT_FALSE(immersion.contains({0.0, 0.0, 0.001}));
}

TEST(Immersion, ACylinderIsRoundAndHasABottom) {
  const Immersion immersion{.radius_m = 0.1, .depth_m = 0.2};
  EXPECT_TRUE(immersion.contains({0.07, 0.07, -0.1}));
  // This point is inside the square that the thesis tests, and outside the cylinder that it
  // describes.
  EXPECT_FALSE(immersion.contains({0.08, 0.08, -0.1}));
  EXPECT_TRUE(immersion.contains({0.0, 0.0, -0.199}));
  EXPECT_FALSE(immersion.contains({0.0, 0.0, -0.2}));
}

TEST(Immersion, MovesWithItsOrigin) {
  const Immersion immersion{
      .radius_m = 0.1, .depth_m = 0.2, .origin_x_m = 1.0, .origin_y_m = 2.0, .origin_z_m = 0.5};
  EXPECT_TRUE(immersion.contains({1.05, 2.0, 0.4}));
  EXPECT_FALSE(immersion.contains({0.05, 0.0, -0.1}));
}

TEST(Immersion, ACoordinateThatIsNoNumberIsOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Immersion{}.contains({nan, 0.0, -0.1}));
  EXPECT_FALSE(Immersion{}.contains({0.0, nan, -0.1}));
  EXPECT_FALSE(Immersion{}.contains({0.0, 0.0, nan}));
}

}  // namespace immersion_test
}  // namespace jnd::core
