#include "analysis/fits/normal_tail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace jnd::analysis {
namespace normal_tail_test {

TEST(NormalTail, AgreesWithPublishedValuesFarOutInTheTail) {
  // The values are from scipy.stats.norm.logcdf.
  EXPECT_NEAR(log_normal_tails(-1.0).log_lower, -1.8410216450092636, 1e-14);
  EXPECT_NEAR(log_normal_tails(-10.0).log_lower, -53.23128515051247, 1e-12);
  EXPECT_NEAR(log_normal_tails(-37.5).log_lower, -707.6689893175072, 1e-10);
  EXPECT_NEAR(log_normal_tails(-100.0).log_lower, -5005.524208694205, 1e-9);
  EXPECT_NEAR(log_normal_tails(6.0).log_lower, -9.865876455243719e-10, 1e-22);
}

TEST(NormalTail, TheTwoFormulasForTheTailMeetWhereTheyChange) {
  const LogNormalTails near = log_normal_tails(-36.0 + 1e-9);
  const LogNormalTails far = log_normal_tails(-36.0 - 1e-9);
  EXPECT_NEAR(near.log_lower - far.log_lower, 2e-9 * near.mills_lower, 1e-10);
  EXPECT_NEAR(near.mills_lower / far.mills_lower, 1.0, 1e-10);
}

TEST(NormalTail, MillsRatioIsTheDerivativeOfTheLogarithm) {
  for (const double z : {-50.0, -12.0, -3.0, -0.4, 0.0, 0.7, 5.0}) {
    const double step = 1e-6;
    const double numeric =
        (log_normal_tails(z + step).log_lower - log_normal_tails(z - step).log_lower) /
        (2.0 * step);
    EXPECT_NEAR(log_normal_tails(z).mills_lower, numeric, 1e-7 * (1.0 + std::fabs(z))) << z;
  }
}

TEST(NormalTail, TheTailsMirrorEachOther) {
  for (const double z : {0.0, 0.3, 2.0, 9.0, 45.0}) {
    const LogNormalTails right = log_normal_tails(z), left = log_normal_tails(-z);
    EXPECT_DOUBLE_EQ(right.log_lower, left.log_upper) << z;
    EXPECT_DOUBLE_EQ(right.mills_upper, left.mills_lower) << z;
    EXPECT_DOUBLE_EQ(normal_tails(z).lower, normal_tails(-z).upper) << z;
    EXPECT_NEAR(normal_tails(z).lower + normal_tails(z).upper, 1.0, 1e-15) << z;
  }
}

/// Compares with long double, whose own functions are right to 1e-18.
TEST(NormalTail, IsRightToThirteenDigitsAtAndBetweenTheKnotsOfItsTable) {
  // The knots are 1 / 64 apart. The first step meets all knots, and no multiple of the second
  // one is a knot.
  for (const double step : {1.0 / 64.0, 0.00719}) {
    for (double z = -12.0; z <= 12.0; z += step) {
      const long double x = z;
      const long double lower = 0.5L * std::erfc(-x / std::sqrt(2.0L));
      const long double upper = 0.5L * std::erfc(x / std::sqrt(2.0L));
      const long double density =
          std::exp(-0.5L * x * x) / std::sqrt(2.0L * std::numbers::pi_v<long double>);
      const auto near = [&](double found, long double expected) {
        return std::fabs(found - static_cast<double>(expected)) <=
               1e-13 * std::fabs(static_cast<double>(expected));
      };
      const LogNormalTails logs = log_normal_tails(z);
      const NormalTails tails = normal_tails(z);
      const MillsRatios mills = mills_ratios(z);
      ASSERT_TRUE(near(tails.lower, lower) && near(tails.upper, upper)) << z;
      ASSERT_TRUE(near(tails.density, density)) << z;
      ASSERT_TRUE(near(logs.lower, lower) && near(logs.upper, upper)) << z;
      ASSERT_TRUE(near(logs.log_lower, z < 0.0 ? std::log(lower) : std::log1p(-upper))) << z;
      ASSERT_TRUE(near(logs.log_upper, z > 0.0 ? std::log(upper) : std::log1p(-lower))) << z;
      ASSERT_TRUE(near(logs.mills_lower, density / lower)) << z;
      ASSERT_TRUE(near(logs.mills_upper, density / upper)) << z;
      ASSERT_EQ(mills.lower, logs.mills_lower) << z;
      ASSERT_EQ(mills.upper, logs.mills_upper) << z;
    }
  }
}

TEST(NormalTail, OfNoNumberIsNone) {
  EXPECT_TRUE(std::isnan(log_normal_tails(NAN).log_lower));
  EXPECT_TRUE(std::isnan(normal_tails(NAN).upper));
  EXPECT_TRUE(std::isnan(mills_ratios(NAN).lower));
}

}  // namespace normal_tail_test
}  // namespace jnd::analysis
