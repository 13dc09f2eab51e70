#include "device/exoskeleton/velocity_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace jnd::device {
namespace velocity_filter_test {

TEST(VelocityFilter, StartsAtRestWhereverTheJointsAre) {
  VelocityFilter filter(40.0, 0.001);
  filter.start(JointVector::Constant(2.0));
  EXPECT_EQ(filter.velocity_rad_per_s().norm(), 0.0);
  EXPECT_EQ(filter.update(JointVector::Constant(2.0)).norm(), 0.0);
}

TEST(VelocityFilter, ReachesASteadyVelocityAtItsTimeConstant) {
  constexpr double kPeriod_s = 0.0001;
  VelocityFilter filter(40.0, kPeriod_s);
  filter.start(JointVector::Zero());
  double time_s = 0.0;
  // The time constant is 1 / (2 pi 40 Hz) = 3.979 ms. After it, the filter has gone 1 - 1/e of
  // the way.
  while (time_s < 0.0039788) {
    time_s += kPeriod_s;
    filter.update(JointVector::Constant(3.0 * time_s));
  }
  EXPECT_NEAR(filter.velocity_rad_per_s()[7], 3.0 * (1.0 - std::exp(-time_s / 0.0039789)),
              1e-4);
  for (int tick = 0; tick < 1000; ++tick) {
    time_s += kPeriod_s;
    filter.update(JointVector::Constant(3.0 * time_s));
  }
  EXPECT_NEAR(filter.velocity_rad_per_s()[21], 3.0, 1e-9);
}

TEST(VelocityFilter, OneReadingThatIsNoNumberIsToldAndThenForgotten) {
  VelocityFilter filter(40.0, 0.001);
  JointVector position_rad = JointVector::Constant(0.3);
  filter.start(position_rad);
  for (const double broken : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    JointVector wrong_rad = position_rad;
    wrong_rad[5] = broken;
    EXPECT_FALSE(filter.update(wrong_rad).allFinite());
    for (int tick = 0; tick < 200; ++tick) {
      position_rad.array() += 0.001;
      EXPECT_TRUE(filter.update(position_rad).allFinite());
    }
    EXPECT_NEAR(filter.velocity_rad_per_s()[5], 1.0, 1e-6);
    EXPECT_NEAR(filter.velocity_rad_per_s()[4], 1.0, 1e-6);
  }
}

TEST(VelocityFilter, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(VelocityFilter(nan, 0.001), core::Error);
  EXPECT_THROW(VelocityFilter(40.0, 0.0), core::Error);
}

}  // namespace velocity_filter_test
}  // namespace jnd::device
