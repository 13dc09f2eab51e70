#include "analysis/movement/force_by_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jnd::analysis {
namespace force_by_speed_test {

core::Sample moving(double speed_m_per_s, double across_ratio) {
  core::Sample sample{.attached_bits = 0b11111};
  // Two palm points and the index finger span a plane whose normal is x.
  sample.tip_position_m = {{{0, 0, 0}, {0, 0.1, 0}, {0, 0, 0}, {0, 0, 0.1}, {0, 0, 0}}};
  const double along = std::sqrt(1.0 - across_ratio * across_ratio);
  for (auto& velocity : sample.tip_velocity_m_per_s) {
    velocity = {across_ratio * speed_m_per_s, along * speed_m_per_s, 0.0};
  }
  return sample;
}

TEST(CommandedForce, OfWaterGrowsWithTheSquareOfSpeedAndTheAngle) {
  const CommandedForce water("water", 2.0, std::nullopt);
  ASSERT_TRUE(water.is_known());
  // F = scale 7.4 C_D v^2, with C_D 0.8899 head on and 0.2689 edge on (thesis, sec. 4.1).
  EXPECT_NEAR(water.opposing_n(moving(0.5, 1.0), 0.5), 2.0 * 7.4 * 0.8899 * 0.25, 1e-9);
  EXPECT_NEAR(water.opposing_n(moving(0.5, 0.0), 0.5), 2.0 * 7.4 * 0.2689 * 0.25, 1e-9);
}

TEST(CommandedForce, OfWaterOnFewerPointsIsAsTheLoopHasIt) {
  const CommandedForce water("water", 2.0, std::nullopt);
  const core::MediumAmounts amounts = core::water({.scale = 2.0});
  for (const unsigned bits : {0b00001U, 0b00011U, 0b01100U}) {
    core::Sample sample{.attached_bits = static_cast<std::uint8_t>(bits)};
    for (std::size_t i = 0; i < 5; ++i) {
      if ((bits >> i & 1U) == 0) continue;
      sample.tip_position_m[i] = {0.1, 0.01 * static_cast<double>(i), -0.2};
      sample.tip_velocity_m_per_s[i] = {0.4, 0.0, 0.0};
    }
    // Without a hand plane, the hand meets the fluid head on.
    const double expected_n = amounts.drag_n({.velocity_m_per_s = {0.4, 0.0, 0.0},
                                              .speed_m_per_s = 0.4,
                                              .sin_angle_of_attack = 1.0});
    EXPECT_GT(expected_n, 0.1);
    EXPECT_NEAR(water.opposing_n(sample, 0.4), expected_n, 1e-12) << bits;
  }
}

TEST(CommandedForce, OfAViscousFluidIsItsDampingTimesSpeed) {
  const core::Sample sample = moving(0.5, 0.3);
  EXPECT_NEAR(CommandedForce("viscous", 10.0, std::nullopt).opposing_n(sample, 0.5), 8.88,
              1e-9);
  EXPECT_NEAR(CommandedForce("viscous_stokes", 10.0, std::nullopt).opposing_n(sample, 0.5),
              6.161, 1e-3);
  EXPECT_EQ(CommandedForce("free_space", 0.0, std::nullopt).opposing_n(sample, 0.5), 0.0);
  // The damping of the row counts more than the name of the medium.
  EXPECT_NEAR(CommandedForce("syrup", 10.0, 4.0).opposing_n(sample, 0.5), 2.0, 1e-12);
}

TEST(CommandedForce, IsUnknownForLawsThatTheDatabaseDoesNotTell) {
  for (const char* medium : {"solid", "water_map", "viscous_ellipsoid", "syrup"}) {
    const CommandedForce unknown(medium, 1.0, std::nullopt);
    EXPECT_FALSE(unknown.is_known()) << medium;
    EXPECT_EQ(unknown.opposing_n(moving(0.5, 1.0), 0.5), 0.0);
  }
  EXPECT_FALSE(CommandedForce("water", std::nan(""), std::nullopt).is_known());
}

TEST(ForceSums, AreMeansOverallAndByClassesOfSpeed) {
  ForceSums sums, other;
  for (int i = 0; i < 20; ++i) sums.add(0.10 + 0.0005 * i, 1.0, 2.0);
  for (int i = 0; i < 40; ++i) other.add(0.31, 3.0, 4.0);
  // The samples are too few for a class.
  for (int i = 0; i < 19; ++i) other.add(0.50, 9.0, 9.0);
  sums.add(other);
  const ForceBySpeed by_speed = sums.by_speed();
  ASSERT_EQ(by_speed.speed_m_per_s.size(), 2U);
  EXPECT_NEAR(by_speed.speed_m_per_s[0], 0.10475, 1e-12);
  EXPECT_EQ(by_speed.delivered_n[1], 3.0);
  EXPECT_EQ(by_speed.commanded_n[1], 4.0);
  const DeliveredForce force = sums.delivered();
  EXPECT_NEAR(*force.delivered_n, (20.0 + 120.0 + 171.0) / 79.0, 1e-12);
  EXPECT_NEAR(*force.commanded_n, (40.0 + 160.0 + 171.0) / 79.0, 1e-12);
  EXPECT_NEAR(*force.delivered_ratio, 311.0 / 371.0, 1e-12);
  EXPECT_NEAR(*force.delivered_damping_n_s_per_m, 311.0 / (20 * 0.10475 + 12.4 + 9.5), 1e-12);
}

TEST(ForceSums, ACommandedForceThatIsUnknownForSomeIsUnknownForAll) {
  ForceSums sums, unknown;
  for (int i = 0; i < 30; ++i) sums.add(0.2, 1.0, 1.0);
  unknown.commanded_is_unknown();
  for (int i = 0; i < 30; ++i) unknown.add(0.2, 1.0, 0.0);
  sums.add(unknown);
  EXPECT_FALSE(sums.delivered().commanded_n.has_value());
  EXPECT_FALSE(sums.delivered().delivered_ratio.has_value());
  EXPECT_TRUE(sums.by_speed().commanded_n.empty());
  EXPECT_EQ(sums.by_speed().delivered_n.size(), 1U);
}

TEST(ForceSums, WithoutMotionThereIsNoDampingAndWithoutTicksNothing) {
  EXPECT_FALSE(ForceSums().delivered().delivered_n.has_value());
  EXPECT_TRUE(ForceSums().by_speed().speed_m_per_s.empty());
  ForceSums rest;
  rest.add(0.0, 0.0, 0.0);
  EXPECT_EQ(*rest.delivered().delivered_n, 0.0);
  EXPECT_FALSE(rest.delivered().delivered_damping_n_s_per_m.has_value());
  EXPECT_FALSE(rest.delivered().delivered_ratio.has_value());
  rest.add(1000.0, 1.0, 1.0);  // The speed is beyond the classes.
  EXPECT_TRUE(std::isfinite(*rest.delivered().delivered_n));
}

}  // namespace force_by_speed_test
}  // namespace jnd::analysis
