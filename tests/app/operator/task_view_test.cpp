#include <gtest/gtest.h>

#include "app/operator/operated_session_fixture.h"
#include "app/task_study.h"

// Tests what the operator reads, sees and can do in a trial of each task.

namespace jnd::app {
namespace task_view_test {

using experiments::AnswerKind;

class TaskViewTest : public OperatedSessionTest {
 protected:
  const core::DesignRow& planned(std::int64_t trial) {
    design_ = store_->design(session_number_);
    return design_.at(static_cast<std::size_t>(trial) - 1);
  }
  /// Gives some answer to every trial up to this block.
  SessionView to(const std::string& block) {
    if (view().step == Step::kBegin) act(operate::Begin{});
    for (int guard = 0; guard < 500; ++guard) {
      const SessionView now = view();
      if (now.step == Step::kFinished) break;
      if (now.trial && study_stage_name(now.stage) == block) return now;
      if (now.step == Step::kReady || now.step == Step::kPresenting) {
        feel(now);
        act(operate::Answer{now.trial->trial, 1.0});
      } else {
        step_on(now);
      }
    }
    ADD_FAILURE() << "never came to " << block;
    return view();
  }
  void feel(const SessionView& now) {
    const std::int64_t trial = now.trial->trial;
    if (now.trial->order_is_drawn) {
      act(operate::Present{trial, "first"});
      pass(0.3);
      act(operate::Present{trial, "second"});
    } else {
      if (now.trial->has_reference) act(operate::Present{trial, "reference"});
      pass(0.3);
      act(operate::Present{trial, "test"});
    }
    pass(0.3);
  }
  void answer(double value) { act(operate::Answer{view().trial->trial, value}); }

  std::vector<core::DesignRow> design_;
};

TEST_F(TaskViewTest, ATwoIntervalTrialIsFirstAndSecondToItsAnswer) {
  open(kTaskStudy);
  SessionView now = to("which");
  const std::int64_t trial = now.trial->trial;
  EXPECT_TRUE(now.trial->order_is_drawn);
  EXPECT_EQ(now.trial->answer, AnswerKind::kInterval);
  EXPECT_EQ(now.sentence, "Show one finger, then present the first.");
  EXPECT_EQ(act(operate::Present{trial, "second"}).refusal, "the first interval comes first");
  EXPECT_EQ(act(operate::Present{trial, "test"}).refusal,
            "this block has a first and a second interval");
  now = act(operate::Present{trial, "first"});
  pass(0.5);
  now = view();
  EXPECT_EQ(now.trial->interval, "first");
  EXPECT_EQ(now.heading, "First interval");
  EXPECT_EQ(now.sign, HandSign::kOneFinger);
  EXPECT_EQ(now.participant_text, "");
  EXPECT_FALSE(now.trial->can_answer);
  EXPECT_EQ(act(operate::Answer{trial, 1.0}).refusal, "the test has not been felt yet");
  act(operate::Present{trial, "second"});
  pass(0.5);
  now = view();
  EXPECT_EQ(now.trial->interval, "second");
  EXPECT_EQ(now.sign, HandSign::kTwoFingers);
  EXPECT_EQ(now.say, "Which was thicker?");
  EXPECT_EQ(now.trial->yes_label, "First");
  EXPECT_NEAR(now.trial->first_felt_s.value(), 0.5, 0.1);
  EXPECT_TRUE(now.trial->can_answer);
  const auto test = planned(trial).test_interval.value();
  now = act(operate::Answer{trial, 2.0});
  EXPECT_EQ(now.answers.front().answer, "Second");
  EXPECT_EQ(store_->trials(session_number_).back().response, test == 2 ? 1.0 : 0.0);
}

TEST_F(TaskViewTest, NothingInAViewTellsWhichIntervalHoldsTheTest) {
  // The view is the same for a test in the first and in the second interval.
  open(kTaskStudy);
  to("which");
  std::map<std::int64_t, std::vector<std::string>> pictures;
  while (study_stage_name(view().stage) == "which" && view().trial) {
    const SessionView ready = view();
    const auto test = planned(ready.trial->trial).test_interval.value();
    std::vector<std::string>& seen = pictures[test];
    seen.clear();
    for (const char* interval : {"first", "second", "first", "second"}) {
      act(operate::Present{ready.trial->trial, interval});
      pass(0.3);
      const SessionView now = view();
      for (const std::string& words :
           {now.heading, now.sentence, now.say, now.participant_text, now.trial->interval,
            std::to_string(static_cast<int>(now.sign)),
            std::to_string(static_cast<int>(now.trial->can_answer))}) {
        seen.push_back(words);
      }
    }
    const SessionView after = act(operate::Answer{ready.trial->trial, 1.0});
    seen.push_back(after.answers.front().answer);
  }
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[1], pictures[2]);
}

TEST_F(TaskViewTest, ACorrectionNamesTheIntervalAndUndoRunsTheTrialAgain) {
  open(kTaskStudy);
  const std::int64_t trial = to("which").trial->trial;
  feel(view());
  answer(1.0);
  const auto test = planned(trial).test_interval.value();
  act(operate::Correct{trial, 2.0, "said the second"});
  EXPECT_EQ(view().answers.front().answer, "Second");
  EXPECT_EQ(store_->trials(session_number_).back().response, test == 2 ? 1.0 : 0.0);
  SessionView now = act(operate::Undo{"felt again"});
  EXPECT_EQ(now.trial->trial, trial);
  EXPECT_EQ(now.trial->attempt, 1);
  feel(now);
  EXPECT_EQ(view().trial->attempt, 2);
  answer(1.0);
  EXPECT_EQ(view().answers.front().answer, "First");
}

TEST_F(TaskViewTest, SameOrDifferentIsAskedByItsWords) {
  open(kTaskStudy);
  const SessionView now = to("same");
  EXPECT_EQ(now.trial->answer, AnswerKind::kYesNo);
  EXPECT_EQ(now.trial->yes_label, "Different");
  EXPECT_EQ(now.trial->no_label, "Same");
  feel(now);
  EXPECT_EQ(view().heading, "Second interval");
  answer(0.0);
  EXPECT_EQ(view().answers.front().answer, "Same");
}

TEST_F(TaskViewTest, ACatchTrialLooksLikeAnyOther) {
  open(kTaskStudy);
  to("there");
  bool met = false;
  while (study_stage_name(view().stage) == "there" && view().trial) {
    const std::int64_t trial = view().trial->trial;
    act(operate::Present{trial, "test"});
    pass(0.5);
    const SessionView now = view();
    EXPECT_EQ(now.heading, "Test fluid");
    EXPECT_TRUE(now.trial->can_answer);
    if (planned(trial).is_catch) {
      met = true;
      EXPECT_EQ(now.telemetry.total_force_n, (core::PlainVector{})) << "nothing is there";
    }
    answer(0.0);
  }
  EXPECT_TRUE(met);
}

TEST_F(TaskViewTest, FeedbackIsSaidAndShownUntilTheNextTrialBegins) {
  open(kTaskStudy);
  act(operate::Begin{});
  pass(0.1);
  SessionView now = view();
  ASSERT_EQ(study_stage_name(now.stage), "practice");
  EXPECT_EQ(now.feedback_right, std::nullopt);
  const bool more = planned(now.trial->trial).intensity.value() > 8.0;
  feel(now);
  answer(more ? 1.0 : 0.0);
  now = view();
  EXPECT_EQ(now.feedback_right, true);
  EXPECT_EQ(now.say, "That was right.");
  EXPECT_EQ(now.participant_text, "That was right.");
  act(operate::Present{now.trial->trial, "reference"});
  EXPECT_EQ(view().feedback_right, std::nullopt);
  act(operate::Undo{"wrong key"});
  EXPECT_EQ(view().feedback_right, std::nullopt);
  feel(view());
  answer(more ? 0.0 : 1.0);
  EXPECT_EQ(view().say, "That was wrong.");
}

TEST_F(TaskViewTest, APracticeSaysWhatItCameToAndGoesOnAfterAnUndo) {
  open(kTaskStudy);
  act(operate::Begin{});
  pass(0.1);
  while (view().trial) {
    const bool more = planned(view().trial->trial).intensity.value() > 8.0;
    feel(view());
    answer(more ? 1.0 : 0.0);
  }
  SessionView now = view();
  EXPECT_EQ(now.step, Step::kStageDone);
  const std::string over =
      "practice over after 4 trials: 4 of the last 4 answers were right, at least 3 were asked "
      "for";
  EXPECT_EQ(now.practice, over);
  EXPECT_EQ(now.sentence, "Done: " + over + ". Go on?");
  EXPECT_EQ(now.say, "That was right.");
  now = act(operate::Undo{"wrong key"});
  EXPECT_EQ(now.practice, "");
  ASSERT_TRUE(now.trial);
  const bool more = planned(now.trial->trial).intensity.value() > 8.0;
  feel(now);
  answer(more ? 1.0 : 0.0);
  now = view();
  now = act(operate::FinishStage{now.stage, ""});
  EXPECT_EQ(now.notes, std::vector<std::string>{over});
}

const std::string kQuestPlusStudy = R"json({"format": 1, "name": "edge", "languages": ["en"],
    "title": {"en": "E"}, "authors": ["A. Author"], "device": {"min_contact_points": 1},
    "stages": [{"kind": "block", "name": "one", "procedure": "quest_plus",
      "medium": "viscous", "viscosity_pa_s": [5, 9, 11, 20], "reference_viscosity_pa_s": 10,
      "pse_viscosity_pa_s": [5, 20], "max_trials": 6, "instruction": {"en": "Compare."},
      "question": {"en": "Thicker?"}, "expected_trial_s": 5}]})json";

TEST_F(TaskViewTest, WhatSpeaksAgainstABlockIsToldWhenItIsOver) {
  open(kQuestPlusStudy);
  act(operate::Begin{});
  pass(0.1);
  while (view().trial) {
    EXPECT_EQ(view().caution, "") << "not before the end";
    feel(view());
    answer(1.0);
  }
  EXPECT_NE(view().caution.find("the lower end of `pse_viscosity_pa_s` (5)"), std::string::npos)
      << view().caution;
}

TEST_F(TaskViewTest, WhereLevelsAreHiddenNothingIsSaidOfThem) {
  open(replaced(kQuestPlusStudy, R"("authors")", R"("blinding": "double", "authors")"));
  act(operate::Begin{});
  pass(0.1);
  while (view().trial) {
    feel(view());
    answer(1.0);
  }
  EXPECT_EQ(view().step, Step::kStageDone);
  EXPECT_EQ(view().caution, "");
}

TEST_F(TaskViewTest, AParticipantReadsTheFeedbackInTheSessionsLanguage) {
  open(replaced(kTaskStudy, R"("languages": ["en", "de"])", R"("languages": ["de", "en"])"));
  act(operate::Begin{});
  pass(0.1);
  const bool more = planned(view().trial->trial).intensity.value() > 8.0;
  feel(view());
  answer(more ? 1.0 : 0.0);
  EXPECT_EQ(view().participant_text, "Das war richtig.");
}

}  // namespace task_view_test
}  // namespace jnd::app
