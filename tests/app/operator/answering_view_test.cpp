#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/answering_study.h"
#include "app/operator/operated_session_fixture.h"

// Tests what the operator sees and can do if answers have a deadline, stimuli have times, going
// back is limited, and "cannot tell" is an answer.

namespace jnd::app {
namespace answering_view_test {

class AnsweringViewTest : public OperatedSessionTest {
 protected:
  SessionView begin(const std::string& study = kAnsweringStudy) {
    open(study);
    act(operate::Begin{});
    pass(0.1);
    return view();
  }
  std::int64_t trial() { return view().trial->trial; }
  SessionView show(const std::string& interval) {
    return act(operate::Present{trial(), interval});
  }
  /// Presents the reference for as long as it has to be felt, and then the test for `test_s`
  /// seconds.
  SessionView feel(double test_s) {
    show("reference");
    pass(1.1);
    show("test");
    pass(test_s);
    return view();
  }
  std::vector<core::EventRow> events(const std::string& kind) {
    std::vector<core::EventRow> found;
    for (const core::EventRow& event : store_->events(session_number_)) {
      if (event.kind == kind) found.push_back(event);
    }
    return found;
  }
  double force_n() const {
    const core::PlainVector& force = view().telemetry.total_force_n;
    return std::hypot(force[0], force[1], force[2]);
  }
};

TEST_F(AnsweringViewTest, NobodyGoesOnBeforeTheLeastTimeAndIsToldHowLongItTakes) {
  begin();
  SessionView now = show("reference");
  pass(0.5);
  now = view();
  EXPECT_NEAR(now.trial->least_left_s, 0.5, 0.05);
  EXPECT_TRUE(show("test").refusal.starts_with("it has to be felt for 0.")) << view().refusal;
  EXPECT_TRUE(show("free_space").refusal.starts_with("it has to be felt for"));
  EXPECT_EQ(view().trial->interval, "reference");
  pass(0.6);
  EXPECT_EQ(view().trial->least_left_s, 0.0);
  now = show("test");
  EXPECT_EQ(now.refusal, "");
  EXPECT_EQ(now.trial->interval, "test");
  pass(0.1);  // The ramp takes this time.
  EXPECT_TRUE(act(operate::Answer{trial(), 1.0}).refusal.starts_with("it has to be felt for"));
  EXPECT_TRUE(store_->trials(session_number_).empty());
  pass(1.0);
  EXPECT_EQ(act(operate::Answer{trial(), 1.0}).refusal, "");
  EXPECT_EQ(store_->trials(session_number_).size(), 1U);
}

TEST_F(AnsweringViewTest, APauseDoesNotWaitForTheLeastTime) {
  begin();
  show("reference");
  pass(0.1);
  EXPECT_EQ(act(operate::Pause{""}).step, Step::kPaused);
}

TEST_F(AnsweringViewTest, AStimulusEndsByItselfAndItsQuestionCanStillBeAnswered) {
  begin();
  SessionView now = feel(1.9);
  EXPECT_EQ(now.trial->interval, "test");
  EXPECT_FALSE(now.trial->stimulus_is_over);
  pass(0.2);
  now = view();
  EXPECT_TRUE(now.trial->stimulus_is_over);
  EXPECT_EQ(now.step, Step::kPresenting);
  EXPECT_EQ(now.heading, "The stimulus is over");
  EXPECT_EQ(now.sentence, "Ask:");
  EXPECT_EQ(now.say, "Thicker?");
  EXPECT_NEAR(now.trial->felt_s, 2.0, 0.02);
  EXPECT_TRUE(now.trial->can_answer);
  EXPECT_EQ(events("presentation_ended").size(), 2U) << "it is on disk";
  pass(0.2);
  EXPECT_EQ(force_n(), 0.0);
  now = act(operate::Answer{trial(), 0.0});
  EXPECT_EQ(now.refusal, "");
  const core::TrialRow row = store_->trials(session_number_).back();
  EXPECT_EQ(row.response, 0.0);
  EXPECT_NEAR(row.measures.response_time_s.value(), 2.3, 0.03) << "from its start";
  EXPECT_EQ(row.num_presentations, 2);
}

TEST_F(AnsweringViewTest, AfterAReferenceThatEndedByItselfComesTheTest) {
  begin();
  show("reference");
  pass(2.1);
  const SessionView now = view();
  EXPECT_TRUE(now.trial->stimulus_is_over);
  EXPECT_FALSE(now.trial->can_answer);
  EXPECT_EQ(now.participant_text, "");
  EXPECT_EQ(now.sentence,
            "When the participant is ready, show one finger and present the test.");
  EXPECT_EQ(now.trial->deadline_left_s, std::nullopt) << "nothing is asked yet";
  EXPECT_EQ(act(operate::Answer{trial(), 1.0}).refusal, "the test has not been felt yet");
  EXPECT_EQ(show("test").trial->interval, "test");
  EXPECT_NEAR(view().trial->first_felt_s.value(), 2.0, 0.02);
}

TEST_F(AnsweringViewTest, WithoutAnAnswerTheTrialIsMissedAtTheDeadlineAndToldSo) {
  begin();
  const std::int64_t missed = trial();
  SessionView now = feel(1.5);
  EXPECT_NEAR(now.trial->deadline_left_s.value(), 1.5, 0.05);
  pass(1.4);
  EXPECT_EQ(trial(), missed);
  pass(0.2);
  now = view();
  EXPECT_TRUE(now.missed_deadline);
  EXPECT_EQ(now.step, Step::kReady);
  EXPECT_NE(now.trial->trial, missed);
  EXPECT_EQ(now.say.substr(0, now.say.find('.')), "The time to answer was over");
  EXPECT_EQ(now.refusal, "") << "nobody asked for anything";
  ASSERT_EQ(events("attempt_discarded").size(), 1U);
  EXPECT_NE(events("attempt_discarded")[0].data.find("missed_deadline"), std::string::npos);
  show("reference");
  EXPECT_FALSE(view().missed_deadline) << "until the next trial begins";
  act(operate::Pause{""});
  act(operate::GoOn{});
  while (view().step == Step::kReady || view().step == Step::kRest) {
    if (study_stage_name(view().stage) != "open") break;
    feel(1.1);
    act(operate::Answer{trial(), 1.0});
  }
  const std::vector<core::TrialRow> rows = store_->trials(session_number_);
  EXPECT_EQ(rows.size(), 6U);
  const auto found = std::ranges::find(rows, missed, &core::TrialRow::trial);
  ASSERT_NE(found, rows.end());
  EXPECT_EQ(found->attempt, 2);
}

TEST_F(AnsweringViewTest, TheDeadlineHoldsWhileTheHandIsInFreeSpaceAndWhileSomebodyGoesBack) {
  begin();
  const std::int64_t missed = trial();
  feel(1.1);
  show("reference");
  pass(1.1);
  show("free_space");
  pass(0.9);
  EXPECT_NE(trial(), missed) << "3 s after the test began";
}

TEST_F(AnsweringViewTest, AnAnswerThatComesTooLateIsKeptInTheLogAndDoesNotCount) {
  begin();
  const std::int64_t late = trial();
  feel(1.5);
  session_->request(operate::Answer{late, 1.0});
  session_->advance(1.6);  // The jump imitates a disk that takes its time.
  EXPECT_EQ(view().refusal, "that was too late, and the trial comes again");
  EXPECT_TRUE(store_->trials(session_number_).empty());
  ASSERT_EQ(events("attempt_discarded").size(), 1U);
  EXPECT_NE(events("attempt_discarded")[0].data.find(
                "no answer within the deadline of 3 s; the answer was 1"),
            std::string::npos)
      << events("attempt_discarded")[0].data;
  EXPECT_TRUE(view().missed_deadline);
}

TEST_F(AnsweringViewTest, CannotTellIsStoredShownAndCorrected) {
  begin();
  SessionView now = feel(1.1);
  EXPECT_TRUE(now.trial->takes_cannot_tell);
  const std::int64_t number = now.trial->trial;
  now = act(operate::Answer{number, std::nullopt});
  EXPECT_EQ(now.refusal, "");
  EXPECT_EQ(now.answers.front().answer, "cannot tell");
  EXPECT_TRUE(now.answers.front().form.takes_cannot_tell);
  EXPECT_EQ(now.trials_on_disk, 1);
  EXPECT_EQ(now.trial->in_block, 2);
  EXPECT_EQ(store_->trials(session_number_).back().response, std::nullopt);
  now = act(operate::Correct{number, 1.0, "said yes"});
  EXPECT_EQ(now.answers.front().answer, "yes");
  now = act(operate::Correct{number, std::nullopt, "did not"});
  EXPECT_EQ(now.answers.front().answer, "cannot tell");
}

TEST_F(AnsweringViewTest, WithoutTheKeyCannotTellIsRefused) {
  begin(replaced(kAnsweringStudy, R"("cannot_tell": true, )", ""));
  feel(1.1);
  EXPECT_FALSE(view().trial->takes_cannot_tell);
  EXPECT_NE(act(operate::Answer{trial(), std::nullopt}).refusal, "");
  EXPECT_TRUE(store_->trials(session_number_).empty());
}

TEST_F(AnsweringViewTest, WhereNobodyMayGoBackEachIntervalComesOnce) {
  begin(replaced(kAnsweringStudy, R"("cannot_tell": true, )", R"("max_returns": 1, )"));
  feel(1.1);
  EXPECT_TRUE(view().trial->closed_intervals.empty()) << "one return is left";
  EXPECT_EQ(show("reference").refusal, "");
  pass(1.1);
  EXPECT_EQ(view().trial->closed_intervals, (std::vector<std::string>{"reference", "test"}));
  EXPECT_EQ(show("test").refusal, "this trial allows no more going back");
  EXPECT_EQ(view().trial->interval, "reference");
  EXPECT_EQ(act(operate::Answer{trial(), 1.0}).refusal, "");
}

TEST_F(AnsweringViewTest, ASessionLeftWhileAStimulusWasOverGoesOnWithItsTrial) {
  begin();
  const std::int64_t number = trial();
  feel(2.1);
  ASSERT_TRUE(view().trial->stimulus_is_over);
  reopen();
  act(operate::Begin{});
  pass(0.1);
  EXPECT_EQ(trial(), number);
  EXPECT_EQ(view().step, Step::kReady);
}

}  // namespace answering_view_test
}  // namespace jnd::app
