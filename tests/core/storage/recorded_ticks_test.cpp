#include "core/storage/recorded_ticks.h"

#include <gtest/gtest.h>

namespace jnd::core {
namespace recorded_ticks_test {

using Ranges = std::vector<TickRange>;

TEST(RecordedTicks, RangesThatTouchBecomeOne) {
  EXPECT_EQ(merged({{10, 19}, {0, 4}, {5, 9}, {30, 39}, {32, 33}, {50, 49}}),
            (Ranges{{0, 19}, {30, 39}}));
  EXPECT_EQ(merged({}), Ranges{});
}

TEST(RecordedTicks, WhatIsMissingIsFoundBeforeBetweenAndAfter) {
  const Ranges recorded = {{10, 19}, {30, 39}};
  EXPECT_EQ(missing_in(recorded, {0, 49}), (Ranges{{0, 9}, {20, 29}, {40, 49}}));
  EXPECT_EQ(missing_in(recorded, {12, 32}), (Ranges{{20, 29}}));
  EXPECT_EQ(missing_in(recorded, {10, 19}), Ranges{});
  EXPECT_EQ(missing_in({}, {3, 5}), (Ranges{{3, 5}}));
  EXPECT_EQ(num_ticks(missing_in(recorded, {0, 49})), 30);
}

TEST(RecordedTicks, ExploredMediaAndEndedPresentationsSpeakOfTicks) {
  const std::vector<EventRow> events = {
      {.kind = "medium_explored", .first_tick = 0, .last_tick = 9},
      {.kind = "presentation_started", .trial = 1, .first_tick = 20},
      {.kind = "presentation_ended", .trial = 1, .last_tick = 29},
      {.kind = "session_resumed", .first_tick = 30, .last_tick = 34},
      {.kind = "medium_explored"}};
  const std::vector<TickClaim> claims = tick_claims(events);
  ASSERT_EQ(claims.size(), 2U);
  EXPECT_EQ(claims[0].ticks, (TickRange{0, 9}));
  EXPECT_EQ(claims[1].ticks, (TickRange{20, 29}));
  EXPECT_EQ(claims[1].kind, "presentation_ended");
  EXPECT_EQ(claims[1].trial, 1);
}

}  // namespace recorded_ticks_test
}  // namespace jnd::core
