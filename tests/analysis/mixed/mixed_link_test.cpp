#include "analysis/mixed/mixed_link.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jnd::analysis {
namespace mixed_link_test {

constexpr MixedLink kLinks[] = {MixedLink::kProbit, MixedLink::kLogit, MixedLink::kCloglog};

TEST(MixedLinks, AreTheFormulasOfTheHelp) {
  for (const double eta : {-2.0, -0.3, 0.0, 0.7, 1.9}) {
    EXPECT_NEAR(curve_probability({.link = MixedLink::kProbit}, eta),
                0.5 * std::erfc(-eta / std::sqrt(2.0)), 1e-15);
    EXPECT_NEAR(curve_probability({.link = MixedLink::kLogit}, eta),
                1.0 / (1.0 + std::exp(-eta)), 1e-15);
    EXPECT_NEAR(curve_probability({.link = MixedLink::kCloglog}, eta),
                1.0 - std::exp(-std::exp(eta)), 1e-15);
  }
}

TEST(MixedLinks, QuantilesTurnThemRound) {
  for (const MixedLink link : kLinks) {
    for (const double probability : {0.02, 0.5, 0.75, 0.99}) {
      EXPECT_NEAR(curve_probability({.link = link}, link_quantile(link, probability)),
                  probability, 1e-14);
    }
    EXPECT_EQ(mixed_link(to_string(link)), link);
  }
  EXPECT_NEAR(link_quantile(MixedLink::kCloglog, 0.5), std::log(std::log(2.0)), 1e-15);
  EXPECT_FALSE(mixed_link("cauchit"));
}

TEST(MixedLinks, DerivativesAreThoseOfTheCurve) {
  constexpr double kStep = 1e-4;
  for (const MixedLink link : kLinks) {
    for (const auto& [guess, lapse] :
         {std::pair{0.0, 0.0}, std::pair{0.5, 0.02}, std::pair{0.25, 0.0}, {0.0, 0.05}}) {
      const MixedCurve curve = {link, guess, lapse};
      for (const double eta : {-1.5, 0.2, 1.1}) {
        const double p = curve_probability(curve, eta);
        const double above = curve_probability(curve, eta + kStep);
        const double below = curve_probability(curve, eta - kStep);
        const double rise = (above - below) / (2.0 * kStep);
        const double bend = (above - 2.0 * p + below) / (kStep * kStep);
        const MixedCurvePoint point = curve_point(curve, eta);
        EXPECT_NEAR(point.log_yes, std::log(p), 1e-13);
        EXPECT_NEAR(point.log_no, std::log1p(-p), 1e-13);
        EXPECT_NEAR(point.rise_yes, rise / p, 1e-6);
        EXPECT_NEAR(point.rise_no, rise / (1.0 - p), 1e-6);
        EXPECT_NEAR(point.bend, bend / rise, 1e-5);
      }
    }
  }
}

TEST(MixedLinks, StayFiniteFarOut) {
  for (const MixedLink link : kLinks) {
    for (const double lapse : {0.0, 0.02}) {
      for (const double eta : {-60.0, 60.0}) {
        const MixedCurvePoint point = curve_point({link, 0.0, lapse}, eta);
        EXPECT_TRUE(std::isfinite(point.rise_yes)) << to_string(link) << eta;
        EXPECT_TRUE(std::isfinite(point.rise_no)) << to_string(link) << eta;
        EXPECT_TRUE(std::isfinite(point.log_yes)) << to_string(link) << eta;
      }
    }
  }
}

}  // namespace mixed_link_test
}  // namespace jnd::analysis
