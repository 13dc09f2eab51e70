#include "app/operator/live_trace.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "core/error.h"

namespace jnd::app {
namespace live_trace_test {

/// Returns a sample in which all tips have the same values.
core::Sample sample(std::int64_t tick, double x_m, double speed_m_per_s, double tip_force_n) {
  core::Sample sample;
  sample.tick = tick;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    sample.tip_position_m[i] = {x_m, 2.0 * x_m, -0.15};
    sample.tip_velocity_m_per_s[i] = {0.6 * speed_m_per_s, 0.0, -0.8 * speed_m_per_s};
    sample.tip_force_n[i] = {0.0, -tip_force_n, 0.0};
  }
  return sample;
}

TEST(LiveTrace, KeepsAHundredPointsASecondWithTheLargestOfEach) {
  LiveTrace trace({});
  for (int tick = 0; tick < 1001; ++tick) {
    const bool peak = tick == 504;
    trace.take(sample(tick, 1e-3 * tick, peak ? 2.0 : 0.5, peak ? 3.0 : 1.0));
  }
  const std::vector<TracePoint> points = trace.snapshot();
  ASSERT_EQ(points.size(), 100U);
  EXPECT_DOUBLE_EQ(points[50].time_s, 0.5);
  EXPECT_NEAR(points[50].x_m, 0.509, 1e-12) << "where it was at the interval's end";
  EXPECT_NEAR(points[50].y_m, 1.018, 1e-12);
  EXPECT_NEAR(points[50].z_m, -0.15, 1e-12);
  EXPECT_NEAR(points[50].speed_m_per_s, 2.0, 1e-12);
  EXPECT_NEAR(points[50].force_n, 15.0, 1e-12) << "on the whole hand";
  EXPECT_NEAR(points[51].speed_m_per_s, 0.5, 1e-12) << "a peak belongs to one interval";
  EXPECT_NEAR(points[51].force_n, 5.0, 1e-12);
}

TEST(LiveTrace, TheVelocityIsTheMeanOfTheTips) {
  LiveTrace trace({});
  core::Sample turning;
  turning.tip_velocity_m_per_s[0] = {1.0, 0.0, 0.0};
  turning.tip_velocity_m_per_s[1] = {-1.0, 0.0, 0.0};
  turning.tip_velocity_m_per_s[2] = {0.0, 0.5, 0.0};
  trace.take(turning);
  trace.take(sample(10, 0.0, 0.0, 0.0));
  ASSERT_EQ(trace.snapshot().size(), 1U);
  EXPECT_NEAR(trace.snapshot()[0].speed_m_per_s, 0.1, 1e-15);
}

TEST(LiveTrace, ForgetsWhatIsOlderThanItsDuration) {
  LiveTrace trace({.duration_s = 2.0});
  for (int tick = 0; tick <= 7000; ++tick) trace.take(sample(tick, 1e-3 * tick, 0.0, 0.0));
  const std::vector<TracePoint> points = trace.snapshot();
  ASSERT_EQ(points.size(), 200U);
  EXPECT_DOUBLE_EQ(points.front().time_s, 5.0);
  EXPECT_DOUBLE_EQ(points.back().time_s, 6.99);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LT(points[i - 1].time_s, points[i].time_s);
  }
}

TEST(LiveTrace, LostSamplesLeaveAGapInTimeAndNothingOldBehindIt) {
  LiveTrace trace({.duration_s = 2.0});
  for (int tick = 0; tick < 1000; ++tick) trace.take(sample(tick, 0.0, 0.0, 0.0));
  for (int tick = 2500; tick < 2600; ++tick) trace.take(sample(tick, 0.0, 0.0, 0.0));
  const std::vector<TracePoint> points = trace.snapshot();
  EXPECT_DOUBLE_EQ(points.back().time_s, 2.58);
  EXPECT_GT(points.front().time_s, 0.58);
  EXPECT_LT(points.front().time_s, 0.6);
}

TEST(LiveTrace, SamplesOfAnEarlierTimeBeginItAnew) {
  LiveTrace trace({});
  for (int tick = 5000; tick < 6000; ++tick) trace.take(sample(tick, 0.0, 0.0, 0.0));
  trace.take(sample(100, 0.0, 0.0, 0.0));
  EXPECT_TRUE(trace.snapshot().empty());
  trace.take(sample(110, 0.0, 0.0, 0.0));
  ASSERT_EQ(trace.snapshot().size(), 1U);
  EXPECT_DOUBLE_EQ(trace.snapshot()[0].time_s, 0.1);
}

TEST(LiveTrace, ClearedItIsEmpty) {
  LiveTrace trace({});
  for (int tick = 0; tick < 100; ++tick) trace.take(sample(tick, 0.0, 0.0, 0.0));
  trace.clear();
  EXPECT_TRUE(trace.snapshot().empty());
  trace.take(sample(100, 0.0, 0.0, 0.0));
  EXPECT_TRUE(trace.snapshot().empty()) << "the interval under way is not in";
}

TEST(LiveTrace, LeavesOutWhatIsNotFinite) {
  LiveTrace trace({});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  trace.take(sample(0, 0.1, 1.0, 1.0));
  trace.take(sample(1, nan, 5.0, 5.0));
  trace.take(sample(2, 0.1, std::numeric_limits<double>::infinity(), 1.0));
  trace.take(sample(10, 0.1, 1.0, 1.0));
  ASSERT_EQ(trace.snapshot().size(), 1U);
  EXPECT_NEAR(trace.snapshot()[0].x_m, 0.1, 1e-15);
  EXPECT_NEAR(trace.snapshot()[0].speed_m_per_s, 1.0, 1e-15);
}

TEST(LiveTrace, ALoopSlowerThanItsPointsGetsOneATick) {
  LiveTrace trace({.rate_hz = 50.0, .duration_s = 1.0});
  for (int tick = 0; tick < 200; ++tick) trace.take(sample(tick, 0.0, 0.0, 0.0));
  EXPECT_EQ(trace.snapshot().size(), 50U);
}

TEST(LiveTrace, APictureMayBeTakenWhileSamplesComeIn) {
  LiveTrace trace({.duration_s = 0.5});
  std::atomic<bool> done{false};
  std::thread storage([&] {
    for (int tick = 0; tick < 50'000; ++tick) trace.take(sample(tick, 1.0, 1.0, 1.0));
    done = true;
  });
  while (!done) {
    for (const TracePoint& point : trace.snapshot()) {
      EXPECT_NEAR(point.force_n, 5.0, 1e-12) << "whole points alone";
    }
  }
  storage.join();
  EXPECT_EQ(trace.snapshot().size(), 50U);
}

TEST(LiveTrace, NamesTheParameterItRejects) {
  EXPECT_THROW(LiveTrace({.rate_hz = 0.0}), core::Error);
  EXPECT_THROW(LiveTrace({.duration_s = -1.0}), core::Error);
  EXPECT_THROW(LiveTrace({.points_per_s = std::nan("")}), core::Error);
}

}  // namespace live_trace_test
}  // namespace jnd::app
