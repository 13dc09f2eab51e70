#include "core/safety/port_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace jnd::core {
namespace port_energy_test {

constexpr double kPeriod_s = 0.001;

constexpr std::array<bool, kNumContactPoints> kAll = {true, true, true, true, true};

PointVectors along_x(double value) {
  PointVectors all = zero_vectors();
  for (Eigen::Vector3d& vector : all) vector.x() = value;
  return all;
}

TEST(PortEnergy, IsForceTimesWay) {
  PortEnergy energy({.max_given_j = 1.0, .memory_s = 1e9}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(100.0), kAll, 0);
  EXPECT_EQ(energy.given_j(0), 0.0) << "the first measurement has no way";
  energy.observe(along_x(0.01), along_x(2.0), kAll, 0);
  EXPECT_NEAR(energy.given_j(0), 0.02, 1e-12);
  energy.observe(along_x(0.02), along_x(-0.5), kAll, 0);
  EXPECT_NEAR(energy.given_j(0), 0.015, 1e-12) << "the hand put 5 mJ back";
}

TEST(PortEnergy, AFluidBanksNothing) {
  PortEnergy energy({.max_given_j = 0.02}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0);
  for (int i = 1; i <= 100; ++i) energy.observe(along_x(0.01 * i), along_x(-10.0), kAll, 0);
  EXPECT_EQ(energy.given_j(2), 0.0);
  // 10 J went in, and 21 mJ out are too much all the same.
  energy.observe(along_x(1.0 + 0.0021), along_x(10.0), kAll, 0);
  EXPECT_TRUE(energy.is_exceeded());
}

TEST(PortEnergy, ASpringGivesBackWhatItGotAndNoMore) {
  PortEnergy energy({.max_given_j = 0.02}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0b11111);
  energy.observe(along_x(0.01), along_x(-10.0), kAll, 0b11111);
  EXPECT_NEAR(energy.given_j(0), -0.1, 1e-12);
  energy.observe(along_x(0.0), along_x(-10.0), kAll, 0b11111);
  EXPECT_NEAR(energy.given_j(0), 0.0, 1e-12);
  EXPECT_FALSE(energy.is_exceeded());
  energy.observe(along_x(-0.0021), along_x(-10.0), kAll, 0b11111);
  EXPECT_TRUE(energy.is_exceeded());
}

TEST(PortEnergy, CreditHasABound) {
  PortEnergy energy({.max_credit_j = 0.5}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0b11111);
  energy.observe(along_x(1.0), along_x(-10.0), kAll, 0b11111);
  EXPECT_EQ(energy.given_j(0), -0.5);
}

TEST(PortEnergy, CreditIsOfThePointsThatStore) {
  PortEnergy energy({}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0b00100);
  energy.observe(along_x(0.01), along_x(-10.0), kAll, 0b00100);
  EXPECT_EQ(energy.given_j(1), 0.0);
  EXPECT_NEAR(energy.given_j(2), -0.1, 1e-12);
  energy.observe(along_x(0.01), along_x(-10.0), kAll, 0);
  EXPECT_EQ(energy.given_j(2), 0.0) << "it was let go";
}

TEST(PortEnergy, WhatIsPutAroundAHandMayPushItOutOnce) {
  PortEnergy energy({.max_credit_j = 0.5}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0);
  energy.grant_credit();
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0);
  energy.observe(along_x(0.05), along_x(10.0), kAll, 0b11111);
  EXPECT_EQ(energy.given_j(0), 0.0) << "the grant waits for the contact";
  energy.observe(along_x(0.051), along_x(10.0), kAll, 0b11111);
  EXPECT_NEAR(energy.given_j(0), 0.01, 1e-12) << "and is used up";
  energy.reset();
  energy.grant_credit();
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0);
  energy.observe(along_x(0.0021), along_x(10.0), kAll, 0);
  EXPECT_TRUE(energy.is_exceeded()) << "a fluid has none";
}

TEST(PortEnergy, APointThatComesOffOrIsPutBackGivesNothing) {
  constexpr std::array<bool, kNumContactPoints> kWithoutThumb = {true, true, false, true, true};
  PortEnergy energy({}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(10.0), kAll, 0);
  energy.observe(along_x(0.001), along_x(10.0), kWithoutThumb, 0);
  EXPECT_EQ(energy.given_j(2), 0.0);
  energy.observe(along_x(0.0015), along_x(10.0), kAll, 0);
  EXPECT_EQ(energy.given_j(2), 0.0) << "it was not held before";
  energy.observe(along_x(0.002), along_x(10.0), kAll, 0);
  EXPECT_NEAR(energy.given_j(2), 0.005, 1e-12);
}

TEST(PortEnergy, ForgetsWithItsTimeConstant) {
  PortEnergy energy({.max_given_j = 1.0, .memory_s = 0.25}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0);
  energy.observe(along_x(0.01), along_x(1.0), kAll, 0);
  for (int i = 0; i < 250; ++i) energy.observe(along_x(0.01), along_x(1.0), kAll, 0);
  EXPECT_NEAR(energy.given_j(0), 0.01 * std::exp(-1.0), 1e-9);
}

TEST(PortEnergy, OnePointIsEnough) {
  PortEnergy energy({.max_given_j = 0.02}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0);
  PointVectors acted = along_x(-10.0);
  acted[3].x() = 10.0;
  energy.observe(along_x(0.003), acted, kAll, 0);
  EXPECT_TRUE(energy.is_exceeded());
  energy.reset();
  EXPECT_FALSE(energy.is_exceeded());
  EXPECT_EQ(energy.given_j(3), 0.0);
}

TEST(PortEnergy, WhatIsNoNumberIsNotAddedUp) {
  PortEnergy energy({}, kPeriod_s);
  energy.observe(along_x(0.0), along_x(0.0), kAll, 0);
  energy.observe(along_x(0.01), along_x(std::numeric_limits<double>::quiet_NaN()), kAll, 0);
  EXPECT_EQ(energy.given_j(0), 0.0);
  energy.observe(along_x(0.02), along_x(3.0), kAll, 0);
  EXPECT_TRUE(energy.is_exceeded());
}

TEST(PortEnergy, ParametersOutOfRangeAreRefused) {
  EXPECT_THROW(PortEnergy({.max_given_j = 0.0}, kPeriod_s), Error);
  EXPECT_THROW(PortEnergy({.memory_s = -1.0}, kPeriod_s), Error);
  EXPECT_THROW(PortEnergy({.max_credit_j = std::nan("")}, kPeriod_s), Error);
  EXPECT_THROW(PortEnergy({}, 0.0), Error);
}

}  // namespace port_energy_test
}  // namespace jnd::core
