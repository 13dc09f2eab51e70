#include <algorithm>

#include "app/operator/operated_session_fixture.h"
#include "core/storage/integrity.h"

namespace jnd::app {
namespace loose_point_test {

/// Tests a session whose device loses hold of the index finger for a while.
class LoosePointTest : public OperatedSessionTest {
 protected:
  /// Continues until the session's next step, 0.11 s after the device was opened. The finger is
  /// off between these times, by the device's clock.
  SessionView go_on_with_loose_index(double from_s, double to_s) {
    reopen({{.first_tick = std::llround(1000.0 * from_s),
             .num_ticks = std::llround(1000.0 * (to_s - from_s)),
             .injection = device::Injection::kDetachedPoint,
             .point = core::ContactPoint::kIndex}});
    return act(operate::Begin{"repeat"});
  }

  std::string last_event_of(const std::string& kind) const {
    std::string data;
    for (const core::EventRow& event : store_->events(session_number_)) {
      if (event.kind == kind) data = event.data;
    }
    return data;
  }
};

TEST_F(LoosePointTest, AMagnetThatLoosensInMidTrialPausesAndTheTrialIsRepeated) {
  open();
  run_to_block("comparison");
  const std::int64_t trial = go_on_with_loose_index(2.0, 4.0).trial->trial;
  act(operate::Present{trial, "reference"});
  pass(1.0);
  act(operate::Present{trial, "test"});
  EXPECT_EQ(view().step, Step::kPresenting);
  pass(1.0);

  const SessionView paused = view();
  EXPECT_EQ(paused.step, Step::kPaused);
  EXPECT_EQ(paused.loose_points, "the index finger");
  EXPECT_NE(paused.sentence.find("the index finger"), std::string::npos) << paused.sentence;
  const std::vector<std::string> before = kinds();
  EXPECT_EQ(before.at(before.size() - 2), "attempt_discarded");
  EXPECT_EQ(before.back(), "paused");
  EXPECT_NE(last_event_of("paused").find("came off: index"), std::string::npos);
  EXPECT_NE(last_event_of("attempt_discarded").find("came off: index"), std::string::npos);

  const SessionView refused = act(operate::GoOn{});
  EXPECT_EQ(refused.step, Step::kPaused);
  EXPECT_NE(refused.refusal.find("the index finger came off"), std::string::npos);
  EXPECT_EQ(kinds().size(), before.size()) << "nothing of a refusal is stored";

  pass(2.5);
  EXPECT_EQ(view().loose_points, "");
  EXPECT_EQ(view().step, Step::kPaused) << "it goes on when the operator says so";
  const SessionView again = act(operate::GoOn{});
  EXPECT_EQ(again.step, Step::kReady);
  expect_it_comes_later(trial);
}

TEST_F(LoosePointTest, NoForceIsGivenWhileTheSessionWaitsForTheFinger) {
  open();
  run_to_block("comparison");
  const std::int64_t trial = go_on_with_loose_index(2.0, 4.0).trial->trial;
  act(operate::Present{trial, "reference"});
  pass(1.5);
  EXPECT_NE(view().telemetry.total_force_n, core::PlainVector{});
  pass(1.0);
  EXPECT_EQ(view().step, Step::kPaused);
  EXPECT_EQ(view().telemetry.total_force_n, core::PlainVector{});
}

TEST_F(LoosePointTest, AFingerThatCameOffBetweenTrialsIsPutBackBeforeTheNext) {
  open();
  run_to_block("comparison");
  const SessionView ready = go_on_with_loose_index(3.0, 5.0);
  answer_trial(ready, 1.0);
  pass(1.0);
  EXPECT_EQ(view().step, Step::kReady) << "nothing is felt";
  const SessionView refused = act(operate::Present{ready.trial->trial + 1, "reference"});
  EXPECT_EQ(refused.step, Step::kReady);
  EXPECT_NE(refused.refusal.find("the index finger came off"), std::string::npos);
  pass(2.5);
  EXPECT_EQ(act(operate::Present{ready.trial->trial + 1, "reference"}).step, Step::kPresenting);
}

TEST_F(LoosePointTest, AMediumOutsideOfTrialsIsFeltAgain) {
  open();
  act(operate::Begin{});
  while (view().step != Step::kMedium) step_on(view());
  go_on_with_loose_index(1.0, 2.0);
  act(operate::FeelMedium{});
  pass(1.0);
  EXPECT_EQ(view().step, Step::kPaused);
  EXPECT_EQ(std::ranges::count(kinds(), "medium_explored"), 0);
  pass(1.5);
  EXPECT_EQ(act(operate::GoOn{}).step, Step::kMedium);
  act(operate::FeelMedium{});
  pass(0.5);
  act(operate::FinishMedium{});
  EXPECT_EQ(std::ranges::count(kinds(), "medium_explored"), 1);
}

TEST_F(LoosePointTest, APointThatNeverHeldIsNotWaitedFor) {
  open();
  run_to_block("comparison");
  const SessionView ready = go_on_with_loose_index(0.0, 1000.0);
  answer_trial(ready, 1.0);
  EXPECT_EQ(view().trial->trial, ready.trial->trial + 1);
  EXPECT_EQ(std::ranges::count(kinds(), "paused"), 0);
}

TEST_F(LoosePointTest, APointThatNeverHeldIsNamedBeforeSomethingIsFelt) {
  open();
  EXPECT_EQ(view().absent_points, "");
  run_to_block("comparison");
  const SessionView ready = go_on_with_loose_index(0.0, 1.0);
  EXPECT_EQ(ready.absent_points, "the index finger");
  EXPECT_EQ(ready.loose_points, "");
  pass(1.0);
  EXPECT_EQ(view().absent_points, "");
}

TEST_F(LoosePointTest, AMagnetThatComesOffAndHoldsAgainBetweenTwoGlancesIsNotMissed) {
  open();
  run_to_block("comparison");
  const std::int64_t trial = go_on_with_loose_index(1.002, 1.006).trial->trial;
  act(operate::Present{trial, "reference"});
  pass(1.0);
  const SessionView paused = view();
  EXPECT_EQ(paused.step, Step::kPaused);
  EXPECT_EQ(paused.loose_points, "");
  EXPECT_EQ(paused.came_off_points, "the index finger");
  EXPECT_NE(paused.sentence.find("holds again: the index finger"), std::string::npos)
      << paused.sentence;
  EXPECT_NE(last_event_of("attempt_discarded").find("came off: index"), std::string::npos);
  const SessionView again = act(operate::GoOn{});
  EXPECT_EQ(again.step, Step::kReady);
  EXPECT_EQ(again.came_off_points, "");
  expect_it_comes_later(trial);
}

TEST_F(LoosePointTest, APointCanBeLeftOffForAReasonWhichIsStored) {
  open();
  run_to_block("comparison");
  const std::int64_t trial = go_on_with_loose_index(1.0, 1000.0).trial->trial;
  act(operate::Present{trial, "reference"});
  pass(1.0);
  const SessionView paused = view();
  EXPECT_EQ(paused.step, Step::kPaused);
  const std::vector<std::string> before = kinds();
  EXPECT_NE(act(operate::GoOnWithout{paused.loose_bits, ""}).refusal, "");
  EXPECT_NE(act(operate::GoOnWithout{0b00001, "sore"}).refusal, "")
      << "not the points that were seen";
  EXPECT_EQ(kinds(), before);
  const SessionView ready = act(operate::GoOnWithout{paused.loose_bits, "sore"});
  EXPECT_EQ(ready.step, Step::kReady) << ready.refusal;
  EXPECT_EQ(ready.loose_points, "");
  EXPECT_EQ(ready.absent_points, "") << "nobody forgot it";
  EXPECT_EQ(ready.notes.back(), "goes on without the index finger: sore");
  EXPECT_EQ(kinds().back(), "continued");
  expect_it_comes_later(trial);
  EXPECT_EQ(std::ranges::count(kinds(), "paused"), 1);
}

TEST_F(LoosePointTest, APointCanBeLeftOffBetweenTwoTrials) {
  open();
  run_to_block("comparison");
  const SessionView first = go_on_with_loose_index(3.0, 1000.0);
  answer_trial(first, 1.0);
  pass(1.0);
  const SessionView ready = view();
  EXPECT_EQ(ready.loose_points, "the index finger");
  EXPECT_EQ(act(operate::GoOnWithout{ready.loose_bits, "sore"}).step, Step::kReady);
  EXPECT_EQ(act(operate::Present{ready.trial->trial, "reference"}).step, Step::kPresenting);
}

TEST_F(LoosePointTest, AnEmergencyStopComesBeforeALooseFinger) {
  open();
  run_to_block("comparison");
  const std::int64_t trial = go_on_with_loose_index(2.0, 3.0).trial->trial;
  act(operate::Present{trial, "reference"});
  pass(1.0);
  exchange_.emergency_stop.press();
  pass(1.5);
  EXPECT_EQ(view().step, Step::kFault);
  EXPECT_EQ(view().fault_name, "emergency_stop");
  pass(1.0);
  act(operate::ReleaseStop{exchange_.emergency_stop.num_presses()});
  pass(0.6);
  act(operate::Rearm{view().telemetry.num_faults});
  pass(1.0);
  EXPECT_EQ(view().step, Step::kReady);
}

}  // namespace loose_point_test
}  // namespace jnd::app
