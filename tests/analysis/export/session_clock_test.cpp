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

/// Of one session, in this order.
std::vector<core::EventRow> numbered(std::vector<core::EventRow> events) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    events[i].sequence = static_cast<std::int64_t>(i) + 1;
  }
  return events;
}

TEST(SessionClock, InSimulatedTimeTicksAreCountedAsEventsAre) {
  const std::vector<core::EventRow> events =
      numbered({event("session_started", 0.0), event("presentation_started", 1.5, 1500),
                event("paused", 4.25)});
  SessionClock clock(events, kRate_hz);
  for (std::int64_t tick = 0; tick < 2000; ++tick) clock.take({.tick = tick});
  clock.finish();
  EXPECT_DOUBLE_EQ(clock.time_s(core::Sample{.tick = 1750}), 1.75);
  EXPECT_DOUBLE_EQ(clock.time_s(events[1]), 1.5);
  EXPECT_DOUBLE_EQ(clock.time_s(events[2]), 4.25);
}

TEST(SessionClock, EventsGetTheTimeOfTheirTickAndOthersThatOfTheDay) {
  const std::vector<core::EventRow> events = numbered(
      {event("session_started", 50'000.0), event("presentation_started", 50'010.0, 100),
       event("presentation_ended", 50'012.5, {}, 2100), event("paused", 50'020.0)});
  SessionClock clock(events, kRate_hz);
  for (std::int64_t tick = 0; tick < 3000; ++tick) {
    clock.take(sample(tick, 700.0 + 0.001 * static_cast<double>(tick)));
  }
  clock.finish();
  EXPECT_NEAR(clock.time_s(events[1]), 700.1, 1e-9);
  EXPECT_NEAR(clock.time_s(events[2]), 702.1, 1e-9);
  // According to the two events, the clock of the day is 49309.9 or 49310.4 s ahead. Either may
  // be used.
  EXPECT_NEAR(clock.time_s(events[3]), 710.1, 0.6);
  EXPECT_NEAR(clock.time_s(sample(10, 700.01)), 700.01, 1e-9);
}

TEST(SessionClock, WhereAStreamWasOpenedTheDifferenceIsKnown) {
  core::EventRow opened = event("stream_opened", 50'001.0);
  opened.data = R"({"monotonic_s": 691.125})";
  const std::vector<core::EventRow> events =
      numbered({event("session_started", 50'000.0), opened,
                event("presentation_started", 50'010.0, 5), event("paused", 50'020.0)});
  SessionClock clock(events, kRate_hz);
  clock.take(sample(5, 700.2));
  clock.finish();
  EXPECT_NEAR(clock.time_s(events[3]), 50'020.0 - 50'001.0 + 691.125, 1e-6);
}

/// The second part began after the machine was restarted, so its monotonic clock is another
/// one.
TEST(SessionClock, ASessionGoesOnWhereTheMachineWasStartedAnew) {
  const std::vector<core::EventRow> events =
      numbered({event("session_started", 50'000.0), event("presentation_started", 50'010.0, 10),
                event("session_resumed", 60'000.0, 20, 99),
                event("presentation_started", 60'005.0, 200), event("paused", 60'010.0)});
  SessionClock clock(events, kRate_hz);
  clock.take(sample(10, 710.0));
  clock.take(sample(200, 35.0));
  clock.finish();
  EXPECT_NEAR(clock.time_s(events[1]), 710.0, 1e-9);
  EXPECT_NEAR(clock.time_s(events[3]), 710.0 + 9995.0, 1e-6);
  EXPECT_NEAR(clock.time_s(events[4]), 710.0 + 10'000.0, 1e-6);
  EXPECT_NEAR(clock.time_s(sample(200, 35.0)), 710.0 + 9995.0, 1e-6);
  EXPECT_NEAR(clock.time_s(sample(15, 710.005)), 710.005, 1e-9);
  EXPECT_NEAR(clock.shift_s(events[3]), 10'670.0, 1e-6);
  EXPECT_EQ(clock.shift_s(events[1]), 0.0);
}

TEST(SessionClock, WithoutAnyTickTheDayIsTheClock) {
  const std::vector<core::EventRow> events = numbered({event("session_started", 50'000.0)});
  SessionClock clock(events, kRate_hz);
  clock.finish();
  EXPECT_DOUBLE_EQ(clock.time_s(events[0]), 50'000.0);
}

TEST(SessionClock, ADayThatIsSetBackWithinAPartReordersNoEvent) {
  // After the first stimulus the clock of the day goes back by an hour.
  const std::vector<core::EventRow> events =
      numbered({event("session_started", 50'000.0), event("presentation_started", 50'010.0, 0),
                event("presentation_ended", 50'012.0, {}, 2000), event("note_added", 46'414.0),
                event("presentation_started", 46'420.0, 10'000),
                event("presentation_ended", 46'422.0, {}, 12'000),
                event("note_added", 46'425.0), event("session_completed", 46'430.0)});
  SessionClock clock(events, kRate_hz);
  for (std::int64_t tick = 0; tick <= 12'000; ++tick) {
    clock.take(sample(tick, 700.0 + 0.001 * static_cast<double>(tick)));
  }
  clock.finish();
  for (std::size_t i = 1; i < events.size(); ++i) {
    EXPECT_LE(clock.time_s(events[i - 1]), clock.time_s(events[i])) << i;
  }
  EXPECT_NEAR(clock.time_s(events[7]), 720.0, 0.01) << "by the clock as it was set";
}

TEST(SessionClock, ADayThatIsSetBackBetweenTwoVisitsReordersNoSample) {
  // The machine went on, and its day was set back by an hour before the session was resumed.
  const std::vector<core::EventRow> events =
      numbered({event("session_started", 50'000.0), event("presentation_started", 50'010.0, 10),
                event("session_resumed", 46'500.0, 20, 99),
                event("presentation_started", 46'510.0, 200), event("note_added", 46'512.0)});
  SessionClock clock(events, kRate_hz);
  clock.take(sample(10, 710.0));
  clock.take(sample(200, 810.0));
  clock.finish();
  EXPECT_NEAR(clock.time_s(sample(200, 810.0)), 810.0, 1e-9) << "the machine's clock went on";
  EXPECT_NEAR(clock.time_s(events[3]), 810.0, 1e-9);
  EXPECT_NEAR(clock.time_s(events[4]), 812.0, 1e-6);
  EXPECT_EQ(clock.shift_s(events[3]), 0.0);
}

TEST(SessionClock, APartOfAnotherStartOfTheMachineNeverBeginsBeforeTheEndOfTheOneBefore) {
  // Started anew, and its day an hour behind.
  const std::vector<core::EventRow> events =
      numbered({event("session_started", 50'000.0), event("presentation_started", 50'010.0, 10),
                event("session_resumed", 46'500.0, 20, 99),
                event("presentation_started", 46'510.0, 200)});
  SessionClock clock(events, kRate_hz);
  clock.take(sample(10, 710.0));
  clock.take(sample(200, 35.0));
  clock.finish();
  EXPECT_GT(clock.time_s(sample(200, 35.0)), clock.time_s(sample(10, 710.0)));
  EXPECT_GT(clock.time_s(events[3]), clock.time_s(events[1]));
}

}  // namespace session_clock_test
}  // namespace jnd::analysis
