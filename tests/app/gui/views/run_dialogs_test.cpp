#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/apparatus_view.h"
#include "app/gui/views/run_view_fixture.h"

namespace jnd::app::gui {
namespace run_dialogs_test {

/// Questions before something is undone, or after a pause.
class RunDialogs : public RunViewTest {
 protected:
  static SessionView paused() {
    SessionView view = comparison();
    view.step = Step::kPaused;
    view.asks_why_paused = true;
    return view;
  }
  /// Presses P and puts the session into the pause.
  void pause() {
    (void)after_key<operate::Pause>(comparison(), {letter('P')});
    draw(paused());
  }
};

TEST_F(RunDialogs, APauseIsAskedForAtOnceAndItsReasonOnceItHolds) {
  draw(comparison());
  ui_.press(letter('P'));
  EXPECT_EQ(only<operate::Pause>(draw(comparison())).reason, "");
  EXPECT_EQ(ui_.drawn().find("dialog_cancel"), nullptr) << "nothing holds yet";
  draw(paused());
  EXPECT_TRUE(ui_.drawn().shows("Paused. Why?"));
  EXPECT_TRUE(ui_.drawn().shows("the pause is on disk"));
  ASSERT_NE(ui_.drawn().find("reason_1"), nullptr);
  EXPECT_EQ(ui_.drawn().find("reason_1")->key, "1");
}

TEST_F(RunDialogs, ARestEndsWhenItsClockSaysSoAndItsQuestionEndsWithIt) {
  SessionView rest = comparison();
  rest.step = Step::kBreak;
  rest.trial.reset();
  rest.break_left_s = 0.0004;
  draw(rest);
  EXPECT_TRUE(ui_.drawn().shows("0:01"));
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(rest).empty());
  draw(rest);
  ASSERT_TRUE(ui_.drawn().shows("Go on before the rest is over"));
  rest.break_left_s = 0.0;
  draw(rest);
  draw(rest);
  EXPECT_FALSE(ui_.drawn().shows("Go on before the rest is over"));
  EXPECT_TRUE(ui_.drawn().shows("0:00"));
  EXPECT_EQ(after_key<operate::FinishStage>(rest, {Key::kEnter}).reason, "");
}

TEST_F(RunDialogs, OneKeySaysWhyThePauseIs) {
  pause();
  EXPECT_EQ(after_key<operate::ExplainPause>(paused(), {letter('2')}).reason,
            "the participant has a question");
  EXPECT_EQ(state_.dialog, RunViewState::Dialog::kNone);
  SessionView explained = paused();
  explained.asks_why_paused = false;
  draw(explained);
  EXPECT_EQ(ui_.drawn().find("dialog_cancel"), nullptr) << "asked once";
}

TEST_F(RunDialogs, AReasonOfOnesOwnIsTypedAndSentByEnter) {
  pause();
  ui_.press(letter('5'));
  draw(paused());
  draw(paused());
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(paused()).empty()) << "nothing is no reason";
  ui_.type("   ");
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(paused()).empty()) << "and neither are blanks";
  ui_.type("2 phones rang");
  EXPECT_TRUE(draw(paused()).empty()) << "a number is a word now";
  ui_.press(Key::kEnter);
  EXPECT_EQ(only<operate::ExplainPause>(draw(paused())).reason, "   2 phones rang");
}

TEST_F(RunDialogs, APauseWithoutAReasonStandsAndIsNotAskedAboutAgain) {
  pause();
  EXPECT_EQ(ui_.drawn().find("dialog_cancel")->label, "Give no reason");
  ui_.press(Key::kF2);
  EXPECT_TRUE(draw(paused()).empty());
  draw(paused());
  EXPECT_EQ(ui_.drawn().find("dialog_cancel"), nullptr);
  (void)after_key<operate::GoOn>(paused(), {Key::kEnter});
}

TEST_F(RunDialogs, APauseThatNobodyAskedForHereIsNotAskedAbout) {
  draw(paused());  // This is so in a session that is resumed.
  EXPECT_EQ(ui_.drawn().find("dialog_cancel"), nullptr);
}

TEST_F(RunDialogs, APauseHoldsAtOnceWhereTheApparatusIsLookedAt) {
  ApparatusViewState apparatus;
  const auto look = [&](const SessionView& view) {
    std::vector<OperatorRequest> requests;
    ui_.frame([&](Ui& ui) {
      const RunViewResult result = draw_apparatus_view(ui, view, {}, state_, apparatus);
      requests.insert(requests.end(), result.requests.begin(), result.requests.end());
    });
    return requests;
  };
  look(comparison());
  ui_.press(letter('P'));
  (void)only<operate::Pause>(look(comparison()));
  look(paused());
  EXPECT_TRUE(ui_.drawn().shows("Paused. Why?"));
  ui_.press(letter('1'));
  EXPECT_EQ(only<operate::ExplainPause>(look(paused())).reason, "the participant needs a rest");
}

TEST_F(RunDialogs, UndoTakesOneKeyForItsReason) {
  draw(comparison());
  ui_.press({letter('Z'), true});
  EXPECT_TRUE(draw(comparison()).empty());
  ASSERT_NE(ui_.drawn().find("reason_4"), nullptr);
  EXPECT_EQ(after_key<operate::Undo>(comparison(), {letter('2')}).reason,
            "the wrong key was pressed");
  EXPECT_EQ(state_.dialog, RunViewState::Dialog::kNone);
}

TEST_F(RunDialogs, UndoTakesAReasonOfOnesOwn) {
  draw(comparison());
  ui_.press({letter('Z'), true});
  draw(comparison());
  ui_.click("reason_5");
  draw(comparison());
  draw(comparison());
  ASSERT_NE(ui_.drawn().find("dialog_do"), nullptr);
  EXPECT_FALSE(ui_.drawn().find("dialog_do")->enabled) << "a reason is needed";
  ui_.type("my slip");
  EXPECT_TRUE(draw(comparison()).empty()) << "letters are words now, not answers";
  ui_.press(Key::kEnter);
  EXPECT_EQ(only<operate::Undo>(draw(comparison())).reason, "my slip");
  EXPECT_EQ(state_.dialog, RunViewState::Dialog::kNone);
}

/// Opens the dialog that appears when somebody clicks at an answer of the list.
class CorrectDialogTest : public RunViewTest {
 protected:
  void choose(AnswerLine line) {
    line.trial = 20;
    line.in_block = 7;
    line.block = "Group D";
    view_.answers = {std::move(line)};
    draw(view_);
    ui_.click("answer_20");
    draw(view_);
    draw(view_);
  }
  /// Types the reason, and Enter.
  std::vector<OperatorRequest> because(const std::string& reason) {
    draw(view_);
    ui_.type(reason);
    draw(view_);
    ui_.press(Key::kEnter);
    return draw(view_);
  }

  SessionView view_ = comparison();
};

TEST_F(CorrectDialogTest, NamesTheTrialAndTheOldAnswer) {
  choose({.answer = "Thicker", .form = {.yes_label = "Thicker", .no_label = "Not thicker"}});
  EXPECT_TRUE(ui_.drawn().shows("Group D, trial 7: the answer was “Thicker”."));
  EXPECT_TRUE(ui_.drawn().shows("The old answer stays in the log"));
  EXPECT_EQ(ui_.drawn().find("correct_run_again"), nullptr) << "its block is over";
}

TEST_F(CorrectDialogTest, OffersTheButtonsOfTheTrialByTheirKeys) {
  choose(
      {.answer = "Thicker",
       .form = {.yes_label = "Thicker", .no_label = "Not thicker", .takes_cannot_tell = true}});
  ASSERT_NE(ui_.drawn().find("correct_no"), nullptr);
  EXPECT_EQ(ui_.drawn().find("correct_no")->label, "Not thicker");
  EXPECT_EQ(ui_.drawn().find("reason"), nullptr) << "the answer first";
  EXPECT_FALSE(ui_.drawn().find("dialog_do")->enabled);
  ui_.press(letter('N'));
  draw(view_);
  const auto corrected = only<operate::Correct>(because("misheard"));
  EXPECT_EQ(corrected.trial, 20);
  EXPECT_EQ(corrected.value, 0.0);
  EXPECT_EQ(corrected.reason, "misheard");
  EXPECT_EQ(state_.dialog, RunViewState::Dialog::kNone);
}

TEST_F(CorrectDialogTest, CannotTellIsAnAnswerWhereTheStudyHasIt) {
  choose(
      {.answer = "Thicker",
       .form = {.yes_label = "Thicker", .no_label = "Not thicker", .takes_cannot_tell = true}});
  ui_.press(letter('C'));
  draw(view_);
  EXPECT_EQ(only<operate::Correct>(because("misheard")).value, std::nullopt);
}

TEST_F(CorrectDialogTest, AnIntervalIsChosenByItsNumberAndItsOwnWords) {
  choose({.answer = "the left",
          .form = {.kind = experiments::AnswerKind::kInterval,
                   .choices = {{1, "the left"}, {2, "the right"}}}});
  EXPECT_EQ(ui_.drawn().find("correct_second")->label, "the right");
  ui_.press(letter('2'));
  draw(view_);
  EXPECT_EQ(only<operate::Correct>(because("misheard")).value, 2.0);
}

TEST_F(CorrectDialogTest, AStepIsChosenOnTheScaleOfTheTrial) {
  choose({.answer = "3",
          .form = {.kind = experiments::AnswerKind::kStep,
                   .num_steps = 7,
                   .low_label = "very thin",
                   .high_label = "very thick"}});
  EXPECT_TRUE(ui_.drawn().shows("very thick"));
  ui_.press(letter('6'));
  draw(view_);
  EXPECT_EQ(only<operate::Correct>(because("misheard")).value, 6.0);
}

TEST_F(CorrectDialogTest, ANumberIsTypedAndWhatIsNoneIsTold) {
  choose({.answer = "1250 %", .form = {.kind = experiments::AnswerKind::kPercent}});
  ui_.type("abc");
  draw(view_);
  EXPECT_TRUE(ui_.drawn().shows("expected a number, found “abc”"));
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(view_).empty());
  EXPECT_EQ(ui_.drawn().find("reason"), nullptr);
  for (int i = 0; i < 3; ++i) ui_.press(Key::kBackspace);
  draw(view_);
  draw(view_);
  ui_.press(Key::kEnd);
  for (int i = 0; i < 3; ++i) ui_.press(Key::kBackspace);
  ui_.type("125");
  ui_.press(Key::kEnter);
  draw(view_);
  const auto corrected = only<operate::Correct>(because("a zero too many"));
  EXPECT_EQ(corrected.value, 125.0);
  EXPECT_EQ(corrected.reason, "a zero too many");
}

TEST_F(CorrectDialogTest, TheTrialCanBeRunAgainInstead) {
  choose({.answer = "Thicker",
          .form = {.yes_label = "Thicker", .no_label = "Not thicker"},
          .can_run_again = true});
  ui_.press(Key::kF5);
  draw(view_);
  EXPECT_EQ(ui_.drawn().find("dialog_do")->label, "Run it again");
  const auto again = only<operate::RunAgain>(because("a phone rang"));
  EXPECT_EQ(again.trial, 20);
  EXPECT_EQ(again.reason, "a phone rang");
}

TEST_F(CorrectDialogTest, WhatWasSetIsNotTypedWhereItIsHidden) {
  choose({.answer = "set",
          .form = {.kind = experiments::AnswerKind::kMatch, .is_hidden = true},
          .can_run_again = true});
  EXPECT_TRUE(ui_.drawn().shows("What was set is hidden"));
  EXPECT_EQ(ui_.drawn().find("correct_value"), nullptr);
  EXPECT_NE(ui_.drawn().find("correct_run_again"), nullptr);
}

class DoubtDialogTest : public RunViewTest {
 protected:
  DoubtDialogTest() {
    view_.doubt = DoubtView{23, "The answer is 99999 %: 700 times the last answer."};
  }
  SessionView view_ = estimation();
};

TEST_F(DoubtDialogTest, AsksInOneSentenceAndIsAnsweredByKeyAndMouse) {
  draw(view_);
  EXPECT_TRUE(ui_.drawn().shows("The answer is 99999 %: 700 times the last answer."));
  EXPECT_EQ(after_key<operate::StoreDoubted>(view_, {letter('S')}).trial, 23);
  EXPECT_EQ(after_key<operate::GoBack>(view_, {Key::kF2}).trial, 23);
  EXPECT_EQ(after_click<operate::StoreDoubted>(view_, "doubt_store").trial, 23);
  EXPECT_EQ(after_click<operate::GoBack>(view_, "doubt_go_back").trial, 23);
}

TEST_F(DoubtDialogTest, EnterPressedTwiceConfirmsNothing) {
  draw(view_);
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(view_).empty());
}

TEST_F(DoubtDialogTest, TheStopAnswersBesideIt) {
  draw(view_);
  ui_.click("emergency_stop");
  draw(view_);
  EXPECT_TRUE(stopped_);
}

}  // namespace run_dialogs_test
}  // namespace jnd::app::gui
