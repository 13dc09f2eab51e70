#include "analysis/export/session_clock.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace jnd::analysis {
namespace session_clock_test {

constexpr double kRate_hz = 1000.0;

core::EventRow event(const std::string& kind, double day_s,
                     std::optional<std::int64_t> first_tick = {},
                     std::optional<std::int64_t> last_tick = {}) {
  return {.kind = kind,
          .time_ns = static_cast<std::int64_t>(day_s * 1e9),
          .first_tick = first_tick,
          .last_tick = last_tick};
}

core::Sample sample(std::int64_t tick, double monotonic_s) {
  return {.tick = tick, .monotonic_ns = static_cast<std::int64_t>(monotonic_s * 1e9)};
}

TEST(SessionClock, InSimulatedTimeTicksAreCountedAsEventsAre) {
  const std::vector<core::EventRow> events = {event("session_started", 0.0),
                                              event("presentation_started", 1.5, 1500),
                                              event("paused", 4.25)};
  SessionClock clock(events, kRate_hz);
  for (std::int64_t tick = 0; tick < 2000; ++tick) clock.take({.tick = tick});
  clock.finish();
  EXPECT_DOUBLE_EQ(clock.time_s(core::Sample{.tick = 1750}), 1.75);
  EXPECT_DOUBLE_EQ(clock.time_s(events[1]), 1.5);
  EXPECT_DOUBLE_EQ(clock.time_s(events[2]), 4.25);
}

TEST(SessionClock, EventsGetTheTimeOfTheirTickAndOthersThatOfTheDay) {
  const std::vector<core::EventRow> events = {
      event("session_started", 50'000.0), event("presentation_started", 50'010.0, 100),
      event("presentation_ended", 50'012.5, {}, 2100), event("paused", 50'020.0)};
  SessionClock clock(events, kRate_hz);
  for (std::int64_t tick = 0; tick < 3000; ++tick) {
    clock.take(sample(tick, 700.0 + 0.001 * static_cast<double>(tick)));
  }
  clock.finish();
  EXPECT_NEAR(clock.time_s(events[1]), 700.1, 1e-9);
  EXPECT_NEAR(clock.time_s(events[2]), 702.1, 1e-9);
  // By one event the day is 49309.9 s ahead, by the other 49310.4 s. The clock may use either.
  EXPECT_NEAR(clock.time_s(events[3]), 710.1, 0.6);
  EXPECT_NEAR(clock.time_s(sample(10, 700.01)), 700.01, 1e-9);
}

TEST(SessionClock, WhereAStreamWasOpenedTheDifferenceIsKnown) {
  core::EventRow opened = event("stream_opened", 50'001.0);
  opened.data = R"({"monotonic_s": 691.125})";
  const std::vector<core::EventRow> events = {event("session_started", 50'000.0), opened,
                                              event("presentation_started", 50'010.0, 5),
                                              event("paused", 50'020.0)};
  SessionClock clock(events, kRate_hz);
  clock.take(sample(5, 700.2));
  clock.finish();
  EXPECT_NEAR(clock.time_s(events[3]), 50'020.0 - 50'001.0 + 691.125, 1e-6);
}

/// The second part began after the machine had restarted, so its monotonic clock begins anew.
TEST(SessionClock, ASessionGoesOnWhereTheMachineWasStartedAnew) {
  const std::vector<core::EventRow> events = {
      event("session_started", 50'000.0), event("presentation_started", 50'010.0, 10),
      event("session_resumed", 60'000.0, 20, 99), event("presentation_started", 60'005.0, 200),
      event("paused", 60'010.0)};
  SessionClock clock(events, kRate_hz);
  clock.take(sample(10, 710.0));
  clock.take(sample(200, 35.0));
  clock.finish();
  EXPECT_NEAR(clock.time_s(events[1]), 710.0, 1e-9);
  EXPECT_NEAR(clock.time_s(events[3]), 710.0 + 9995.0, 1e-6);
  EXPECT_NEAR(clock.time_s(events[4]), 710.0 + 10'000.0, 1e-6);
  EXPECT_NEAR(clock.time_s(sample(200, 35.0)), 710.0 + 9995.0, 1e-6);
  EXPECT_NEAR(clock.time_s(sample(15, 710.005)), 710.005, 1e-9);
  EXPECT_NEAR(clock.shift_s(events[3].time_ns), 10'670.0, 1e-6);
  EXPECT_EQ(clock.shift_s(events[1].time_ns), 0.0);
}

TEST(SessionClock, WithoutAnyTickTheDayIsTheClock) {
  const std::vector<core::EventRow> events = {event("session_started", 50'000.0)};
  SessionClock clock(events, kRate_hz);
  clock.finish();
  EXPECT_DOUBLE_EQ(clock.time_s(events[0]), 50'000.0);
}

}  // namespace session_clock_test
}  // namespace jnd::analysis
