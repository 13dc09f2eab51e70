#include "core/media/ellipsoid_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace jnd::core {
namespace ellipsoid_drag_test {

constexpr double kPi = std::numbers::pi;

std::array<double, 3> damping(std::array<double, 3> semi_axes_m) {
  return EllipsoidDrag({.viscosity_pa_s = 1.0, .semi_axes_m = semi_axes_m}).damping_n_s_per_m();
}

TEST(EllipsoidDrag, OfASphereIsStokes) {
  for (const double radius : {1e-3, 0.065, 2.0}) {
    for (const double k : damping({radius, radius, radius})) {
      EXPECT_NEAR(k, 6.0 * kPi * radius, 1e-12 * radius);
    }
  }
}

TEST(EllipsoidDrag, OfProlateSpheroidsIsTheClosedForm) {
  // Kim and Karrila (1991), Microhydrodynamics, table 3.4: 6 pi a X and 6 pi a Y.
  for (const double ratio : {1.5, 2.0, 5.0, 20.0}) {
    const double e = std::sqrt(1.0 - 1.0 / (ratio * ratio));
    const double l = std::log((1.0 + e) / (1.0 - e));
    const double along = 8.0 / 3.0 * e * e * e / (-2.0 * e + (1.0 + e * e) * l);
    const double across = 16.0 / 3.0 * e * e * e / (2.0 * e + (3.0 * e * e - 1.0) * l);
    const auto k = damping({ratio, 1.0, 1.0});
    EXPECT_NEAR(k[0] / (6.0 * kPi * ratio), along, 1e-12) << ratio;
    EXPECT_NEAR(k[1] / (6.0 * kPi * ratio), across, 1e-12) << ratio;
    EXPECT_NEAR(k[2], k[1], 1e-12) << ratio;
  }
}

TEST(EllipsoidDrag, OfOblateSpheroidsIsTheClosedForm) {
  // Kim and Karrila (1991), table 3.6.
  for (const double ratio : {1.5, 2.0, 5.0, 20.0}) {
    const double e = std::sqrt(1.0 - 1.0 / (ratio * ratio));
    const double minor = std::sqrt(1.0 - e * e);
    const double c = std::atan(e / minor);
    const double along = 4.0 / 3.0 * e * e * e / ((2.0 * e * e - 1.0) * c + e * minor);
    const double across = 8.0 / 3.0 * e * e * e / ((2.0 * e * e + 1.0) * c - e * minor);
    const auto k = damping({ratio, ratio, 1.0});
    EXPECT_NEAR(k[2] / (6.0 * kPi * ratio), along, 1e-11) << ratio;
    EXPECT_NEAR(k[0] / (6.0 * kPi * ratio), across, 1e-11) << ratio;
  }
}

TEST(EllipsoidDrag, OfAThinDiscIsThePublishedLimit) {
  // Happel and Brenner (1965), sec. 5-11: broadside 16 mu a, edge on 32/3 mu a.
  const auto k = damping({1.0, 1.0, 1e-6});
  EXPECT_NEAR(k[2], 16.0, 1e-4);
  EXPECT_NEAR(k[0], 32.0 / 3.0, 1e-4);
}

TEST(EllipsoidDrag, HasPerrinsShapeFactor) {
  // Perrin (1936): relative to the sphere of the same volume, over all orientations, F = sqrt(1
  // - q^2) / (q^(2/3) ln((1 + sqrt(1 - q^2)) / q)), q = minor / major.
  for (const double ratio : {2.0, 5.0, 10.0}) {
    const double q = 1.0 / ratio;
    const double root = std::sqrt(1.0 - q * q);
    const double published = root / (std::pow(q, 2.0 / 3.0) * std::log((1.0 + root) / q));
    const auto k = damping({ratio, 1.0, 1.0});
    const double mean = 3.0 / (1.0 / k[0] + 1.0 / k[1] + 1.0 / k[2]);
    EXPECT_NEAR(mean / (6.0 * kPi * std::cbrt(ratio)), published, 1e-12) << ratio;
  }
}

TEST(EllipsoidDrag, AFlatHandIsEasiestAlongItsFingersAndHardestHeadOn) {
  const auto k = EllipsoidDrag({.viscosity_pa_s = 1.0}).damping_n_s_per_m();
  EXPECT_LT(k[0], k[1]);
  EXPECT_LT(k[1], k[2]);
  // All values lie between those of the spheres inside and outside of the ellipsoid.
  EXPECT_GT(k[0], 6.0 * kPi * 0.014);
  EXPECT_LT(k[2], 6.0 * kPi * 0.10);
}

TEST(EllipsoidDrag, IsLinearInViscosity) {
  const auto thin = EllipsoidDrag({.viscosity_pa_s = 1.0}).damping_n_s_per_m();
  const auto thick = EllipsoidDrag({.viscosity_pa_s = 16.0}).damping_n_s_per_m();
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(thick[i], 16.0 * thin[i], 1e-12);
}

TEST(EllipsoidDrag, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {-1.0, nan, infinity}) {
    EXPECT_THROW(EllipsoidDrag({.viscosity_pa_s = wrong}), Error) << wrong;
    EXPECT_THROW(EllipsoidDrag({.viscosity_pa_s = 1.0, .semi_axes_m = {0.1, wrong, 0.02}}),
                 Error);
  }
  EXPECT_THROW(EllipsoidDrag({.viscosity_pa_s = 1.0, .semi_axes_m = {0.1, 0.05, 0.0}}), Error);
}

TEST(HandAxes, AreTheFingersAcrossThemAndTheNormal) {
  PointVectors tips = zero_vectors();
  tips[static_cast<int>(ContactPoint::kPalmInner)] = {0.0, 0.0, 0.0};
  tips[static_cast<int>(ContactPoint::kPalmOuter)] = {0.0, 0.01, -0.06};
  tips[static_cast<int>(ContactPoint::kIndex)] = {0.0, 0.12, 0.0};
  const Eigen::Matrix3d axes = hand_axes(tips);
  EXPECT_LT((axes.col(0) - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12);
  EXPECT_NEAR(std::abs(axes.col(2).x()), 1.0, 1e-12);
  EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(HandAxes, OfPointsOnALineAreZero) { EXPECT_EQ(hand_axes(zero_vectors()).norm(), 0.0); }

}  // namespace ellipsoid_drag_test
}  // namespace jnd::core
