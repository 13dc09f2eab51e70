#include "core/media/water_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace jnd::core {
namespace water_drag_test {

TEST(WaterDrag, HeadOnAtOneMetrePerSecondIsTheForceOfTheThesis) {
  // Thesis, sec. 4.1: 6.585 N, which is 7.4 * 0.8899 worked by hand.
  EXPECT_NEAR(WaterDrag({}).drag_n(1.0, 1.0), 6.58526, 1e-12);
}

TEST(WaterDrag, EdgeOnItIsTheSmallestForce) {
  // The force is 7.4 * (0.5794 - 0.3105).
  EXPECT_NEAR(WaterDrag({}).drag_n(1.0, 0.0), 1.98986, 1e-12);
}

TEST(WaterDrag, TheCoefficientIsTheCosineOfTwiceTheAngle) {
  for (double angle = 0.0; angle <= std::numbers::pi; angle += 0.01) {
    // Thesis, eq. B.4, and eq. B.5 with the correct sign.
    const double expected = 0.5794 - 0.3105 * std::cos(2.0 * angle);
    const double sine = std::sin(angle);
    EXPECT_NEAR(WaterDrag::drag_coefficient(sine), expected, 1e-15);
    EXPECT_NEAR(WaterDrag({}).drag_n(1.0, sine), 2.2977 * (1.8660 - std::cos(2.0 * angle)),
                1e-3);
  }
}

TEST(WaterDrag, GrowsWithTheSquareOfTheSpeedAndWithTheScale) {
  const WaterDrag water({.scale = 1.0});
  const WaterDrag thick({.scale = 4.0});
  EXPECT_NEAR(water.drag_n(0.5, 0.3), 0.25 * water.drag_n(1.0, 0.3), 1e-15);
  EXPECT_NEAR(thick.drag_n(0.5, 0.3), water.drag_n(1.0, 0.3), 1e-15);
  EXPECT_EQ(water.drag_n(0.0, 1.0), 0.0);
}

TEST(WaterDrag, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {-1.0, nan, infinity}) {
    EXPECT_THROW(WaterDrag({.scale = wrong}), Error) << wrong;
    EXPECT_THROW(WaterDrag({.density_kg_per_m3 = wrong}), Error) << wrong;
    EXPECT_THROW(WaterDrag({.projected_area_m2 = wrong}), Error) << wrong;
  }
  try {
    const WaterDrag drag({.scale = -0.5});
    FAIL() << "a negative scale was accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "scale: expected a finite number >= 0, found -0.5");
  }
}

}  // namespace water_drag_test
}  // namespace jnd::core
