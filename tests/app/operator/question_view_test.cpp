#include <gtest/gtest.h>

#include "app/asked_study.h"
#include "app/operator/operated_session_fixture.h"

// Tests what the operator reads, sees and can do if questions follow the answer of a trial.

namespace jnd::app {
namespace question_view_test {

class QuestionViewTest : public OperatedSessionTest {
 protected:
  /// Answers the waiting trial.
  SessionView answer_now(double value) {
    answer_trial(view(), value);
    return view();
  }
  SessionView say(const std::string& answer) {
    const SessionView now = view();
    return act(operate::AnswerItem{now.stage, now.item->name, answer, now.item->trial});
  }
};

TEST_F(QuestionViewTest, TheScaleOfARatingAndItsQuestionsAreShownOneByOne) {
  open(kAskedStudy);
  SessionView now = run_to_block("rated");
  EXPECT_EQ(now.trial->answer, experiments::AnswerKind::kStep);
  EXPECT_EQ(now.trial->num_steps, 7);
  EXPECT_EQ(now.trial->low_label, "very thin");
  now = answer_now(9.0);
  EXPECT_NE(now.refusal.find("expected a step from 1 to 7"), std::string::npos) << now.refusal;
  now = act(operate::Answer{now.trial->trial, 6.0});
  ASSERT_EQ(now.step, Step::kItem);
  EXPECT_EQ(now.item->name, "pleasantness");
  EXPECT_EQ(now.item->trial, 1);
  EXPECT_EQ(now.sentence, "How did it feel?");
  EXPECT_EQ(now.participant_text, "How did it feel?");
  EXPECT_EQ(now.heading, "Question 1 of 2");
  EXPECT_EQ(now.item->low_label, "unpleasant");
  EXPECT_EQ(now.answers.front().answer, "6") << "it is on disk already";
  EXPECT_EQ(act(operate::Present{now.trial->trial, "test"}).refusal,
            "a question after the trial before comes first");
  EXPECT_NE(say("6").refusal, "") << "there are five steps";
  now = say("5");
  EXPECT_EQ(now.item->name, "remark");
  EXPECT_EQ(act(operate::AnswerItem{now.stage, "pleasantness", "5", 1}).refusal,
            "that question is answered already")
      << "a key pressed twice";
  now = say("no_answer");
  EXPECT_EQ(now.step, Step::kReady);
  const auto rows = store_->question_answers(session_number_);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].answer, "5");
  EXPECT_EQ(rows[1].answer, "no_answer");
}

TEST_F(QuestionViewTest, FeedbackIsToldAfterTheLastQuestion) {
  open(kAskedStudy);
  run_to_block("rated");
  while (view().step != Step::kStageDone) {
    if (view().step == Step::kItem) {
      say("5");
    } else {
      answer_now(3.0);
    }
  }
  SessionView now = run_to_block("compared");
  now = answer_now(1.0);
  ASSERT_EQ(now.step, Step::kItem);
  EXPECT_FALSE(now.feedback_right) << "it would decide how sure somebody says to have been";
  now = say("2");
  EXPECT_TRUE(now.feedback_right.has_value());
  now = answer_now(1.0);
  EXPECT_EQ(now.step, Step::kItem) << "the last trial of the block has questions, too";
  now = say("6");
  EXPECT_EQ(now.step, Step::kStageDone);
}

TEST_F(QuestionViewTest, AProgramStartedAgainAsksTheQuestionThatWaited) {
  open(kAskedStudy);
  run_to_block("rated");
  answer_now(3.0);
  say("4");
  reopen();
  SessionView now = act(operate::Begin{"repeat"});
  ASSERT_EQ(now.step, Step::kItem);
  EXPECT_EQ(now.item->name, "remark");
  EXPECT_EQ(store_->trials(session_number_).size(), 1U) << "what was answered stands";
  act(operate::Undo{"misheard"});
  now = view();
  EXPECT_EQ(now.step, Step::kReady) << "taken back with its questions";
  EXPECT_TRUE(store_->question_answers(session_number_).empty());
  now = answer_now(2.0);
  EXPECT_EQ(now.item->name, "pleasantness");
  EXPECT_EQ(now.item->trial, 1);
}

}  // namespace question_view_test
}  // namespace jnd::app
