#include <nlohmann/json.hpp>

#include "app/operator/operated_session_fixture.h"
#include "core/storage/integrity.h"

namespace jnd::app {
namespace doubted_answer_test {

/// Tests answers about which the program asks before it stores them.
class DoubtedAnswerTest : public OperatedSessionTest {
 protected:
  DoubtedAnswerTest() { asks_about_answers_ = true; }

  /// Presents the stimulus of an estimation for this time. Returns the trial.
  std::int64_t feel(double duration_s) {
    const std::int64_t trial = view().trial->trial;
    act(operate::Present{trial, "test"});
    pass(duration_s);
    return trial;
  }
  void begin_estimation() {
    open();
    ASSERT_EQ(run_to_block("estimation").step, Step::kReady);
  }
  std::vector<std::string> texts_of(const std::string& kind, const std::string& key) const {
    std::vector<std::string> all;
    for (const core::EventRow& event : store_->events(session_number_)) {
      if (event.kind != kind) continue;
      all.push_back(nlohmann::json::parse(event.data).at(key).get<std::string>());
    }
    return all;
  }
};

TEST_F(DoubtedAnswerTest, AMagnitudeThatIsMistypedIsNotStoredBeforeItIsConfirmed) {
  begin_estimation();
  const std::int64_t trial = feel(10.0);
  const SessionView asked = act(operate::Answer{trial, 99999.0});
  ASSERT_TRUE(asked.doubt);
  EXPECT_EQ(asked.doubt->trial, trial);
  EXPECT_EQ(asked.doubt->sentence, "The answer is 99999 %: more than 1000 %.");
  EXPECT_EQ(asked.step, Step::kPresenting) << "it is felt on";
  EXPECT_TRUE(store_->trials(session_number_).empty());
  EXPECT_EQ(act(operate::Answer{trial, 100.0}).refusal,
            "the answer before waits to be confirmed");

  pass(3.0);
  const SessionView stored = act(operate::StoreDoubted{trial});
  EXPECT_FALSE(stored.doubt);
  EXPECT_EQ(stored.trial->trial, trial + 1);
  const core::TrialRow row = store_->trials(session_number_).back();
  EXPECT_EQ(row.response, 99999.0);
  EXPECT_NEAR(row.measures.response_time_s.value(), 10.0, 0.1)
      << "the time of the answer, not of its confirmation";
  EXPECT_EQ(texts_of("note_added", "text"),
            std::vector<std::string>{"asked about the answer 99999 to trial " +
                                     std::to_string(trial) + " (more than 1000 %): stored"});
  session_.reset();
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

TEST_F(DoubtedAnswerTest, WhoGoesBackAnswersAgainAndTheLogSaysSo) {
  begin_estimation();
  const std::int64_t trial = feel(10.0);
  act(operate::Answer{trial, 99999.0});
  const SessionView back = act(operate::GoBack{trial});
  EXPECT_FALSE(back.doubt);
  EXPECT_EQ(back.trial->trial, trial);
  EXPECT_EQ(texts_of("note_added", "text").back(),
            "asked about the answer 99999 to trial " + std::to_string(trial) +
                " (more than 1000 %): not stored, the trial went on");
  EXPECT_EQ(act(operate::StoreDoubted{trial}).refusal, "no answer waits to be confirmed");
  EXPECT_EQ(act(operate::Answer{trial, 100.0}).trial->trial, trial + 1);
  EXPECT_EQ(store_->trials(session_number_).back().response, 100.0);

  const std::int64_t next = feel(10.0);
  const SessionView asked = act(operate::Answer{next, 4.0});
  ASSERT_TRUE(asked.doubt);
  EXPECT_EQ(asked.doubt->sentence, "The answer is 4 %: 1/25 of the last answer.");
}

TEST_F(DoubtedAnswerTest, AnAnswerToNothingThatWasFeltIsAskedAbout) {
  begin_estimation();
  const std::int64_t trial = feel(0.3);
  const SessionView asked = act(operate::Answer{trial, 100.0});
  ASSERT_TRUE(asked.doubt);
  EXPECT_EQ(asked.doubt->sentence,
            "The answer is 100 %: 0.3 s after the stimulus began; no stroke in the test.");
  act(operate::GoBack{trial});
  pass(10.0);
  EXPECT_FALSE(act(operate::Answer{trial, 100.0}).doubt) << "now it was";
}

TEST_F(DoubtedAnswerTest, WhatIsPausedOrStoppedMeanwhileIsToldWithTheAnswer) {
  begin_estimation();
  std::int64_t trial = feel(10.0);
  act(operate::Answer{trial, 5000.0});
  EXPECT_FALSE(act(operate::Pause{"a cough"}).doubt);
  EXPECT_EQ(texts_of("attempt_discarded", "reason").back(), "paused; the answer was 5000");
  EXPECT_FALSE(act(operate::GoOn{}).doubt) << "another attempt";
  trial = feel(10.0);
  act(operate::Answer{trial, 6000.0});
  exchange_.emergency_stop.press();
  pass(0.1);
  EXPECT_FALSE(view().doubt);
  EXPECT_EQ(texts_of("attempt_discarded", "reason").back(),
            "fault: emergency_stop; the answer was 6000");
  EXPECT_TRUE(store_->trials(session_number_).empty());
}

TEST_F(DoubtedAnswerTest, AnAnswerInTimeIsNotMissedWhileItIsAskedAbout) {
  open(replaced(
      kTinyStudy,
      "\"repetitions\": 2, \"free_space_between_s\": 0,\n     "
      "\"instruction\": {\"en\": \"Say.\"}",
      "\"repetitions\": 2, \"free_space_between_s\": 0, \"answer_deadline_s\": 12,\n   "
      "  \"instruction\": {\"en\": \"Say.\"}"));
  ASSERT_EQ(run_to_block("estimation").step, Step::kReady);
  const std::int64_t trial = feel(10.0);
  act(operate::Answer{trial, 5000.0});
  pass(5.0);
  EXPECT_TRUE(view().doubt);
  act(operate::StoreDoubted{trial});
  ASSERT_EQ(store_->trials(session_number_).size(), 1U);
  EXPECT_EQ(store_->trials(session_number_)[0].response, 5000.0);
  // A person who goes back after the deadline has missed it.
  const std::int64_t next = feel(10.0);
  act(operate::Answer{next, 9000.0});
  pass(5.0);
  EXPECT_TRUE(act(operate::GoBack{next}).missed_deadline);
  EXPECT_EQ(store_->trials(session_number_).size(), 1U);
}

TEST_F(DoubtedAnswerTest, AnAnswerLineHasTheFormOfItsTrialAndCanBeRunAgain) {
  asks_about_answers_ = false;
  open();
  run_to_block("comparison");
  while (view().step != Step::kStageDone) answer_trial(view(), 1.0);
  const SessionView now = view();
  const AnswerLine& last = now.answers.at(0);
  const AnswerLine& first = now.answers.at(3);
  EXPECT_EQ(first.in_block, 1);
  EXPECT_EQ(first.form.kind, experiments::AnswerKind::kYesNo);
  EXPECT_EQ(first.form.yes_label, "Yes");
  EXPECT_TRUE(first.can_run_again && last.can_run_again);
  EXPECT_FALSE(first.can_undo);
  EXPECT_FALSE(now.answers.at(4).can_run_again) << "its block is over";
  EXPECT_EQ(now.answers.at(4).form.kind, experiments::AnswerKind::kMatch);

  EXPECT_EQ(act(operate::RunAgain{first.trial, " "}).refusal, "expected a reason, found none");
  const SessionView again = act(operate::RunAgain{first.trial, "a phone rang"});
  EXPECT_EQ(again.refusal, "");
  EXPECT_EQ(again.trial->trial, first.trial);
  answer_trial(view(), 0.0);
  EXPECT_EQ(view().step, Step::kStageDone) << "the others stand";
  const std::vector<core::TrialRow> rows = store_->trials(session_number_);
  const auto found = std::ranges::find(rows, first.trial, &core::TrialRow::trial);
  ASSERT_NE(found, rows.end());
  EXPECT_EQ(found->attempt, 2);
  EXPECT_EQ(found->response, 0.0);
  EXPECT_EQ(std::ranges::count(kinds(), "answer_undone"), 1);
  EXPECT_NE(act(operate::RunAgain{now.answers.at(4).trial, "why"}).refusal, "");
  session_.reset();
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

}  // namespace doubted_answer_test
}  // namespace jnd::app
