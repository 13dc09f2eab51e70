#include "app/operator/operated_session.h"

#include <algorithm>

#include "app/operator/operated_session_fixture.h"
#include "core/storage/flight_record.h"
#include "core/storage/integrity.h"
#include "support/small_disk.h"

namespace jnd::app {
namespace operated_session_test {

TEST_F(OperatedSessionTest, NothingIsStoredBeforeTheOperatorBegins) {
  open();
  EXPECT_EQ(view().step, Step::kBegin);
  pass(1.0);
  EXPECT_TRUE(kinds().empty());
  act(operate::Begin{});
  EXPECT_EQ(kinds().front(), "session_started");
  EXPECT_EQ(view().step, Step::kItem);
}

TEST_F(OperatedSessionTest, AWholeSessionIsCompleteAndVerifies) {
  open();
  act(operate::Begin{});
  for (int guard = 0; guard < 1000 && view().step != Step::kFinished; ++guard) {
    step_on(view());
  }
  EXPECT_EQ(view().step, Step::kFinished);
  EXPECT_TRUE(store_->completed(session_number_));
  EXPECT_EQ(store_->trials(session_number_).size(), static_cast<std::size_t>(kTinyTrials));
  session_.reset();
  const core::Integrity integrity = core::verify(*store_);
  EXPECT_TRUE(integrity.complete);
  EXPECT_TRUE(integrity.problems.empty());
}

TEST_F(OperatedSessionTest, AnAnswerCountsForTheTrialThatWasSeenAndNoOther) {
  open();
  const SessionView ready = run_to_block("comparison");
  const std::int64_t trial = ready.trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  act(operate::Present{trial, "test"});
  pass(0.5);
  // The key bounces, so the answer arrives twice at one step.
  session_->request(operate::Answer{trial, 1.0});
  const SessionView after = act(operate::Answer{trial, 1.0});
  EXPECT_EQ(after.trial->trial, trial + 1);
  EXPECT_EQ(after.refusal, "that trial is answered already");
  EXPECT_EQ(std::ranges::count(kinds(), "trial_answered"), 7);
}

TEST_F(OperatedSessionTest, AnAnswerPressedWhileTheMediumStillChangesIsKeptAndCarriedOutAfter) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  session_->request(operate::Present{trial, "test"});
  session_->request(operate::Answer{trial, 0.0});
  pass(0.02);
  EXPECT_EQ(view().step, Step::kPresenting) << "the ramp takes 50 ms";
  pass(0.05);
  EXPECT_EQ(view().trial->trial, trial + 1);
  EXPECT_EQ(store_->trials(session_number_).back().response, 0.0);
}

TEST_F(OperatedSessionTest, AnUndoTakesBackTheAnswerThatStillWaitsAndNotTheOneBefore) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  answer_trial(view(), 0.0);
  pass(1.0);
  act(operate::Present{trial + 1, "reference"});
  pass(0.5);
  session_->request(operate::Present{trial + 1, "test"});
  session_->request(operate::Answer{trial + 1, 1.0});
  session_->request(operate::Undo{"too fast"});
  pass(0.2);
  EXPECT_EQ(std::ranges::count(kinds(), "answer_undone"), 0);
  EXPECT_EQ(view().trial->trial, trial + 1) << "it waits for another answer";
  session_->request(operate::Answer{trial + 1, 0.0});
  pass(0.2);
  EXPECT_EQ(store_->trials(session_number_).back().trial, trial + 1);
  EXPECT_EQ(store_->trials(session_number_).back().response, 0.0);
}

TEST_F(OperatedSessionTest, NoAnswerIsLostToAPauseThatCameWhileTheMediumStillChanged) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  session_->request(operate::Present{trial, "test"});
  session_->request(operate::Answer{trial, 1.0});
  session_->request(operate::Pause{"a cough"});
  pass(0.2);
  EXPECT_EQ(view().step, Step::kPaused);
  EXPECT_EQ(store_->trials(session_number_).back().trial, trial);
  EXPECT_EQ(store_->trials(session_number_).back().response, 1.0);
}

TEST_F(OperatedSessionTest, ANoteNeedsWords) {
  open();
  act(operate::Begin{});
  EXPECT_EQ(act(operate::AddNote{" \t "}).refusal, "expected a note, found no words");
}

TEST_F(OperatedSessionTest, AStudyFolderThatIsTakenAwayStopsTheSession) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  std::filesystem::rename(folder_, folder_.parent_path() / "elsewhere.study");
  answer_trial(view(), 1.0);
  EXPECT_EQ(view().step, Step::kFailed);
  EXPECT_NE(view().fault.find("found it moved or deleted"), std::string::npos) << view().fault;
  EXPECT_EQ(view().telemetry.total_force_n, (core::PlainVector{}));
  (void)trial;
}

TEST_F(OperatedSessionTest, TheReferenceComesFirstAndTheTestBeforeTheAnswer) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  EXPECT_EQ(act(operate::Present{trial, "test"}).refusal, "the reference comes first");
  act(operate::Present{trial, "reference"});
  pass(0.5);
  EXPECT_EQ(act(operate::Answer{trial, 1.0}).refusal, "the test has not been felt yet");
  EXPECT_FALSE(view().trial->can_answer);
}

TEST_F(OperatedSessionTest, ThePresentationIsStoredWithWhatWasDelivered) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(9.0);
  act(operate::Present{trial, "test"});
  EXPECT_NEAR(view().trial->first_felt_s.value(), 9.0, 0.1);
  pass(1.0);
  act(operate::Answer{trial, 1.0});
  const std::vector<core::PresentationRow> rows = store_->presentations(session_number_);
  const core::PresentationRow& reference = rows.at(rows.size() - 2);
  EXPECT_EQ(reference.interval, "reference");
  EXPECT_EQ(reference.intensity, 8.0);
  ASSERT_TRUE(reference.measures.delivered_damping_n_s_per_m.has_value());
  EXPECT_NEAR(*reference.measures.delivered_damping_n_s_per_m,
              *reference.measures.commanded_damping_n_s_per_m,
              0.05 * *reference.measures.commanded_damping_n_s_per_m);
  EXPECT_GE(reference.measures.num_strokes, 1);
  EXPECT_EQ(rows.back().interval, "test");
}

TEST_F(OperatedSessionTest, UndoTakesTheLastAnswerBackAndItsTrialIsRunAgain) {
  open();
  SessionView now = run_to_block("comparison");
  const std::int64_t first = now.trial->trial;
  answer_trial(now, 1.0);
  now = view();
  act(operate::Present{now.trial->trial, "reference"});
  EXPECT_TRUE(now.answers.front().can_undo);
  now = act(operate::Undo{"wrong key"});
  EXPECT_EQ(now.trial->trial, first);
  EXPECT_EQ(now.refusal, "");
  answer_trial(view(), 0.0);
  const core::TrialRow row = store_->trials(session_number_).back();
  EXPECT_EQ(row.trial, first);
  EXPECT_EQ(row.attempt, 2);
  EXPECT_EQ(row.response, 0.0);
}

TEST_F(OperatedSessionTest, TheLastAnswerOfABlockCanStillBeUndone) {
  open();
  SessionView now = run_to_block("production");
  while (now.step != Step::kStageDone) {
    step_on(now);
    now = view();
  }
  EXPECT_TRUE(now.answers.front().can_undo);
  now = act(operate::Undo{"slipped"});
  EXPECT_EQ(now.step, Step::kReady);
  EXPECT_EQ(act(operate::Undo{""}).refusal, "expected a reason, found none");
}

TEST_F(OperatedSessionTest, AnEarlierAnswerIsSetRightWithoutTouchingItsPresentations) {
  open();
  SessionView now = run_to_block("comparison");
  act(operate::Correct{1, 250.0, "misheard"});
  EXPECT_EQ(store_->trials(session_number_).front().response, 250.0);
  EXPECT_EQ(view().trial->trial, now.trial->trial);
}

TEST_F(OperatedSessionTest, EachStepOfAProductionIsFeltAndStored) {
  open();
  const SessionView ready = run_to_block("production");
  const std::int64_t trial = ready.trial->trial;
  act(operate::Present{trial, "test"});
  pass(0.5);
  using experiments::Direction;
  using experiments::StepSize;
  act(operate::Adjust{trial, Direction::kRaise, StepSize::kCoarse});
  pass(0.1);
  act(operate::Adjust{trial, Direction::kLower, StepSize::kFine});
  pass(0.1);
  const double start = *ready.trial->target_percent > 0
                           ? store_->design(session_number_)
                                 .at(static_cast<std::size_t>(trial - 1))
                                 .starting_intensity.value()
                           : 0.0;
  act(operate::Answer{trial, 0.0});
  const core::TrialRow row = store_->trials(session_number_).back();
  EXPECT_DOUBLE_EQ(row.response.value(), start + 0.25);
  EXPECT_EQ(row.num_steps, 2);
  EXPECT_EQ(row.num_presentations, 3);
}

TEST_F(OperatedSessionTest, WhereLevelsAreHiddenTheEndOfTheRangeLooksLikeAnyStep) {
  open(replaced(kTinyStudy, R"("name": "tiny",)", R"("name": "tiny", "blinding": "double",)"));
  const std::int64_t trial = run_to_block("production").trial->trial;
  act(operate::Present{trial, "test"});
  for (int i = 0; i < 30; ++i) {
    pass(0.3);
    const SessionView now =
        act(operate::Adjust{.trial = trial, .direction = experiments::Direction::kLower});
    EXPECT_EQ(now.refusal, "");
    ASSERT_TRUE(now.trial);
    EXPECT_LT(now.trial->felt_s, 0.1) << "the time begins again, as after any step: " << i;
  }
  EXPECT_LT(std::ranges::count(kinds(), "intensity_adjusted"), 30);
}

TEST_F(OperatedSessionTest, AHeldKeyDoesNotPileUpSteps) {
  open();
  const std::int64_t trial = run_to_block("production").trial->trial;
  act(operate::Present{trial, "test"});
  pass(0.5);
  for (int repeat = 0; repeat < 20; ++repeat) {
    session_->request(operate::Adjust{.trial = trial, .held = repeat > 0});
  }
  for (int i = 0; i < 10; ++i) pass(0.06);
  EXPECT_EQ(std::ranges::count(kinds(), "intensity_adjusted"), 1);
  // Three taps are three steps, however fast they follow.
  for (int tap = 0; tap < 3; ++tap) session_->request(operate::Adjust{.trial = trial});
  for (int i = 0; i < 10; ++i) pass(0.06);
  EXPECT_EQ(std::ranges::count(kinds(), "intensity_adjusted"), 4);
}

TEST_F(OperatedSessionTest, TheEmergencyStopPausesAndTheTrialIsRunAgainAfterArming) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  exchange_.emergency_stop.press();
  pass(0.1);
  SessionView now = view();
  EXPECT_EQ(now.step, Step::kFault);
  EXPECT_EQ(now.fault_name, "emergency_stop");
  EXPECT_EQ(kinds().back(), "attempt_discarded");
  EXPECT_EQ(core::flight_records(store_->recording_file(session_number_)).size(), 1U);
  EXPECT_EQ(act(operate::Answer{trial, 1.0}).refusal, "the device has to be armed first");
  EXPECT_EQ(act(operate::GoOn{}).refusal, "the device has to be armed first");
  EXPECT_EQ(act(operate::Rearm{}).refusal, "the emergency stop is pressed: release it first");
  EXPECT_EQ(act(operate::ReleaseStop{now.num_stop_presses - 1}).refusal,
            "the emergency stop was pressed again");
  EXPECT_TRUE(exchange_.emergency_stop.is_pressed());
  EXPECT_EQ(act(operate::ReleaseStop{now.num_stop_presses}).step, Step::kFault)
      << "releasing is no arming";
  act(operate::Rearm{});
  pass(0.1);
  now = view();
  EXPECT_FALSE(exchange_.emergency_stop.is_pressed());
  EXPECT_EQ(now.step, Step::kReady);
  expect_it_comes_later(trial);
}

TEST_F(OperatedSessionTest, APauseDiscardsTheAttemptAndGoingOnRunsTheTrialAgain) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  EXPECT_EQ(act(operate::Pause{"a cough"}).step, Step::kPaused);
  EXPECT_EQ(act(operate::Present{trial, "test"}).refusal, "the session is paused");
  EXPECT_EQ(act(operate::GoOn{}).step, Step::kReady);
  EXPECT_EQ(view().trial->trial, trial);
  act(operate::AddNote{"coughed"});
  EXPECT_EQ(view().notes, std::vector<std::string>{"coughed"});
  act(operate::ReportAdverseEvent{"a pinched finger"});
  ASSERT_EQ(store_->adverse_events().size(), 1u);
  EXPECT_EQ(store_->adverse_events()[0].text, "a pinched finger");
  EXPECT_EQ(store_->adverse_events()[0].session, session_number_);
  EXPECT_EQ(act(operate::ReportAdverseEvent{" "}).refusal,
            "expected what happened, found no words");
}

TEST_F(OperatedSessionTest, WhoLeavesFindsTheSessionAgainAndRepeatsTheTrial) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.3);
  act(operate::Leave{});
  EXPECT_TRUE(session_->over());
  reopen();
  EXPECT_EQ(view().step, Step::kBegin);
  EXPECT_EQ(view().heading, "Interrupted");
  act(operate::Begin{"repeat"});
  EXPECT_EQ(view().trial->trial, trial);
  EXPECT_EQ(view().step, Step::kReady);
  session_.reset();
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

TEST_F(OperatedSessionTest, ASessionGoesOnInTheLanguageItWasBegunIn) {
  open();
  EXPECT_EQ(view().language, "en");
  act(operate::Begin{});
  EXPECT_EQ(store_->events(session_number_).front().data, R"({"language":"en"})");
  reopen();
  EXPECT_EQ(view().language, "en");
}

TEST_F(OperatedSessionTest, ABreakIsLeftEarlyOnlyWithAReason) {
  open();
  act(operate::Begin{});
  while (view().step != Step::kBreak) step_on(view());
  const std::int64_t stage = view().stage;
  EXPECT_NEAR(view().break_left_s, 60.0, 0.5);
  EXPECT_NE(act(operate::FinishStage{stage, ""}).refusal, "");
  EXPECT_EQ(view().step, Step::kBreak);
  act(operate::FinishStage{stage, "the participant wants to"});
  EXPECT_EQ(view().stage, stage + 1);
  EXPECT_EQ(view().notes.back(),
            "went on before the end of the rest: the participant wants to");
}

TEST_F(OperatedSessionTest, AnAnswerOfAQuestionnaireCanBeGivenAgainUntilItIsFinished) {
  open();
  act(operate::Begin{});
  while (!(view().step == Step::kItem && view().item->name == "body_height_m")) step_on(view());
  const std::int64_t stage = view().stage;
  act(operate::AnswerItem{stage, "body_height_m", "1.7"});
  EXPECT_EQ(view().step, Step::kStageDone);
  EXPECT_EQ(view().answered_items.front().answer, "1.7");
  act(operate::AnswerItem{stage, "body_height_m", "1.8"});
  act(operate::FinishStage{stage, ""});
  EXPECT_EQ(view().step, Step::kFinished);
  EXPECT_EQ(store_->answers(session_number_).back().answer, "1.8");
}

TEST_F(OperatedSessionTest, ADoubleBlindViewHoldsNoLevelNoForceAndNoName) {
  open(replaced(
      replaced(kTinyStudy, R"("name": "tiny",)", R"("name": "tiny", "blinding": "double",)"),
      R"("name": "comparison",)", R"("name": "thick_comparison",)"));
  SessionView now = run_to_block("thick_comparison");
  act(operate::Present{now.trial->trial, "reference"});
  pass(1.0);
  now = view();
  EXPECT_TRUE(now.hides_levels);
  EXPECT_EQ(now.trial->level, "");
  EXPECT_EQ(now.trial->num_strokes, 0);
  EXPECT_EQ(now.telemetry.total_force_n, core::PlainVector{});
  EXPECT_EQ(now.telemetry.hand_velocity_m_per_s, core::PlainVector{});
  EXPECT_EQ(now.heading, "Reference");
  for (const StageLine& stage : now.stages) {
    EXPECT_EQ(stage.title.find("thick"), std::string::npos) << stage.title;
  }
  for (const AnswerLine& answer : now.answers) {
    EXPECT_TRUE(answer.block.starts_with("Block ")) << answer.block;
    if (answer.form.kind == experiments::AnswerKind::kMatch) {
      EXPECT_EQ(answer.answer, "set");
    }
  }
  // The view shows neither a path nor any part of a picture.
  const core::Sample& sample = now.telemetry.sample;
  EXPECT_EQ(sample.tip_position_m, decltype(sample.tip_position_m){});
  EXPECT_EQ(sample.tip_velocity_m_per_s, decltype(sample.tip_velocity_m_per_s){});
  EXPECT_EQ(sample.tip_force_n, decltype(sample.tip_force_n){});
  EXPECT_EQ(sample.joint_position_rad, decltype(sample.joint_position_rad){});
  EXPECT_EQ(sample.joint_torque_n_m, decltype(sample.joint_torque_n_m){});
  EXPECT_TRUE(trace_.snapshot().empty());
  EXPECT_TRUE(scopes_.snapshot({"index_force_x_n"}).channels[0].empty());
}

TEST_F(OperatedSessionTest, AnOpenStudyShowsTheLevel) {
  open();
  SessionView now = run_to_block("comparison");
  EXPECT_NE(now.trial->level.find("reference 8 Pa s"), std::string::npos) << now.trial->level;
  EXPECT_FALSE(trace_.snapshot().empty());
  EXPECT_FALSE(scopes_.snapshot({"index_force_x_n"}).channels[0].empty());
}

TEST_F(OperatedSessionTest, ARefusalSaysWhyAndChangesNothing) {
  open();
  act(operate::Begin{});
  const std::size_t num_events = kinds().size();
  const SessionView now = act(operate::FinishStage{view().stage, ""});
  EXPECT_EQ(now.refusal, "the stage is not done yet");
  EXPECT_EQ(now.num_refusals, 1U);
  EXPECT_EQ(kinds().size(), num_events);
}

TEST_F(OperatedSessionTest, HowTheDeviceWasFittedIsKeptWhereTheSessionBegins) {
  fitting_ = {{"glove", "M"}};
  open();
  act(operate::Begin{});
  const auto num_kept = [this] {
    const std::vector<core::EventRow> events = store_->events(session_number_);
    return std::count_if(events.begin(), events.end(), [](const core::EventRow& event) {
      return event.kind == "fitting_kept" &&
             event.data.find(R"("glove":"M")") != std::string::npos;
    });
  };
  EXPECT_EQ(num_kept(), 1);
  reopen();
  act(operate::Begin{"repeat"});
  EXPECT_EQ(num_kept(), 1) << "not again where it is gone on with";
}

}  // namespace operated_session_test
}  // namespace jnd::app
