#include "core/safety/staleness.h"

#include <gtest/gtest.h>

namespace jnd::core {
namespace staleness_test {

constexpr double kPeriod_s = 0.001;
constexpr std::int64_t kMaxTicks = 5;

HapticState moving_at(double speed_m_per_s) {
  HapticState state;
  for (Eigen::Vector3d& velocity : state.tip_velocity_m_per_s) velocity.x() = speed_m_per_s;
  return state;
}

/// Observes the same positions again and again. Returns the first stale tick, counted from 1,
/// or 0 if none of `num_ticks` is stale.
int stale_at(Staleness& staleness, const HapticState& state, double elapsed_s,
             int num_ticks = 1000, std::int64_t num_missed = 0) {
  for (int tick = 1; tick <= num_ticks; ++tick) {
    staleness.observe(state, state, elapsed_s, num_missed);
    if (staleness.is_stale()) return tick;
  }
  return 0;
}

TEST(Staleness, AClockThatStandsIsExcusedForItsTicksAndNoLonger) {
  Staleness staleness(kMaxTicks, kPeriod_s);
  EXPECT_DOUBLE_EQ(staleness.longest_s(), 0.006);
  EXPECT_EQ(stale_at(staleness, {}, 0.0), 6);
  staleness.observe({}, {}, kPeriod_s, 0);
  EXPECT_FALSE(staleness.is_stale()) << "the clock goes on";
  EXPECT_EQ(stale_at(staleness, {}, -1.0), 6) << "backwards is no better";
}

TEST(Staleness, AHandAtRestStandsForEver) {
  Staleness staleness(kMaxTicks, kPeriod_s);
  EXPECT_EQ(stale_at(staleness, moving_at(0.0), kPeriod_s), 0);
  EXPECT_EQ(stale_at(staleness, moving_at(0.04), kPeriod_s), 0) << "a filter that rings";
}

TEST(Staleness, AVelocityThatLeadsNowhereIsFoundAfterThreeMillimetres) {
  Staleness slow(kMaxTicks, kPeriod_s);
  // The way is 2.8 mm after 10 ticks and 3.08 mm after 11.
  EXPECT_EQ(stale_at(slow, moving_at(0.28), kPeriod_s), 11);
  Staleness fast(kMaxTicks, kPeriod_s);
  EXPECT_EQ(stale_at(fast, moving_at(2.0), kPeriod_s), 6) << "but never before its ticks";
}

TEST(Staleness, AWayThatIsMovedOrAPointThatIsLooseForgetsIt) {
  Staleness staleness(kMaxTicks, kPeriod_s);
  const HapticState state = moving_at(0.28);
  EXPECT_EQ(stale_at(staleness, state, kPeriod_s, 10), 0);
  HapticState moved = state;
  for (Eigen::Vector3d& tip : moved.tip_position_m) tip.x() += 1e-6;
  staleness.observe(moved, state, kPeriod_s, 0);
  EXPECT_EQ(stale_at(staleness, moved, kPeriod_s, 10), 0);
  staleness.reset();
  EXPECT_EQ(stale_at(staleness, moved, kPeriod_s, 10), 0);
  HapticState loose = moving_at(2.0);
  loose.attached.fill(false);
  EXPECT_EQ(stale_at(staleness, loose, kPeriod_s), 0);
}

TEST(Staleness, AClockThatLeapsAddsNoMoreThanAMeasurementMayStandIn) {
  Staleness staleness(kMaxTicks, kPeriod_s);
  // A tick counts at most 6 ms, so at 0.06 m/s the 3 mm are passed at the ninth tick, whatever
  // the clock says.
  EXPECT_EQ(stale_at(staleness, moving_at(0.06), 10.0), 9);
}

TEST(Staleness, TheLoopsOwnMissedTicksAreTold) {
  Staleness staleness(kMaxTicks, kPeriod_s);
  staleness.observe({}, {}, kPeriod_s, 7);
  EXPECT_FALSE(staleness.may_be_the_loops()) << "before anything stood still";
  EXPECT_EQ(stale_at(staleness, {}, 0.0, 6, 1), 6);
  EXPECT_TRUE(staleness.may_be_the_loops());
  staleness.observe({}, {}, kPeriod_s, 0);
  EXPECT_FALSE(staleness.may_be_the_loops());
}

}  // namespace staleness_test
}  // namespace jnd::core
