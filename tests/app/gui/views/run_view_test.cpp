#include "app/gui/views/run_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/participant_view.h"
#include "app/gui/views/run_view_fixture.h"

namespace jnd::app::gui {
namespace run_view_test {

using RunView = RunViewTest;

TEST_F(RunView, AnswersByKeyAndByMouseForTheTrialThatIsShown) {
  EXPECT_EQ(after_key<operate::Answer>(comparison(), {letter('Y')}).value, 1.0);
  EXPECT_EQ(after_key<operate::Answer>(comparison(), {letter('N')}).value, 0.0);
  EXPECT_EQ(after_click<operate::Answer>(comparison(), "answer_yes").value, 1.0);
  EXPECT_EQ(after_click<operate::Answer>(comparison(), "answer_no").trial, 23);
}

TEST_F(RunView, APassedLimitIsToldWhereOneMayRest) {
  const std::string sentence =
      "The study's limit is passed: 62 trials without a break, of at most 60.";
  SessionView view = comparison();
  view.advice = "62 trials without a break, of at most 60";
  draw(view);
  EXPECT_FALSE(ui_.drawn().shows(sentence)) << "not in the middle of a trial";
  view.step = Step::kReady;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows(sentence));
}

TEST_F(RunView, WhatSpeaksAgainstABlockIsToldWhenItIsOver) {
  const std::string sentence = "Caution: the posterior reaches an end.";
  SessionView view = comparison();
  view.caution = "the posterior reaches an end";
  draw(view);
  EXPECT_FALSE(ui_.drawn().shows(sentence));
  view.step = Step::kStageDone;
  view.trial.reset();
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows(sentence));
}

/// Returns a view of a trial in drawn order, whose second interval is being felt.
SessionView two_intervals() {
  SessionView view = comparison();
  view.trial->answer = AnswerKind::kInterval;
  view.trial->order_is_drawn = true;
  view.trial->choices = {{1, "First"}, {2, "Second"}};
  view.trial->interval = "second";
  view.trial->yes_label = "First";
  view.trial->no_label = "Second";
  return view;
}

TEST_F(RunView, AnIntervalIsChosenByItsNumber) {
  EXPECT_EQ(after_key<operate::Answer>(two_intervals(), {letter('1')}).value, 1.0);
  EXPECT_EQ(after_key<operate::Answer>(two_intervals(), {letter('2')}).value, 2.0);
  EXPECT_EQ(after_click<operate::Answer>(two_intervals(), "answer_first").value, 1.0);
  EXPECT_EQ(after_click<operate::Answer>(two_intervals(), "answer_second").trial, 23);
}

TEST_F(RunView, TheIntervalsOfADrawnOrderAreFirstAndSecond) {
  SessionView view = two_intervals();
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kLeft}).interval, "first");
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kRight}).interval, "second");
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("Back to the first"));
  EXPECT_FALSE(ui_.drawn().shows("Test again"));
  EXPECT_TRUE(ui_.drawn().shows("first felt before for 8.1 s"));
  view.trial->interval = "first";
  view.trial->can_answer = false;
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kSpace}).interval, "second");
  draw(view);
  EXPECT_FALSE(ui_.drawn().shows("Second again"));
  view.step = Step::kReady;
  view.trial->interval.clear();
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kSpace}).interval, "first");
}

/// Of three intervals the second one is being felt, and the third is still to come.
SessionView three_intervals() {
  SessionView view = two_intervals();
  view.trial->num_intervals = 3;
  view.trial->next_interval = "third";
  view.trial->can_answer = false;
  view.trial->choices = {{1, "First"}, {2, "Second"}, {3, "Third"}};
  return view;
}

TEST_F(RunView, ThreeIntervalsComeInTheirOrderAndEachCanBeChosen) {
  SessionView view = three_intervals();
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kSpace}).interval, "third");
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kRight}).interval, "second") << "again";
  draw(view);
  EXPECT_EQ(ui_.drawn().find("present_third"), nullptr) << "it is the next one";
  EXPECT_EQ(ui_.drawn().find("answer_first"), nullptr);
  view.trial->interval = "third";
  view.trial->next_interval = "";
  view.trial->can_answer = true;
  EXPECT_EQ(after_key<operate::Answer>(view, {letter('3')}).value, 3.0);
  EXPECT_EQ(after_click<operate::Answer>(view, "answer_second").value, 2.0);
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kDown}).interval, "third") << "again";
  view.trial->choices = {{2, "Second"}, {3, "Third"}};
  draw(view);
  EXPECT_EQ(ui_.drawn().find("answer_first"), nullptr) << "the sample is no answer";
}

TEST_F(RunView, AStepOfARatingIsChosenByItsNumber) {
  SessionView view = comparison();
  view.trial->answer = AnswerKind::kStep;
  view.trial->num_steps = 10;
  view.trial->low_label = "very thin";
  view.trial->high_label = "very thick";
  EXPECT_EQ(after_key<operate::Answer>(view, {letter('7')}).value, 7.0);
  EXPECT_EQ(after_key<operate::Answer>(view, {letter('0')}).value, 10.0);
  EXPECT_EQ(after_click<operate::Answer>(view, "step_1").value, 1.0);
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("very thick"));
}

TEST_F(RunView, AnAnswerIsSetRightByKeysAlone) {
  const SessionView view = comparison();
  draw(view);
  ui_.press(Key::kF3);
  draw(view);
  draw(view);
  ASSERT_EQ(state_.dialog, RunViewState::Dialog::kCorrect);
  EXPECT_EQ(state_.correct.line.trial, 22) << "the newest";
  ui_.press(Key::kF3);
  draw(view);
  draw(view);
  EXPECT_EQ(state_.correct.line.trial, 21);
  for (int i = 0; i < 9; ++i) {
    ui_.press(Key::kF3);
    draw(view);
  }
  draw(view);
  EXPECT_EQ(state_.correct.line.trial, 22) << "after the oldest comes the newest again";
}

TEST_F(RunView, AStepOfALongScaleIsSetRightWhileAnotherTrialWaitsForOne) {
  SessionView view = comparison();
  view.trial->answer = AnswerKind::kStep;
  view.trial->num_steps = 20;
  for (AnswerLine& line : view.answers) {
    line.form.kind = AnswerKind::kStep;
    line.form.num_steps = 20;
  }
  draw(view);
  ui_.press(Key::kF3);
  draw(view);
  draw(view);
  for (const char* digit : {"1", "4"}) {
    ui_.type(digit);
    draw(view);
  }
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(view).empty()) << "why it is set right is asked first";
  EXPECT_TRUE(state_.correct.has_choice);
  EXPECT_EQ(state_.correct.value, 14.0);
}

TEST_F(RunView, AStepOfALongScaleIsTypedAndStoredByEnter) {
  for (const int num_steps : {11, 20, 100}) {
    SessionView view = comparison();
    view.trial->answer = AnswerKind::kStep;
    view.trial->num_steps = num_steps;
    draw(view);
    EXPECT_TRUE(ui_.drawn().shows("then Enter")) << num_steps;
    for (const char* digit : {"1", "1"}) {
      ui_.type(digit);
      EXPECT_TRUE(draw(view).empty()) << "a digit alone stores nothing";
    }
    EXPECT_EQ(after_key<operate::Answer>(view, {Key::kEnter}).value, 11.0) << num_steps;
  }
  SessionView view = comparison();
  view.trial->answer = AnswerKind::kStep;
  view.trial->num_steps = 11;
  view.trial->trial = 24;
  ui_.type("99");
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("99 is no step"));
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(view).empty());
}

TEST_F(RunView, CannotTellIsAnAnswerWithAKeyWhereTheStudyHasIt) {
  for (SessionView view : {comparison(), two_intervals(), three_intervals()}) {
    view.trial->can_answer = true;
    view.trial->next_interval = "";
    draw(view);
    EXPECT_EQ(ui_.drawn().find("answer_cannot_tell"), nullptr);
    view.trial->takes_cannot_tell = true;
    const auto answer = after_key<operate::Answer>(view, {letter('C')});
    EXPECT_EQ(answer.value, std::nullopt);
    EXPECT_EQ(answer.trial, 23);
    EXPECT_EQ(after_click<operate::Answer>(view, "answer_cannot_tell").value, std::nullopt);
    ASSERT_NE(ui_.drawn().find("answer_cannot_tell"), nullptr);
    EXPECT_EQ(ui_.drawn().find("answer_cannot_tell")->label, "Cannot tell");
  }
}

TEST_F(RunView, NothingGoesOnBeforeAStimulusWasFeltForItsLeastTime) {
  SessionView view = two_intervals();
  view.trial->takes_cannot_tell = true;
  view.trial->least_left_s = 0.8;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("0.8 s to go"));
  for (const char* name : {"answer_first", "answer_second", "answer_cannot_tell",
                           "present_first", "present_second", "present_free_space"}) {
    ASSERT_NE(ui_.drawn().find(name), nullptr) << name;
    EXPECT_FALSE(ui_.drawn().find(name)->enabled) << name;
  }
  ui_.press({letter('1')});
  EXPECT_TRUE(draw(view).empty());
  ui_.press({Key::kLeft});
  EXPECT_TRUE(draw(view).empty());
  view.trial->least_left_s = 0.0;
  EXPECT_EQ(after_key<operate::Answer>(view, {letter('1')}).value, 1.0);
}

TEST_F(RunView, WhatNobodyMayGoBackToHasNoButton) {
  SessionView view = two_intervals();
  view.trial->closed_intervals = {"first", "second"};
  draw(view);
  EXPECT_EQ(ui_.drawn().find("present_first"), nullptr);
  EXPECT_EQ(ui_.drawn().find("present_second"), nullptr);
  EXPECT_NE(ui_.drawn().find("present_free_space"), nullptr) << "it is no stimulus";
  EXPECT_NE(ui_.drawn().find("answer_first"), nullptr);
}

TEST_F(RunView, AStimulusThatEndedIsToldWithTheTimeThatIsLeftToAnswer) {
  SessionView view = comparison();
  view.trial->interval = "free_space";
  view.trial->stimulus_is_over = true;
  view.trial->felt_s = 2.0;
  view.trial->deadline_left_s = 1.26;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("it ended after 2.0 s"));
  EXPECT_TRUE(ui_.drawn().shows("1.3 s left to answer"));
  EXPECT_EQ(after_key<operate::Answer>(view, {letter('Y')}).value, 1.0);
  view.trial->deadline_left_s = -0.001;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("0.0 s left to answer"));
}

TEST_F(RunView, TheAnswersAreNotThereBeforeTheTestWasFelt) {
  SessionView view = comparison();
  view.trial->can_answer = false;
  view.trial->interval = "reference";
  draw(view);
  EXPECT_EQ(ui_.drawn().find("answer_yes"), nullptr);
  ui_.press(letter('Y'));
  EXPECT_TRUE(draw(view).empty());
  EXPECT_EQ(after_key<operate::Present>(view, {Key::kSpace}).interval, "test");
}

TEST_F(RunView, SwitchesBackAndForthByKey) {
  EXPECT_EQ(after_key<operate::Present>(comparison(), {letter('R')}).interval, "reference");
  EXPECT_EQ(after_key<operate::Present>(comparison(), {letter('T')}).interval, "test");
  EXPECT_EQ(after_key<operate::Present>(comparison(), {letter('F')}).interval, "free_space");
}

TEST_F(RunView, TakesAPercentFromTheKeypad) {
  draw(estimation());
  ui_.type("1250");
  ui_.press(Key::kBackspace);
  draw(estimation());
  EXPECT_TRUE(ui_.drawn().shows("125 %"));
  EXPECT_EQ(after_key<operate::Answer>(estimation(), {Key::kEnter}).value, 125.0);
}

TEST_F(RunView, WhatWasTypedForOneTrialIsNotTheNextOnesAnswer) {
  draw(estimation());
  ui_.type("80");
  draw(estimation());
  SessionView next = estimation();
  ++next.trial->trial;
  draw(next);
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(next).empty());
}

TEST_F(RunView, WhatWasTypedForAnAttemptIsGoneWithIt) {
  draw(estimation());
  ui_.type("80");
  draw(estimation());
  SessionView again = estimation();
  ++again.trial->attempt;
  draw(again);
  ui_.type("50");
  draw(again);
  EXPECT_EQ(after_key<operate::Answer>(again, {Key::kEnter}).value, 50.0);
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(again).empty()) << "stored once, it is not there any more";
}

TEST_F(RunView, AHeldKeyAsksForStepsThatMayBeLeftOut) {
  draw(production());
  ui_.hold({Key::kRight}, 3);
  const std::vector<OperatorRequest> requests = draw(production());
  ASSERT_GE(requests.size(), 2U);
  const auto& first = std::get<operate::Adjust>(requests[0]);
  EXPECT_EQ(first.direction, experiments::Direction::kRaise);
  EXPECT_EQ(first.size, experiments::StepSize::kCoarse);
  EXPECT_FALSE(first.held);
  EXPECT_TRUE(std::get<operate::Adjust>(requests.back()).held);
  ui_.release({Key::kRight});
  EXPECT_EQ(after_key<operate::Answer>(production(), {Key::kEnter}).trial, 23);
}

TEST_F(RunView, ADialogIsLeftByItsPrintedKeyAndNothingHappens) {
  draw(comparison());
  ui_.press({letter('N'), true});
  draw(comparison());
  EXPECT_EQ(ui_.drawn().find("dialog_cancel")->key, "F2");
  ui_.press(Key::kF2);
  EXPECT_TRUE(draw(comparison()).empty());
  EXPECT_EQ(state_.dialog, RunViewState::Dialog::kNone);
}

TEST_F(RunView, TheEmergencyStopAnswersEverywhereAlsoBehindADialog) {
  draw(comparison());
  ui_.press({letter('N'), true});
  draw(comparison());
  ASSERT_NE(ui_.drawn().find("dialog_cancel"), nullptr);
  ui_.click("emergency_stop");
  draw(comparison());
  EXPECT_TRUE(stopped_);
}

TEST_F(RunView, AFieldOnTheCardTakesTheKeyboardAgainAfterAStopAndAfterADialog) {
  const SessionView asked =
      item_of({.name = "age", .kind = ItemView::Kind::kNumber, .text = "How old are you?"});
  draw(asked);
  ui_.type("4");
  draw(asked);
  SessionView stopped = asked;
  stopped.step = Step::kFault;
  draw(stopped);
  draw(asked);
  ui_.press({letter('N'), true});
  draw(asked);
  ui_.press(Key::kF2);
  draw(asked);
  draw(asked);
  ui_.press(Key::kEnd);
  ui_.type("2");
  ui_.press(Key::kEnter);
  EXPECT_EQ(only<operate::AnswerItem>(draw(asked)).answer, "42");
}

TEST_F(RunView, TheTestHasItsKeyAlsoBeforeItWasFelt) {
  SessionView view = comparison();
  view.trial->interval = "reference";
  view.trial->can_answer = false;
  EXPECT_EQ(after_key<operate::Present>(view, {letter('T')}).interval, "test");
}

TEST_F(RunView, WhatCameOffIsToldWhereverSomethingWaitsToBeFeltAndCanBeGivenUpForAReason) {
  for (const Step step : {Step::kPaused, Step::kReady}) {
    SessionView view = comparison();
    view.step = step;
    view.loose_points = "the index finger";
    view.loose_bits = 0b01000;
    draw(view);
    EXPECT_TRUE(ui_.drawn().shows("Came off: the index finger."));
    ui_.press({letter('G'), true});
    draw(view);
    view.loose_bits = 0b11000;  // This happened meanwhile, and the operator has not seen it.
    draw(view);
    ASSERT_NE(ui_.drawn().find("dialog_do"), nullptr);
    EXPECT_FALSE(ui_.drawn().find("dialog_do")->enabled) << "a reason is needed";
    ui_.type("sore");
    ui_.press(Key::kEnter);
    const auto without = only<operate::GoOnWithout>(draw(view));
    EXPECT_EQ(without.point_bits, 0b01000);
    EXPECT_EQ(without.reason, "sore");
  }
}

TEST_F(RunView, APointThatIsNotOnTheHandIsNamedBeforeItCouldBeForgotten) {
  SessionView view = comparison();
  view.absent_points = "the thumb";
  draw(view);
  EXPECT_FALSE(ui_.drawn().shows("Not on the hand")) << "something is being felt";
  for (const Step step : {Step::kBegin, Step::kReady}) {
    view.step = step;
    draw(view);
    EXPECT_TRUE(ui_.drawn().shows("Not on the hand: the thumb."));
    EXPECT_EQ(ui_.drawn().find("go_on_without"), nullptr);
  }
}

TEST_F(RunView, AFaultSaysWhatHappenedWhatIsSafeAndHowToGoOn) {
  SessionView view = comparison();
  view.step = Step::kFault;
  view.heading = "Emergency stop";
  view.stop_pressed = true;
  view.sentence = "The emergency stop was pressed.";
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("up to trial 22 is on disk"));
  EXPECT_TRUE(ui_.drawn().shows("Release the stop"));
  (void)after_key<operate::ReleaseStop>(view, {Key::kEnter, true});
  view.stop_pressed = false;
  view.telemetry.arming_wait_s = 0.4;
  view.telemetry.num_faults = 3;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("Arm again"));
  EXPECT_FALSE(ui_.drawn().find("rearm")->enabled) << "a double click is no arming";
  view.telemetry.arming_wait_s = 0.0;
  draw(view);
  EXPECT_EQ(after_key<operate::Rearm>(view, {Key::kEnter, true}).num_faults_seen, 3U);
}

TEST_F(RunView, ADeviceThatNobodyHasArmedIsNoFault) {
  SessionView view = comparison();
  view.step = Step::kFault;
  view.is_disarmed = true;
  view.sentence = "There is no force before somebody arms the device.";
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("Disarmed"));
  EXPECT_FALSE(ui_.drawn().shows("The trial under way will be run again"));
  (void)after_key<operate::Rearm>(view, {Key::kEnter, true});
}

TEST_F(RunView, AListSaysThatTheDeviceIsDisarmed) {
  SessionView view = item_of({.name = "item_1", .text = "Look at the device."});
  draw(view);
  EXPECT_FALSE(ui_.drawn().shows("Disarmed"));
  view.is_disarmed = true;
  view.fault = "There is no force before somebody arms the device.";
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("Disarmed"));
  EXPECT_TRUE(ui_.drawn().shows("Look at the device."));
}

TEST_F(RunView, TheSameAnswerCannotBeGivenOnceTheSessionIsFinished) {
  SessionView view = comparison();
  view.step = Step::kFinished;
  view.trial.reset();
  draw(view);
  ui_.press(letter('Y'));
  EXPECT_TRUE(draw(view).empty());
  EXPECT_TRUE(ui_.drawn().shows("Session finished"));
}

TEST_F(RunView, ANumberOutOfRangeIsToldAndNotSent) {
  const SessionView view = item_of({.stage = 2,
                                    .name = "height",
                                    .kind = ItemView::Kind::kNumber,
                                    .text = "How tall are you?",
                                    .unit = "m",
                                    .minimum = 1.0,
                                    .maximum = 2.5});
  draw(view);
  ui_.type("17");
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(view).empty());
  EXPECT_TRUE(ui_.drawn().shows("expected 1 to 2.5 m"));
  ui_.press(Key::kBackspace);
  ui_.type(".7");
  ui_.press(Key::kEnter);
  const auto answer = only<operate::AnswerItem>(draw(view));
  EXPECT_EQ(answer.answer, "1.7");
  EXPECT_EQ(answer.item, "height");
  EXPECT_EQ(answer.stage, 2);
}

TEST_F(RunView, AScaleIsAnsweredByItsNumber) {
  const SessionView view = item_of({.name = "tired",
                                    .kind = ItemView::Kind::kScale,
                                    .text = "How tired?",
                                    .low_label = "not at all",
                                    .high_label = "very"});
  EXPECT_EQ(after_key<operate::AnswerItem>(view, {static_cast<Key>('7')}).answer, "7");
  EXPECT_EQ(after_key<operate::AnswerItem>(view, {static_cast<Key>('0')}).answer, "10");
  EXPECT_EQ(after_click<operate::AnswerItem>(view, "scale_3").answer, "3");
  EXPECT_TRUE(ui_.drawn().shows("not at all"));
}

TEST_F(RunView, AChoiceIsAnsweredByItsKeyWithTheStoredValue) {
  const SessionView view = item_of({.name = "hand",
                                    .kind = ItemView::Kind::kChoice,
                                    .text = "Which hand?",
                                    .options = {{"right", "the right"}, {"left", "the left"}}});
  EXPECT_EQ(after_key<operate::AnswerItem>(view, {static_cast<Key>('2')}).answer, "left");
}

TEST_F(RunView, YesWhichAsksForTheWhich) {
  const SessionView view = item_of(
      {.name = "device", .kind = ItemView::Kind::kYesNoWhich, .text = "Used one before?"});
  EXPECT_EQ(after_key<operate::AnswerItem>(view, {letter('N')}).answer, "no");
  draw(view);
  ui_.press(letter('Y'));
  EXPECT_TRUE(draw(view).empty());
  ui_.type("a glove");
  ui_.press(Key::kEnter);
  EXPECT_EQ(only<operate::AnswerItem>(draw(view)).answer, "yes: a glove");
}

TEST_F(RunView, AnswersThatAreHiddenStayHidden) {
  SessionView view = comparison();
  view.blinding = experiments::Blinding::kDouble;
  view.hides_levels = true;
  view.trial->level = "";
  view.telemetry.total_force_n = {};
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("within limits"));
  EXPECT_TRUE(ui_.drawn().shows("levels hidden"));
  EXPECT_FALSE(ui_.drawn().shows(" of 30 N"));
  EXPECT_FALSE(ui_.drawn().shows("m/s"));
  EXPECT_FALSE(ui_.drawn().shows("Pa s"));
}

TEST_F(RunView, HeldPointsAreCountedAmongThoseOfTheDeviceUntilAGuardWarns) {
  SessionView view = comparison();
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows(" of 5 points attached"));
  view.num_contact_points = 1;
  view.telemetry.sample.attached_bits = 1;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows(" of 1 points attached"));
  view.telemetry.warning = core::Fault::kOutsideWorkspace;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("The hand is near the edge of its space"));
  EXPECT_FALSE(ui_.drawn().shows("points attached"));
}

TEST_F(RunView, APilotIsMarked) {
  SessionView view = comparison();
  view.pilot = true;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("pilot: not data"));
}

TEST_F(RunView, TheParticipantSeesTheQuestionAndNoLevel) {
  SessionView view = comparison();
  ParticipantViewState read;
  const Drawn& drawn =
      ui_.frame([&](Ui& ui) { draw_participant_view(ui, participant_screen(view, ""), read); });
  EXPECT_TRUE(drawn.shows("thicker than the reference"));
  EXPECT_TRUE(drawn.shows("hand sign one finger"));
  EXPECT_FALSE(drawn.shows("Pa s"));
  EXPECT_FALSE(drawn.shows("trial"));
}

/// Everything that can be used is on the screen, whatever waits and however small the window
/// is.
class RunViewFits : public ::testing::TestWithParam<std::pair<float, float>> {};

TEST_P(RunViewFits, EveryWidgetLiesOnTheScreen) {
  const auto [width, height] = GetParam();
  std::vector<SessionView> views = {comparison(), estimation(), production()};
  for (const Step step : {Step::kBegin, Step::kPaused, Step::kFault, Step::kBreak,
                          Step::kStageDone, Step::kFailed, Step::kFinished}) {
    SessionView view = comparison();
    view.step = step;
    view.trial.reset();
    views.push_back(view);
  }
  views.push_back(comparison());
  views.back().is_alone = true;
  views.push_back(production());
  views.back().is_alone = true;
  for (const SessionView& view : views) {
    HeadlessUi ui(width, height);
    RunViewState state;
    AfterSession after;
    const Drawn& drawn =
        ui.frame([&](Ui& frame) { (void)draw_run_view(frame, view, {}, after, state); });
    for (const Drawn::Widget& widget : drawn.widgets) {
      EXPECT_GE(widget.place.x, 0) << widget.name;
      EXPECT_GE(widget.place.y, 0) << widget.name;
      EXPECT_LE(widget.place.right(), width) << widget.name;
      EXPECT_LE(widget.place.bottom(), height) << widget.name;
      EXPECT_GT(widget.place.width, 20) << widget.name;
      for (const Drawn::Widget& other : drawn.widgets) {
        if (&other == &widget) continue;
        const bool apart = other.place.x >= widget.place.right() - 0.5f ||
                           widget.place.x >= other.place.right() - 0.5f ||
                           other.place.y >= widget.place.bottom() - 0.5f ||
                           widget.place.y >= other.place.bottom() - 0.5f;
        EXPECT_TRUE(apart) << widget.name << " lies over " << other.name << " in step "
                           << static_cast<int>(view.step) << " at " << width;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Screens, RunViewFits,
                         ::testing::Values(std::pair{1600.0f, 1000.0f},
                                           std::pair{1280.0f, 720.0f},
                                           std::pair{1920.0f, 1080.0f},
                                           std::pair{1024.0f, 700.0f}));

}  // namespace run_view_test
}  // namespace jnd::app::gui
