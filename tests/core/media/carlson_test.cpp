#include "core/media/carlson.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>

namespace jnd::core {
namespace carlson_test {

TEST(Carlson, GivesThePublishedValues) {
  // The values are those of Carlson (1995), Numerical computation of real or complex elliptic
  // integrals, section 3.
  EXPECT_NEAR(carlson_rf(2.0, 3.0, 4.0), 0.58408284167715, 1e-14);
  EXPECT_NEAR(carlson_rd(2.0, 3.0, 4.0), 0.16510527294261, 1e-14);
}

TEST(Carlson, OfEqualArgumentsArePowers) {
  for (const double x : {1e-12, 0.3, 1.0, 7.0, 1e12}) {
    EXPECT_NEAR(carlson_rf(x, x, x) * std::sqrt(x), 1.0, 1e-14);
    EXPECT_NEAR(carlson_rd(x, x, x) * x * std::sqrt(x), 1.0, 1e-14);
  }
}

TEST(Carlson, AgreesWithBoostOverManyMagnitudes) {
  const double values[] = {1e-6, 1e-3, 0.02, 1.0, 1.0001, 3.7, 250.0, 1e5};
  for (const double x : values) {
    for (const double y : values) {
      for (const double z : values) {
        const double rf = boost::math::ellint_rf(x, y, z);
        const double rd = boost::math::ellint_rd(x, y, z);
        ASSERT_NEAR(carlson_rf(x, y, z) / rf, 1.0, 1e-13) << x << ' ' << y << ' ' << z;
        ASSERT_NEAR(carlson_rd(x, y, z) / rd, 1.0, 1e-13) << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(Carlson, OutOfRangeIsNoNumberRatherThanAnEndlessLoop) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, infinity, -1.0, 0.0}) {
    EXPECT_TRUE(std::isnan(carlson_rf(1.0, wrong, 1.0))) << wrong;
    EXPECT_TRUE(std::isnan(carlson_rd(1.0, 1.0, wrong))) << wrong;
  }
}

}  // namespace carlson_test
}  // namespace jnd::core
