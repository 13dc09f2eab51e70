#include "analysis/fits/sigmoid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace sigmoid_test {

constexpr Sigmoid kBoth[] = {Sigmoid::kNormal, Sigmoid::kWeibull};

TEST(Sigmoid, IsHalfAtZeroAndOneJndFurtherAt84Percent) {
  for (const Sigmoid sigmoid : kBoth) {
    EXPECT_NEAR(sigmoid_tails(sigmoid, 0.0).lower, 0.5, 1e-15);
    EXPECT_NEAR(sigmoid_tails(sigmoid, sigmoid_jnd(sigmoid)).lower,
                core::standard_normal_cdf(1.0), 1e-14);
  }
}

TEST(Sigmoid, WeibullIsOneMinusTwoToTheMinusExponential) {
  for (const double z : {-3.0, -0.5, 0.0, 0.7, 2.0}) {
    const SigmoidTails tails = sigmoid_tails(Sigmoid::kWeibull, z);
    EXPECT_NEAR(tails.upper, std::pow(2.0, -std::exp(z)), 1e-15);
    EXPECT_NEAR(tails.lower + tails.upper, 1.0, 1e-15);
  }
}

TEST(Sigmoid, DensityAndBendAreItsDerivatives) {
  constexpr double kStep = 1e-5;
  for (const Sigmoid sigmoid : kBoth) {
    for (const double z : {-2.0, -0.3, 0.4, 1.1}) {
      const auto lower = [&](double at) { return sigmoid_tails(sigmoid, at).lower; };
      const auto density = [&](double at) { return sigmoid_tails(sigmoid, at).density; };
      const SigmoidTails here = sigmoid_tails(sigmoid, z);
      EXPECT_NEAR(here.density, (lower(z + kStep) - lower(z - kStep)) / (2.0 * kStep), 1e-9);
      EXPECT_NEAR(here.bend * here.density,
                  (density(z + kStep) - density(z - kStep)) / (2.0 * kStep), 1e-9);
    }
  }
}

TEST(Sigmoid, LogarithmsAgreeAndStayFiniteWhereTheTailsUnderflow) {
  for (const Sigmoid sigmoid : kBoth) {
    for (const double z : {-5.0, 0.3, 1.5}) {
      const SigmoidTails tails = sigmoid_tails(sigmoid, z);
      const LogSigmoidTails logs = log_sigmoid_tails(sigmoid, z);
      EXPECT_NEAR(logs.log_lower, std::log(tails.lower), 1e-12);
      EXPECT_NEAR(logs.log_upper, std::log(tails.upper), 1e-12);
      EXPECT_NEAR(logs.mills_lower, tails.density / tails.lower, 1e-12);
      EXPECT_NEAR(logs.mills_upper, tails.density / tails.upper, 1e-11);
    }
  }
  // ln F = z + ln ln 2 far below, and F' / F = 1. Far above, F' / F = 0.
  const LogSigmoidTails below = log_sigmoid_tails(Sigmoid::kWeibull, -800.0);
  EXPECT_NEAR(below.log_lower, -800.0 + std::log(std::log(2.0)), 1e-9);
  EXPECT_NEAR(below.mills_lower, 1.0, 1e-12);
  EXPECT_EQ(log_sigmoid_tails(Sigmoid::kWeibull, 800.0).mills_lower, 0.0);
}

TEST(Sigmoid, TheQuantileUndoesIt) {
  for (const Sigmoid sigmoid : kBoth) {
    for (const double p : {0.001, 0.3, 0.5, 0.9}) {
      EXPECT_NEAR(sigmoid_tails(sigmoid, sigmoid_quantile(sigmoid, p)).lower, p, 1e-12);
    }
  }
}

}  // namespace sigmoid_test
}  // namespace jnd::analysis
