#include "core/psychometric_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace jnd::core {
namespace psychometric_function_test {

TEST(PsychometricFunction, IsAt84Point13PercentOneWeberFractionAboveItsCentre) {
  // Bergmann Tiest et al. (2013) define w by f(p (1 + w)) = Phi(1).
  for (const double pse : {1.853, 16.06}) {
    for (const double w : {0.2445, 0.2928, 0.6974}) {
      const PsychometricFunction f{.pse = pse, .weber_fraction = w};
      EXPECT_NEAR(f.probability(pse * (1.0 + w)), 0.8413447460685429, 1e-14);
      EXPECT_NEAR(f.probability(pse), 0.5, 1e-15);
      EXPECT_NEAR(f.probability(pse / (1.0 + w)), 1.0 - 0.8413447460685429, 1e-14);
    }
  }
}

TEST(PsychometricFunction, IsTheThesissErrorFunction) {
  const PsychometricFunction f{.pse = 1.853, .weber_fraction = 0.6974};
  for (const double x : {1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883}) {
    const double expected =
        0.5 + 0.5 * std::erf(std::log(x / 1.853) / (std::numbers::sqrt2 * std::log(1.6974)));
    EXPECT_NEAR(f.probability(x), expected, 1e-14);
  }
}

TEST(PsychometricFunction, LapsesTakeFromBothEnds) {
  const PsychometricFunction f{.pse = 2.0, .weber_fraction = 0.3, .lapse_rate = 0.02};
  EXPECT_NEAR(f.probability(0.0), 0.02, 1e-15);
  EXPECT_NEAR(f.probability(2.0), 0.5, 1e-15);
  EXPECT_NEAR(f.probability(1e9), 0.98, 1e-15);
}

TEST(PsychometricFunction, RisesAndItsInverseLeadsBack) {
  const PsychometricFunction f{.pse = 2.0, .weber_fraction = 0.3, .lapse_rate = 0.03};
  double last = 0.0;
  for (double x = 0.5; x < 8.0; x += 0.1) {
    const double p = f.probability(x);
    EXPECT_GT(p, last);
    EXPECT_NEAR(f.intensity_at(p), x, 1e-6 * x);
    last = p;
  }
}

TEST(PsychometricFunction, HasNoIntensityBeyondItsLapses) {
  const PsychometricFunction f{.lapse_rate = 0.05};
  EXPECT_TRUE(std::isnan(f.intensity_at(0.04)));
  EXPECT_TRUE(std::isnan(f.intensity_at(0.96)));
  EXPECT_TRUE(std::isnan(f.intensity_at(std::nan(""))));
}

TEST(StandardNormal, TheQuantileInvertsTheDistributionInBothTails) {
  EXPECT_NEAR(standard_normal_quantile(0.975), 1.959963984540054, 1e-12);
  EXPECT_NEAR(standard_normal_quantile(1e-10), -6.361340902404056, 1e-9);
  for (double z = -8.0; z <= 5.0; z += 0.25) {
    EXPECT_NEAR(standard_normal_quantile(standard_normal_cdf(z)), z, 1e-9) << z;
  }
  EXPECT_EQ(standard_normal_quantile(0.0), -INFINITY);
  EXPECT_EQ(standard_normal_quantile(1.0), INFINITY);
  EXPECT_TRUE(std::isnan(standard_normal_quantile(-0.1)));
  EXPECT_TRUE(std::isnan(standard_normal_quantile(1.1)));
}

}  // namespace psychometric_function_test
}  // namespace jnd::core
