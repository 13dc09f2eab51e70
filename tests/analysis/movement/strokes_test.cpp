#include "analysis/movement/strokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random_stream.h"
#include "support/allocation_counter.h"

namespace jnd::analysis {
namespace strokes_test {

constexpr double kTickS = 0.001;

struct Motion {
  double amplitude_m = 0.13;
  double rate_hz = 0.7;
  double direction_rad = 0.0;  ///< The direction of the stroke in the horizontal plane.
  double phase_rad = 0.0;
  double height_m = -0.2;
  double noise_m = 0.0;
};

void feed(StrokeMeter& meter, const Motion& motion, double duration_s) {
  core::RandomStream random(1, "strokes test");
  const double omega = 2.0 * std::numbers::pi * motion.rate_hz;
  const Eigen::Vector3d along(std::cos(motion.direction_rad), std::sin(motion.direction_rad),
                              0.0);
  for (int tick = 0; tick * kTickS < duration_s; ++tick) {
    const double phase = omega * tick * kTickS + motion.phase_rad;
    Eigen::Vector3d position_m = motion.amplitude_m * std::sin(phase) * along;
    position_m.z() = motion.height_m;
    for (int axis = 0; axis < 3; ++axis) position_m(axis) += random.normal(0.0, motion.noise_m);
    meter.feed(position_m, motion.amplitude_m * omega * std::cos(phase) * along, kTickS);
  }
}

TEST(StrokeMeter, MeasuresASineWhereverItPoints) {
  for (const double direction_rad : {0.0, 0.4, 1.5708, 2.5}) {
    for (const double phase_rad : {0.0, 0.3, 1.5708, 4.0}) {
      StrokeMeter meter({});
      feed(meter, {.direction_rad = direction_rad, .phase_rad = phase_rad}, 10.0);
      const StrokeSummary found = meter.finish();
      EXPECT_GE(found.num_strokes, 6);
      EXPECT_LE(found.num_strokes, 7);
      EXPECT_NEAR(*found.stroke_width_m, 0.26, 1e-5);
      EXPECT_NEAR(*found.max_speed_m_per_s, 0.13 * 2.0 * std::numbers::pi * 0.7, 1e-4);
      EXPECT_NEAR(*found.mean_height_m, -0.2, 1e-12);
      EXPECT_NEAR(found.duration_s, 10.0, 1e-9);
    }
  }
}

TEST(StrokeMeter, TremblingMakesNoStrokes) {
  StrokeMeter trembling({});
  feed(trembling, {.amplitude_m = 0.01, .rate_hz = 8.0, .noise_m = 0.001}, 5.0);
  EXPECT_EQ(trembling.finish().num_strokes, 0);

  StrokeMeter stroking({});
  feed(stroking, {.noise_m = 0.002}, 10.0);
  const StrokeSummary found = stroking.finish();
  EXPECT_LE(found.num_strokes, 7);
  EXPECT_GE(found.num_strokes, 6);
  EXPECT_NEAR(*found.stroke_width_m, 0.26, 0.015);
}

TEST(StrokeMeter, APauseOnTheWayIsNoTurningPoint) {
  StrokeMeter meter({});
  const auto move = [&](double from_m, double to_m) {
    for (int tick = 0; tick <= 500; ++tick) {
      const double x_m = from_m + (to_m - from_m) * tick / 500.0;
      meter.feed({x_m, 0, 0}, {to_m == from_m ? 0.0 : (to_m - from_m) / 0.5, 0, 0}, kTickS);
    }
  };
  move(0.0, 0.3);
  for (int cycle = 0; cycle < 2; ++cycle) {
    move(0.3, 0.1);
    move(0.1, 0.1);
    move(0.1, -0.3);
    move(-0.3, -0.3);
    move(-0.3, 0.3);
  }
  move(0.3, 0.2);
  const StrokeSummary found = meter.finish();
  EXPECT_EQ(found.num_strokes, 2);
  EXPECT_NEAR(*found.stroke_width_m, 0.6, 1e-9);
  EXPECT_NEAR(*found.max_speed_m_per_s, 1.2, 1e-9);
}

TEST(StrokeMeter, AShortWayBackToTheUsualEndIsNoHalfOfAStroke) {
  StrokeMeter meter({});
  const auto sweep = [&](double from_m, double to_m) {
    for (int tick = 0; tick <= 100; ++tick) {
      meter.feed({from_m + (to_m - from_m) * tick / 100.0, 0, 0}, {1.0, 0, 0}, kTickS);
    }
  };
  sweep(-0.2, -0.1);  // The hand moves to its rest when the presentation begins.
  sweep(-0.1, -0.3);  // It is called back.
  sweep(-0.3, 0.3);   // It strokes only now.
  sweep(0.3, -0.28);
  EXPECT_EQ(meter.num_strokes(), 0);
  sweep(-0.28, -0.2);
  EXPECT_EQ(meter.num_strokes(), 1);
  const StrokeSummary found = meter.finish();
  ASSERT_EQ(found.num_strokes, 1);
  EXPECT_NEAR(*found.stroke_width_m, 0.5 * (0.6 + 0.58), 1e-12);
}

TEST(StrokeMeter, PeakSpeedIsTheMeanOverStrokesNotTheHighestOfAll) {
  StrokeMeter meter({});
  const auto sweep = [&](double from_m, double to_m, double speed_m_per_s) {
    for (int tick = 0; tick <= 100; ++tick) {
      meter.feed({from_m + (to_m - from_m) * tick / 100.0, 0, 0}, {0, speed_m_per_s, 0},
                 kTickS);
    }
  };
  sweep(0.0, 0.2, 9.0);  // The way to the first turning point is no part of any stroke.
  sweep(0.2, -0.2, 1.0);
  sweep(-0.2, 0.2, 2.0);
  sweep(0.2, -0.2, 5.0);
  sweep(-0.2, 0.2, 4.0);
  sweep(0.2, 0.0, 7.0);  // This is beyond the last whole stroke.
  const StrokeSummary found = meter.finish();
  ASSERT_EQ(found.num_strokes, 2);
  EXPECT_NEAR(*found.max_speed_m_per_s, 0.5 * (2.0 + 5.0), 1e-12);
}

TEST(StrokeMeter, SpeedRightAfterATurningPointCountsForTheHalfStrokeThatBeginsThere) {
  StrokeMeter meter({});
  const auto go = [&](double x_m, double speed_m_per_s) {
    meter.feed({x_m, 0, 0}, {speed_m_per_s, 0, 0}, kTickS);
  };
  go(0.0, 1.0);
  go(0.2, 1.0);   // This is the first turning point.
  go(0.19, 8.0);  // It is not known as a turning point yet.
  go(0.1, 1.0);
  go(-0.2, 1.0);
  go(0.0, 1.0);
  go(0.2, 1.0);
  go(0.1, 1.0);
  const StrokeSummary found = meter.finish();
  ASSERT_EQ(found.num_strokes, 1);
  EXPECT_DOUBLE_EQ(*found.max_speed_m_per_s, 8.0);
}

TEST(StrokeMeter, WithoutAStrokeThereIsNoWidthButAHeight) {
  StrokeMeter meter({});
  EXPECT_FALSE(meter.finish().mean_height_m.has_value());
  meter.feed({0, 0, 0.5}, {0, 0, 0}, kTickS);
  meter.feed({0.2, 0, 0.7}, {0, 0, 0}, kTickS);
  const StrokeSummary found = meter.finish();
  EXPECT_EQ(found.num_strokes, 0);
  EXPECT_FALSE(found.stroke_width_m.has_value());
  EXPECT_FALSE(found.max_speed_m_per_s.has_value());
  EXPECT_NEAR(*found.mean_height_m, 0.6, 1e-12);
}

TEST(StrokeMeter, StartsAnewAfterFinish) {
  StrokeMeter meter({});
  feed(meter, {.amplitude_m = 0.5}, 10.0);
  (void)meter.finish();
  feed(meter, {.amplitude_m = 0.13}, 10.0);
  StrokeMeter fresh({});
  feed(fresh, {.amplitude_m = 0.13}, 10.0);
  EXPECT_EQ(*meter.finish().stroke_width_m, *fresh.finish().stroke_width_m);
}

TEST(StrokeMeter, ATickThatIsNotFiniteIsLeftOut) {
  StrokeMeter meter({}), clean({});
  feed(meter, {}, 5.0);
  meter.feed({std::nan(""), 0, 0}, {0, 0, 0}, kTickS);
  meter.feed({0, 0, 0}, {HUGE_VAL, 0, 0}, kTickS);
  feed(clean, {}, 5.0);
  const StrokeSummary found = meter.finish(), expected = clean.finish();
  EXPECT_EQ(*found.stroke_width_m, *expected.stroke_width_m);
  EXPECT_EQ(*found.max_speed_m_per_s, *expected.max_speed_m_per_s);
  EXPECT_EQ(found.duration_s, expected.duration_s);
}

TEST(StrokeMeter, IsSafeToCallOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  StrokeMeter meter({});
  const test_support::AllocationCounter counter;
  feed(meter, {}, 3.0);
  (void)meter.finish();
  EXPECT_EQ(counter.allocations(), 0U);
}

TEST(StrokeMeter, NamesTheParameterItRejects) {
  EXPECT_THROW(StrokeMeter({.hysteresis_m = 0.0}), core::Error);
  EXPECT_THROW(StrokeMeter({.hysteresis_m = std::nan("")}), core::Error);
}

}  // namespace strokes_test
}  // namespace jnd::analysis
