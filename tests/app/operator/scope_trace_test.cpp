#include "app/operator/scope_trace.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "app/operator/scope_channels.h"
#include "core/error.h"
#include "core/sample_table.h"

namespace jnd::app {
namespace scope_trace_test {

const std::string kForce = "index_force_x_n";

core::Sample sample(std::int64_t tick, double index_force_n) {
  core::Sample sample;
  sample.tick = tick;
  sample.tip_force_n[3][0] = index_force_n;
  return sample;
}

std::vector<ScopePoint> points_of(const ScopeTrace& trace, const std::string& name) {
  return trace.snapshot({name}).channels.at(0);
}

TEST(ScopeTrace, ASpikeOfASingleTickIsInItsInterval) {
  ScopeTrace trace({});
  for (int tick = 0; tick <= 1000; ++tick) {
    trace.take(sample(tick, tick == 504 ? 7.0 : tick == 506 ? -3.0 : 1.0));
  }
  const std::vector<ScopePoint> points = points_of(trace, kForce);
  ASSERT_EQ(points.size(), 100U);
  EXPECT_DOUBLE_EQ(points[50].time_s, 0.5);
  EXPECT_FLOAT_EQ(points[50].low, -3.0f);
  EXPECT_FLOAT_EQ(points[50].high, 7.0f);
  EXPECT_FLOAT_EQ(points[49].high, 1.0f);
  EXPECT_FLOAT_EQ(points[51].low, 1.0f);
}

TEST(ScopeTrace, EveryChannelIsWhatTheTableOfSamplesSays) {
  core::Sample every = sample(3, 0.0);
  double value = 0.0;
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      every.tip_position_m[point][axis] = value += 1.0;
      every.tip_velocity_m_per_s[point][axis] = value += 1.0;
      every.tip_force_n[point][axis] = value += 1.0;
    }
  }
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    every.joint_position_rad[joint] = static_cast<float>(value += 1.0);
    every.joint_torque_n_m[joint] = static_cast<float>(value += 1.0);
  }
  every.end_effector_position_m = {-1.0, -2.0, -3.0};
  every.attached_bits = 31;
  every.fault = 4;
  ScopeTrace trace({});
  trace.take(every);
  trace.take(sample(10, 0.0));
  std::vector<std::string> names;
  for (const ScopeChannel& channel : scope_channels(true)) names.push_back(channel.name);
  const ScopePicture picture = trace.snapshot(names);
  const std::vector<double> values = core::sample_values(every, {.joints = true});
  ASSERT_EQ(picture.channels.size() + 1, values.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    ASSERT_EQ(picture.channels[i].size(), 1U) << names[i];
    EXPECT_FLOAT_EQ(picture.channels[i][0].low, static_cast<float>(values[i + 1])) << names[i];
  }
  EXPECT_TRUE(picture.has_joints);
}

TEST(ScopeTrace, ForgetsWhatIsOlderThanItsDuration) {
  ScopeTrace trace({.duration_s = 2.0});
  for (int tick = 0; tick <= 7000; ++tick) trace.take(sample(tick, 0.0));
  const std::vector<ScopePoint> points = points_of(trace, kForce);
  ASSERT_EQ(points.size(), 200U);
  EXPECT_DOUBLE_EQ(points.front().time_s, 5.0);
  EXPECT_DOUBLE_EQ(points.back().time_s, 6.99);
  EXPECT_DOUBLE_EQ(trace.snapshot({}).newest_s, 6.99);
  EXPECT_FALSE(trace.snapshot({}).has_joints);
}

TEST(ScopeTrace, LostSamplesLeaveAGapAndNothingOldBehindIt) {
  ScopeTrace trace({.duration_s = 2.0});
  for (int tick = 0; tick < 1000; ++tick) trace.take(sample(tick, 0.0));
  for (int tick = 2500; tick < 2600; ++tick) trace.take(sample(tick, 0.0));
  const std::vector<ScopePoint> points = points_of(trace, kForce);
  EXPECT_DOUBLE_EQ(points.back().time_s, 2.58);
  EXPECT_GT(points.front().time_s, 0.58);
  EXPECT_LT(points.front().time_s, 0.6);
}

TEST(ScopeTrace, SamplesOfAnEarlierTimeBeginItAnew) {
  ScopeTrace trace({});
  for (int tick = 5000; tick < 6000; ++tick) trace.take(sample(tick, 1.0));
  trace.take(sample(100, 2.0));
  EXPECT_TRUE(points_of(trace, kForce).empty());
  trace.take(sample(110, 3.0));
  ASSERT_EQ(points_of(trace, kForce).size(), 1U);
  EXPECT_FLOAT_EQ(points_of(trace, kForce)[0].high, 2.0f);
}

TEST(ScopeTrace, WhatIsNotFiniteIsLeftOutOfItsChannelAlone) {
  ScopeTrace trace({});
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  trace.take(sample(0, kNan));
  trace.take(sample(1, 2.0));
  trace.take(sample(2, kInfinite));
  trace.take(sample(10, kNan));
  trace.take(sample(20, 0.0));
  const ScopePicture picture = trace.snapshot({kForce, "index_force_y_n"});
  ASSERT_EQ(picture.channels[0].size(), 2U);
  EXPECT_FLOAT_EQ(picture.channels[0][0].low, 2.0f);
  EXPECT_FLOAT_EQ(picture.channels[0][0].high, 2.0f);
  EXPECT_TRUE(std::isnan(picture.channels[0][1].low)) << "no number in the whole interval";
  EXPECT_FLOAT_EQ(picture.channels[1][1].low, 0.0f);
}

TEST(ScopeTrace, AnUnknownChannelIsEmptyAndKeepsItsPlace) {
  ScopeTrace trace({});
  for (int tick = 0; tick < 100; ++tick) trace.take(sample(tick, 1.0));
  const ScopePicture picture = trace.snapshot({"", kForce, "tick"});
  ASSERT_EQ(picture.channels.size(), 3U);
  EXPECT_TRUE(picture.channels[0].empty());
  EXPECT_FALSE(picture.channels[1].empty());
  EXPECT_TRUE(picture.channels[2].empty());
}

TEST(ScopeTrace, ALoopSlowerThanItsIntervalsGetsOneATick) {
  ScopeTrace trace({.rate_hz = 50.0, .duration_s = 1.0});
  for (int tick = 0; tick < 200; ++tick) trace.take(sample(tick, 0.0));
  EXPECT_EQ(points_of(trace, kForce).size(), 50U);
  EXPECT_DOUBLE_EQ(trace.snapshot({}).interval_s, 0.02);
}

TEST(ScopeTrace, ClearedItIsEmpty) {
  ScopeTrace trace({});
  for (int tick = 0; tick < 100; ++tick) trace.take(sample(tick, 0.0));
  trace.clear();
  EXPECT_TRUE(points_of(trace, kForce).empty());
}

TEST(ScopeTrace, APictureMayBeTakenWhileSamplesComeIn) {
  ScopeTrace trace({.duration_s = 0.5});
  std::atomic<bool> done{false};
  std::thread storage([&] {
    for (int tick = 0; tick < 20'000; ++tick) trace.take(sample(tick, 4.0));
    done = true;
  });
  while (!done) {
    for (const ScopePoint& point : points_of(trace, kForce)) {
      EXPECT_FLOAT_EQ(point.low, 4.0f) << "whole intervals alone";
    }
  }
  storage.join();
  EXPECT_EQ(points_of(trace, kForce).size(), 50U);
}

TEST(ScopeTrace, NamesTheParameterItRejects) {
  EXPECT_THROW(ScopeTrace({.rate_hz = 0.0}), core::Error);
  EXPECT_THROW(ScopeTrace({.duration_s = -1.0}), core::Error);
  EXPECT_THROW(ScopeTrace({.intervals_per_s = std::nan("")}), core::Error);
}

}  // namespace scope_trace_test
}  // namespace jnd::app
