#include "core/power_function.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jnd::core {
namespace power_function_test {

TEST(PowerFunction, GivesThePublishedMagnitudeOfWater) {
  // Thesis, fig. 8: S = 0.6663 I^0.6386, worked by hand at I = 4.
  const PowerFunction estimation{.k = 0.6663, .a = 0.6386};
  EXPECT_NEAR(estimation.magnitude(1.0), 0.6663, 1e-15);
  EXPECT_NEAR(estimation.magnitude(4.0), 0.6663 * std::exp(0.6386 * std::log(4.0)), 1e-12);
}

TEST(PowerFunction, NothingFeelsLikeNothing) {
  EXPECT_EQ((PowerFunction{.k = 2.0, .a = 0.5}.magnitude(0.0)), 0.0);
  EXPECT_EQ((PowerFunction{.k = 2.0, .a = 0.0}.magnitude(0.0)), 0.0);
  EXPECT_EQ((PowerFunction{.k = 2.0, .a = 0.5}.intensity_at(0.0)), 0.0);
}

TEST(PowerFunction, ItsInverseLeadsBack) {
  const PowerFunction production{.k = 0.3761, .a = 1.206};
  for (double intensity = 0.1; intensity < 8.0; intensity += 0.3) {
    EXPECT_NEAR(production.intensity_at(production.magnitude(intensity)), intensity, 1e-12);
  }
}

}  // namespace power_function_test
}  // namespace jnd::core
