#include <gtest/gtest.h>

#include <string>

#include "app/operator/realtime_session_fixture.h"

namespace jnd::app {
namespace missed_ticks_test {

/// The device delays the loop by a twentieth of a second, again and again.
TEST_F(RealtimeSessionTest, AnAnswerToWhatWasNotFeltInTimeIsKeptAndDoesNotCount) {
  may_miss_ticks_ = false;
  open_window();
  open();
  std::vector<device::ScheduledFault> stalls;
  for (std::int64_t tick = 200; tick < 100'000; tick += 200) {
    stalls.push_back(
        {.first_tick = tick, .injection = device::Injection::kStall, .magnitude = 0.05});
  }
  reopen(stalls);
  session_->request(operate::Begin{});
  const auto walk = [&](const SessionView& now) {
    if (now.step == Step::kItem) {
      session_->request(operate::AnswerItem{now.stage, now.item->name, "1.8"});
    } else if (now.step == Step::kMedium) {
      session_->request(operate::FeelMedium{});
    } else if (now.step == Step::kFeeling) {
      session_->request(operate::FinishMedium{});
    } else if (now.step == Step::kStageDone) {
      session_->request(operate::FinishStage{now.stage, ""});
    }
    return now.step == Step::kReady;
  };
  const std::int64_t trial = until(walk).trial->trial;
  session_->request(operate::Present{trial, "test"});
  until([](const SessionView& now) { return now.trial && now.trial->felt_s > 0.6; });
  session_->request(operate::Answer{trial, 100.0});
  const SessionView refused =
      until([](const SessionView& now) { return now.num_refusals > 0; });
  EXPECT_NE(refused.refusal.find("the trial comes again later"), std::string::npos)
      << refused.refusal;
  EXPECT_TRUE(store_->trials(session_number_).empty());
  const core::EventRow last = store_->events(session_number_).back();
  EXPECT_EQ(last.kind, "attempt_discarded");
  EXPECT_NE(last.data.find("missed ticks: "), std::string::npos) << last.data;
  EXPECT_NE(last.data.find("the answer was 100"), std::string::npos) << last.data;
}

}  // namespace missed_ticks_test
}  // namespace jnd::app
