#include "analysis/commissioning/homing_fit.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace jnd::analysis {
namespace homing_fit_test {

TEST(HomingFit, SpreadIsTheLargestDistanceBetweenTwoPlaces) {
  // The second and the third place differ by 3, 4 and 0 mm along the axes, so they are 5 mm
  // apart.
  const HomingFit fit =
      fit_homing({{0.001, 0.001, 0.0}, {0.0, 0.0, 0.0}, {0.003, 0.004, 0.0}}, 0.02);
  EXPECT_NEAR(fit.spread_m, 0.005, 1e-15);
  EXPECT_EQ(fit.moved_m, 0.02);
  EXPECT_EQ(fit.homed_m.size(), 3U);
}

TEST(HomingFit, OneHomingOrAPlaceThatIsNoneIsRefused) {
  EXPECT_THROW((void)fit_homing({{0.0, 0.0, 0.0}}, 0.0), core::Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)fit_homing({{0.0, 0.0, 0.0}, {nan, 0.0, 0.0}}, 0.0), core::Error);
  EXPECT_THROW((void)fit_homing({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, nan), core::Error);
}

}  // namespace homing_fit_test
}  // namespace jnd::analysis
