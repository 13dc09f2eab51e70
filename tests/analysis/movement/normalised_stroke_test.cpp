#include "analysis/movement/normalised_stroke.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace normalised_stroke_test {

void push(StrokeBuffer& buffer, std::int64_t tick, double x_m) {
  core::Sample sample{.tick = tick};
  sample.joint_torque_n_m[core::kNumJoints - 1] = static_cast<float>(tick);
  sample.tip_position_m[4] = {3.0, 4.0, 0.0};
  buffer.push({.tick = tick, .x_m = x_m, .forward_velocity_m_per_s = 10.0 * x_m}, sample);
}

TEST(StrokeBuffer, ForgetsTheOldestTicksBeyondItsCapacity) {
  StrokeBuffer buffer(3, /*has_joints=*/false);
  for (std::int64_t tick = 7; tick < 12; ++tick) push(buffer, tick, 0.0);
  EXPECT_FALSE(buffer.holds(8));
  EXPECT_TRUE(buffer.holds(9));
  EXPECT_TRUE(buffer.holds(11));
  EXPECT_FALSE(buffer.holds(12));
  buffer.restart();
  EXPECT_FALSE(buffer.holds(11));
}

TEST(StrokeBuffer, StartsAnewAtAGap) {
  StrokeBuffer buffer(10, /*has_joints=*/false);
  push(buffer, 5, 0.0);
  push(buffer, 7, 0.0);
  EXPECT_FALSE(buffer.holds(5));
  EXPECT_FALSE(buffer.holds(6));
  EXPECT_TRUE(buffer.holds(7));
}

TEST(StrokeBuffer, GivesEveryChannelOnTheLineBetweenTwoTicks) {
  StrokeBuffer buffer(10, /*has_joints=*/true);
  push(buffer, 5, 1.0);
  push(buffer, 6, 3.0);
  std::array<double, StrokeBuffer::kNumChannels> values{};
  buffer.values_at(5.25, values);
  EXPECT_NEAR(values[0], 15.0, 1e-12);
  EXPECT_NEAR(values[7], 5.0, 1e-12) << "the middle finger's distance";
  EXPECT_NEAR(values.back(), 5.25, 1e-6);
  buffer.values_at(6.0, values);
  EXPECT_NEAR(values[0], 30.0, 1e-12);
}

TEST(StrokeBuffer, FindsTheMiddleOfAHalfStrokeFromEitherEnd) {
  StrokeBuffer buffer(20, /*has_joints=*/false);
  // The hand moves forth by 1 a tick and back by 2 a tick.
  for (std::int64_t tick = 0; tick <= 9; ++tick) push(buffer, tick, static_cast<double>(tick));
  for (std::int64_t tick = 10; tick <= 13; ++tick) {
    push(buffer, tick, 9.0 - 2.0 * static_cast<double>(tick - 9));
  }
  const HalfStroke there{.first_tick = 0, .last_tick = 9, .to_x_m = 9.0, .width_m = 9.0};
  EXPECT_NEAR(*buffer.passes_middle(there, 0, 9), 4.5, 1e-12);
  EXPECT_NEAR(*buffer.passes_middle(there, 9, 0), 4.5, 1e-12);
  EXPECT_NEAR(*buffer.passes_middle(there, 9, 13), 9.0 + 4.5 / 2.0, 1e-12);
  EXPECT_FALSE(buffer.passes_middle(there, 9, 11).has_value());
  EXPECT_FALSE(buffer.passes_middle(there, 9, 14).has_value()) << "not held";
}

}  // namespace normalised_stroke_test
}  // namespace jnd::analysis
