#include "analysis/statistics/distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/statistics/root_finding.h"

namespace distributions_test {

using namespace jnd::analysis;

// The values are worked by hand where a closed form exists, and otherwise from printed tables
// (Abramowitz and Stegun 1964, tables 26.1, 26.8 and 26.9).
TEST(Distributions, NormalQuantilesAreThoseOfTheTable) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile_above(0.025), 1.959963984540054, 1e-14);
  // The probability is so small that 1 minus it is 1.
  EXPECT_NEAR(normal_quantile_above(1e-20), 9.262340089798408, 1e-12);
}

TEST(Distributions, StudentsTWithOneAndTwoDegreesOfFreedomHasAClosedForm) {
  // With one degree of freedom it is Cauchy's distribution, and with two 1/2 - t / (2 sqrt(2 +
  // t^2)).
  EXPECT_NEAR(student_t_above(2.0, 1.0), 0.5 - std::atan(2.0) / std::numbers::pi, 1e-15);
  EXPECT_NEAR(student_t_above(1.5, 2.0), 0.5 - 1.5 / (2.0 * std::sqrt(4.25)), 1e-15);
  EXPECT_NEAR(student_t_quantile(0.975, 1.0), std::tan(0.475 * std::numbers::pi), 1e-11);
  EXPECT_NEAR(student_t_quantile_above(0.025, 12.0), 2.178812829667229, 1e-12);
}

TEST(Distributions, TheNoncentralTIsTheCentralOneWithoutNoncentrality) {
  EXPECT_NEAR(noncentral_t_above(1.5, 2.0, 0.0), student_t_above(1.5, 2.0), 1e-14);
  // At t = 0 it is the normal distribution's tail, P(Z + delta <= 0).
  EXPECT_NEAR(noncentral_t_below(0.0, 7.0, 1.3), 0.5 * std::erfc(1.3 / std::sqrt(2.0)), 1e-14);
  EXPECT_NEAR(noncentral_t_below(1.0, 7.0, 1.3) + noncentral_t_above(1.0, 7.0, 1.3), 1.0,
              1e-12);
}

TEST(Distributions, ChiSquaredAndGammaOfTwoDegreesOfFreedomAreExponential) {
  EXPECT_NEAR(chi_squared_above(3.0, 2.0), std::exp(-1.5), 1e-15);
  EXPECT_NEAR(chi_squared_quantile(0.95, 2.0), -2.0 * std::log(0.05), 1e-13);
  EXPECT_NEAR(gamma_above(3.0, 1.0, 2.0), std::exp(-1.5), 1e-15);
}

TEST(Distributions, TheQuantileOfFWithOneDegreeAboveIsThatOfTSquared) {
  const double t = student_t_quantile(0.975, 9.0);
  EXPECT_NEAR(fisher_f_quantile(0.95, 1.0, 9.0), t * t, 1e-11);
}

TEST(Distributions, AtLeastNineOfTenFairTrialsIsElevenIn1024) {
  EXPECT_NEAR(fair_trials_at_least(9.0, 10.0), 11.0 / 1024.0, 1e-15);
}

TEST(Distributions, TheGammaFunctionIsTheFactorial) {
  EXPECT_NEAR(log_gamma(6.0), std::log(120.0), 1e-14);
  EXPECT_NEAR(digamma(1.0), -0.5772156649015329, 1e-15);
}

TEST(RootFinding, TheBracketHoldsTheRootAndIsAsNarrowAsAskedFor) {
  const auto cube = [](double x) { return x * x * x - 2.0; };
  const auto [low, high] = root_bracket(
      cube, {0.0, cube(0.0)}, {3.0, cube(3.0)},
      [](double a, double b) { return b - a <= 1e-10; }, 100);
  EXPECT_LE(low, std::cbrt(2.0));
  EXPECT_GE(high, std::cbrt(2.0));
  EXPECT_LE(high - low, 1e-10);
}

}  // namespace distributions_test
