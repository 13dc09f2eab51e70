#include "core/markers/marker_kind.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace jnd::core {
namespace marker_kind_test {

EventRow event_of_kind(const std::string& kind) {
  EventRow event;
  event.session = 3;
  event.sequence = 17;
  event.kind = kind;
  return event;
}

TEST(MarkerKind, FollowsFromTheKindOfAnEvent) {
  EXPECT_EQ(marker_kind_of(event_of_kind("stage_entered")), MarkerKind::kStage);
  EXPECT_EQ(marker_kind_of(event_of_kind("trial_started")), MarkerKind::kTrial);
  EXPECT_EQ(marker_kind_of(event_of_kind("presentation_started")), MarkerKind::kPresentation);
  EXPECT_EQ(marker_kind_of(event_of_kind("trial_answered")), MarkerKind::kAnswer);
  EXPECT_EQ(marker_kind_of(event_of_kind("fault_raised")), MarkerKind::kFault);
  for (const char* none : {"presentation_ended", "trials_drawn", "note_added", "unblinded",
                           "session_completed", "markers_sent", ""}) {
    EXPECT_FALSE(marker_kind_of(event_of_kind(none))) << none;
  }
}

// A recorder sees the same, whatever was presented or answered.
TEST(MarkerKind, TellsNothingOfALevel) {
  EventRow one = event_of_kind("presentation_started"), other = one;
  one.intensity = 1.0;
  one.stage = 2;
  one.data = R"({"interval":"test","presentation":1})";
  other.intensity = 1.9;
  other.stage = 5;
  other.data = R"({"interval":"reference","presentation":2})";
  EXPECT_EQ(marker_kind_of(one), marker_kind_of(other));
}

TEST(MarkerKind, HasABitOfItsOwnUnlessAStudySaysOtherwise) {
  int all = 0;
  for (const int code : MarkerCodes{}.codes) {
    EXPECT_EQ(code & (code - 1), 0) << code;
    EXPECT_EQ(all & code, 0) << code;
    all |= code;
  }
  EXPECT_LE(all, 255);
  EXPECT_EQ(MarkerCodes{}.of(MarkerKind::kEnd), 32);
}

}  // namespace marker_kind_test
}  // namespace jnd::core
