#include "core/media/solid_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace jnd::core {
namespace {

TEST(SolidPlane, PushesWithStiffnessTimesDepth) {
  EXPECT_DOUBLE_EQ(SolidPlane::force_n(800.0, 0.0, 0.005, 0.0), 4.0);
  EXPECT_DOUBLE_EQ(SolidPlane::force_n(800.0, 10.0, 0.005, -0.1), 5.0);
}

TEST(SolidPlane, DoesNothingAboveItsSurface) {
  EXPECT_EQ(SolidPlane::force_n(800.0, 10.0, 0.0, -1.0), 0.0);
  EXPECT_EQ(SolidPlane::force_n(800.0, 10.0, -0.1, -1.0), 0.0);
}

TEST(SolidPlane, NeverPullsTheHandBack) {
  for (double depth = -0.01; depth < 0.02; depth += 0.0007) {
    for (double velocity = -2.0; velocity <= 2.0; velocity += 0.1) {
      EXPECT_GE(SolidPlane::force_n(500.0, 40.0, depth, velocity), 0.0);
    }
  }
}

TEST(SolidPlane, TouchingItIsNoForceStep) {
  double last = 0.0;
  for (double depth = 0.0; depth < 0.003; depth += 1e-6) {
    const double force = SolidPlane::force_n(1000.0, 50.0, depth, -0.5);
    EXPECT_LT(std::abs(force - last), 0.03);
    last = force;
  }
}

TEST(SolidPlane, LeavesANumberThatIsNoneForTheLimiterToSee) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(SolidPlane::force_n(nan, 0.0, 0.01, 0.0)));
  EXPECT_TRUE(std::isnan(SolidPlane::force_n(100.0, 1.0, 0.01, nan)));
}

TEST(SolidPlane, NamesTheParameterItRejects) {
  EXPECT_THROW(SolidPlane({.stiffness_n_per_m = -1.0}), Error);
  EXPECT_THROW(SolidPlane({.stiffness_n_per_m = std::numeric_limits<double>::infinity()}),
               Error);
  EXPECT_THROW(SolidPlane({.stiffness_n_per_m = 1.0,
                           .damping_n_s_per_m = std::numeric_limits<double>::quiet_NaN()}),
               Error);
}

}  // namespace
}  // namespace jnd::core
