#include "app/operator/operated_session_fixture.h"
#include "core/storage/integrity.h"

namespace jnd::app {
namespace pause_test {

class PauseTest : public OperatedSessionTest {
 protected:
  /// Begins a session up to the moment at which the reference of the first comparison is being
  /// felt.
  std::int64_t feel_reference() {
    open();
    const std::int64_t trial = run_to_block("comparison").trial->trial;
    act(operate::Present{trial, "reference"});
    pass(0.5);
    return trial;
  }
  std::vector<core::EventRow> events_of(const std::string& kind) const {
    std::vector<core::EventRow> all = store_->events(session_number_);
    std::erase_if(all, [&](const core::EventRow& event) { return event.kind != kind; });
    return all;
  }
};

TEST_F(PauseTest, APauseIsOnDiskBeforeAnybodySaysWhy) {
  const std::int64_t trial = feel_reference();
  const SessionView paused = act(operate::Pause{});
  EXPECT_EQ(paused.step, Step::kPaused);
  EXPECT_TRUE(paused.asks_why_paused);
  ASSERT_EQ(events_of("paused").size(), 1U);
  EXPECT_EQ(events_of("paused")[0].data, R"({"reason":""})");
  EXPECT_EQ(events_of("attempt_discarded").size(), 1U);
  pass(0.5);
  EXPECT_EQ(view().telemetry.total_force_n, core::PlainVector{}) << "the hand is let go";

  const SessionView told = act(operate::ExplainPause{"a cough"});
  EXPECT_EQ(told.refusal, "");
  EXPECT_FALSE(told.asks_why_paused);
  EXPECT_EQ(told.step, Step::kPaused);
  ASSERT_EQ(events_of("pause_explained").size(), 1U);
  EXPECT_EQ(events_of("pause_explained")[0].data,
            R"({"pause_sequence":)" + std::to_string(events_of("paused")[0].sequence) +
                R"(,"reason":"a cough"})");
  EXPECT_EQ(events_of("paused")[0].data, R"({"reason":""})") << "nothing is overwritten";
  EXPECT_EQ(act(operate::ExplainPause{"another"}).refusal, "no pause waits for its reason");
  EXPECT_EQ(act(operate::GoOn{}).trial->trial, trial);
}

TEST_F(PauseTest, ABlankReasonIsNone) {
  feel_reference();
  act(operate::Pause{});
  EXPECT_EQ(act(operate::ExplainPause{" "}).refusal, "expected a reason, found none");
  EXPECT_TRUE(view().asks_why_paused);
  act(operate::GoOn{});
  EXPECT_EQ(act(operate::EndEarly{" \t"}).refusal, "expected a reason, found none");
}

TEST_F(PauseTest, WhoseWindowWasKilledFindsThePauseWithoutAReason) {
  const std::int64_t trial = feel_reference();
  act(operate::Pause{});
  reopen();
  EXPECT_FALSE(act(operate::Begin{"repeat"}).asks_why_paused);
  EXPECT_EQ(view().trial->trial, trial);
  EXPECT_EQ(act(operate::ExplainPause{"too late"}).refusal, "no pause waits for its reason");
  EXPECT_EQ(events_of("paused")[0].data, R"({"reason":""})");
  EXPECT_TRUE(events_of("pause_explained").empty());
  session_.reset();
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

TEST_F(PauseTest, WhatAFaultStopsInAPauseCanStillBeExplained) {
  feel_reference();
  act(operate::Pause{});
  exchange_.emergency_stop.press();
  pass(0.1);
  ASSERT_EQ(view().step, Step::kFault);
  EXPECT_EQ(act(operate::ExplainPause{"a magnet slips"}).refusal, "");
  EXPECT_EQ(events_of("pause_explained").size(), 1U);
}

TEST_F(PauseTest, APauseWithItsReasonAsksForNone) {
  feel_reference();
  EXPECT_FALSE(act(operate::Pause{"lunch"}).asks_why_paused);
  EXPECT_EQ(act(operate::ExplainPause{"tea"}).refusal, "no pause waits for its reason");
}

}  // namespace pause_test
}  // namespace jnd::app
