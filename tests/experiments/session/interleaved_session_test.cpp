#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "experiments/order/block_turns.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"
#include "experiments/session/session_in_memory.h"

// Tests blocks whose trials are mixed: each stays itself, and they take turns.

namespace jnd::experiments {
namespace interleaved_session_test {

constexpr char kStudy[] = R"json({
  "format": 1, "name": "mixed", "languages": ["en"], "title": {"en": "Mixed"},
  "authors": ["A. Author"],
  "stages": [
    {"kind": "break", "name": "rest", "instruction": {"en": "Rest."}, "duration_s": 1},
    {"kind": "interleaved", "name": "group", "turns": "TURNS", "blocks": [
      {"kind": "block", "name": "constant", "procedure": "constant_stimuli",
       "medium": "viscous", "viscosity_pa_s": [1, 2, 4], "reference_viscosity_pa_s": 2.5,
       "repetitions": 2, "feedback": true, "instruction": {"en": "Compare."},
       "question": {"en": "Thicker?"}, "expected_trial_s": 5},
      {"kind": "block", "name": "adaptive", "procedure": "staircase", "medium": "viscous",
       "task": "reminder", "reference_viscosity_pa_s": 10, "start_viscosity_pa_s": [30],
       "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 100, "level_scale": "logarithmic",
       "step_ratio": [2], "num_up": 1, "num_down": 1, "max_reversals": 20, "max_trials": 5,
       "num_reversals_averaged": 2, "answer_deadline_s": 4, "instruction": {"en": "Compare."},
       "question": {"en": "Thicker?"}, "expected_trial_s": 5},
      {"kind": "block", "name": "rated", "procedure": "rating", "medium": "viscous",
       "viscosity_pa_s": [1, 2], "repetitions": 2, "num_steps": 7,
       "low_label": {"en": "thin"}, "high_label": {"en": "thick"},
       "questions": [{"name": "sure", "kind": "yes_no", "question": {"en": "Sure?"}}],
       "instruction": {"en": "Rate."}, "question": {"en": "How thick?"},
       "expected_trial_s": 5}]},
    {"kind": "block", "name": "after", "procedure": "constant_stimuli", "medium": "viscous",
     "viscosity_pa_s": [1, 4], "reference_viscosity_pa_s": 2, "repetitions": 1,
     "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
     "expected_trial_s": 5}]})json";

Study study_with(const std::string& turns) {
  std::string text = kStudy;
  text.replace(text.find("TURNS"), 5, turns);
  return read_study_text(text, "study.json");
}

constexpr std::int64_t kConstant = 1, kAdaptive = 2, kRated = 3, kAfter = 4;

class InterleavedSessionTest : public ::testing::TestWithParam<const char*> {
 protected:
  InterleavedSessionTest() {
    for (const Stage& stage : study_.stages) stages_.push_back(&stage);
  }

  Session session(const std::vector<core::EventRow>& history = {}) {
    return Session({.session = 1, .seed = 42, .stages = stages_}, history, log_, clock_);
  }
  /// A session in the group of blocks, before its first trial.
  Session begun() {
    Session s = session();
    s.start();
    s.enter_stage();
    s.finish_stage();
    s.enter_stage();
    return s;
  }
  static void start_and_feel(Session& s) {
    s.start_trial(s.state().last_tick + 1);
    if (s.current_form().has_reference) present(s, "reference");
    present(s, "test");
  }
  /// Answers as somebody does who says "thicker" of what is thicker.
  static void answer_trial(Session& s) {
    const TrialState& trial = s.state().trial(*s.state().current_trial());
    const double level = trial.planned.intensity.value();
    const double answer = s.state().stage == kRated
                              ? level
                              : (level > trial.planned.reference_intensity.value() ? 1.0 : 0.0);
    s.answer(answer, {.response_time_s = 1.0}, s.state().last_tick);
  }
  static void run_trial(Session& s) {
    start_and_feel(s);
    answer_trial(s);
    if (s.open_question()) s.answer_question("sure", "yes");
  }
  /// Runs the session to its end from wherever it is. Returns the stages of the trials in the
  /// order in which they are run.
  static std::vector<std::int64_t> run_on(Session& s) {
    std::vector<std::int64_t> turns;
    while (s.current_stage() != nullptr) {
      if (!s.state().stage_open) s.enter_stage();
      if (s.open_question()) s.answer_question("sure", "yes");
      while (s.state().current_trial()) {
        turns.push_back(s.state().stage);
        run_trial(s);
      }
      s.finish_stage();
    }
    return turns;
  }
  /// What was answered, block by block, in the order of the answers.
  static std::vector<std::string> answered(const Session& s) {
    std::vector<std::pair<std::int64_t, std::string>> all;
    for (const TrialState& trial : s.state().trials) {
      if (!trial.is_answered) continue;
      all.emplace_back(trial.answer_sequence,
                       std::to_string(trial.stage) + ": " +
                           std::to_string(trial.planned.intensity.value()) + " " +
                           std::to_string(trial.response.value()));
    }
    std::ranges::sort(all);
    std::vector<std::string> answers;
    for (const auto& [sequence, words] : all) answers.push_back(words);
    return answers;
  }
  static std::vector<std::int64_t> turns_of(const std::vector<core::EventRow>& events) {
    std::vector<std::int64_t> turns;
    for (const core::EventRow& row : events) {
      if (row.kind == "turn_taken") turns.push_back(row.stage.value());
    }
    return turns;
  }

  Study study_ = study_with(GetParam());
  std::vector<const Stage*> stages_;
  MemoryLog log_;
  core::SimulatedClock clock_;
};

INSTANTIATE_TEST_SUITE_P(Turns, InterleavedSessionTest, ::testing::Values("rounds", "random"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(InterleavedSessionTest, MixesTheTrialsOfItsBlocksAndEachStaysItself) {
  Session s = begun();
  EXPECT_EQ(s.current_stages(), (std::vector<std::int64_t>{kConstant, kAdaptive, kRated}));
  EXPECT_EQ(s.state().trials.size(), 6U + 1U + 4U) << "the staircase draws one by one";
  const std::vector<std::int64_t> turns = run_on(s);
  const std::vector<std::int64_t> in_group(turns.begin(), turns.begin() + 6 + 5 + 4);
  EXPECT_EQ(std::ranges::count(in_group, kConstant), 6);
  EXPECT_EQ(std::ranges::count(in_group, kAdaptive), 5);
  EXPECT_EQ(std::ranges::count(in_group, kRated), 4);
  EXPECT_FALSE(std::ranges::is_sorted(in_group));
  EXPECT_EQ(turns.size(), 17U) << "the block after them is by itself";
  for (const core::TrialRow& row : log_.trials) {
    EXPECT_EQ(row.block,
              stages_[static_cast<std::size_t>(s.state().trial(row.trial).stage)]->name);
  }
  // Each block has the answers that it would have alone.
  std::vector<double> levels;
  for (const AnsweredTrial& trial : s.state().answered_in(kAdaptive)) {
    levels.push_back(*trial.planned.intensity);
  }
  const std::vector<double> alone = {30.0, 15.0, 7.5, 15.0, 7.5};
  ASSERT_EQ(levels.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_NEAR(levels[i], alone[i], 1e-9) << i;
  // The group was finished as one stage.
  std::vector<std::int64_t> finished;
  for (const core::EventRow& row : log_.events) {
    if (row.kind == "stage_finished") finished.push_back(row.stage.value());
  }
  EXPECT_EQ(finished, (std::vector<std::int64_t>{0, kRated, kAfter}));
}

TEST_P(InterleavedSessionTest, InRoundsAllKeepPace) {
  Session s = begun();
  const std::vector<std::int64_t> turns = run_on(s);
  if (GetParam() != std::string("rounds")) {
    EXPECT_NE(std::set(turns.begin(), turns.begin() + 12).size(), 1U);
    return;
  }
  for (int round = 0; round < 4; ++round) {
    EXPECT_EQ(std::set(turns.begin() + 3 * round, turns.begin() + 3 * round + 3).size(), 3U)
        << round;
  }
  EXPECT_EQ(std::set(turns.begin() + 12, turns.begin() + 14),
            (std::set<std::int64_t>{kConstant, kAdaptive}));
  EXPECT_EQ(turns[14], kConstant);
}

TEST_P(InterleavedSessionTest, ResumedAtAnyEventItGoesOnAsAnUninterruptedOneWould) {
  Session whole = begun();
  (void)run_on(whole);
  const std::vector<core::EventRow> complete = log_.events;
  const std::vector<std::string> expected = answered(whole);
  ASSERT_EQ(expected.size(), 17U);
  int num_between = 0;
  for (std::size_t cut = 1; cut < complete.size(); ++cut) {
    log_.events.assign(complete.begin(), complete.begin() + static_cast<std::ptrdiff_t>(cut));
    const std::string& next = complete[cut].kind;
    num_between += next == "turn_taken" || next == "trials_drawn" ? 1 : 0;
    Session s = session(log_.events);
    s.resume("repeat", 0, -1);
    (void)run_on(s);
    EXPECT_EQ(answered(s), expected) << "interrupted after event " << cut;
    // Nothing is drawn twice, and no turn is lost.
    EXPECT_EQ(turns_of(log_.events), turns_of(complete)) << "interrupted after event " << cut;
    EXPECT_EQ(s.state().trials.size(), whole.state().trials.size()) << cut;
  }
  EXPECT_GT(num_between, 15) << "the moments that this is about";
}

TEST_P(InterleavedSessionTest, ReplayingTheLogGivesTheSameTurn) {
  Session s = begun();
  for (int i = 0; i < 4; ++i) {
    run_trial(s);
    const Session again = session(log_.events);
    EXPECT_EQ(again.state().stage, s.state().stage);
    EXPECT_EQ(again.state().current_trial(), s.state().current_trial());
    EXPECT_EQ(again.current_stages(), s.current_stages());
  }
}

TEST_P(InterleavedSessionTest, AnAnswerIsTakenBackWhicheverBlockItIsOfAndTurnsStay) {
  Session s = begun();
  // Each element is a stage and a trial.
  std::vector<std::pair<std::int64_t, std::int64_t>> run;
  for (int i = 0; i < 9; ++i) {
    run.emplace_back(s.state().stage, *s.state().current_trial());
    run_trial(s);
  }
  const std::vector<std::int64_t> turns = turns_of(log_.events);
  const std::size_t num_drawn = s.state().trials.size();
  for (int i = 8; i >= 3; --i) {
    s.undo("misheard");
    EXPECT_EQ(s.state().stage, run[static_cast<std::size_t>(i)].first) << i;
    EXPECT_EQ(s.state().current_trial(), run[static_cast<std::size_t>(i)].second) << i;
  }
  // The waiting trials of blocks whose answers stand are not drawn anew.
  int num_void = 0;
  for (const TrialState& trial : s.state().trials) num_void += trial.is_void ? 1 : 0;
  const auto num_adaptive = std::count_if(
      run.begin() + 3, run.end(), [](const auto& one) { return one.first == kAdaptive; });
  EXPECT_EQ(num_void, num_adaptive) << "one for each that was taken back of the staircase";
  EXPECT_EQ(s.state().trials.size(), num_drawn);
  for (int i = 3; i < 9; ++i) {
    EXPECT_EQ(s.state().stage, run[static_cast<std::size_t>(i)].first) << "the turns of before";
    run_trial(s);
  }
  const std::vector<std::int64_t> now = turns_of(log_.events);
  EXPECT_EQ(std::vector(now.end() - 6, now.end()), std::vector(turns.end() - 6, turns.end()));
  (void)run_on(s);
  EXPECT_EQ(answered(s).size(), 17U);
}

TEST_P(InterleavedSessionTest, NothingIsTakenBackAcrossTheEndOfTheGroup) {
  Session s = begun();
  while (s.state().current_trial()) run_trial(s);
  EXPECT_NO_THROW(s.require_undo()) << "it is not finished yet";
  s.undo("misheard");
  run_trial(s);
  s.finish_stage();
  EXPECT_THROW(s.require_undo(), core::Error);
  s.enter_stage();
  EXPECT_EQ(s.current_stages(), std::vector<std::int64_t>{kAfter});
  EXPECT_THROW(s.require_undo(), core::Error);
}

TEST_P(InterleavedSessionTest, ItEndsWhenAllBlocksDo) {
  Session s = begun();
  for (int i = 0; i < 14; ++i) {
    EXPECT_THROW(s.finish_stage(), core::Error) << i;
    run_trial(s);
  }
  EXPECT_THROW(s.finish_stage(), core::Error) << "one is left";
  run_trial(s);
  EXPECT_NO_THROW(s.finish_stage());
}

TEST_P(InterleavedSessionTest, TheNextTurnIsDrawnAfterTheLastQuestion) {
  Session s = begun();
  while (s.state().stage != kRated) run_trial(s);
  start_and_feel(s);
  answer_trial(s);
  const std::size_t num_turns = turns_of(log_.events).size();
  ASSERT_TRUE(s.open_question());
  EXPECT_EQ(s.state().stage, kRated) << "who is asked is asked by the block of the trial";
  EXPECT_EQ(log_.events.back().kind, "trial_answered");
  EXPECT_THROW(s.start_trial(1000), core::Error);
  s.answer_question("sure", "no");
  EXPECT_EQ(log_.commits.at(log_.commits.size() - 2).question_answer->block, "rated");
  EXPECT_EQ(turns_of(log_.events).size(), num_turns + 1);
}

TEST_P(InterleavedSessionTest, WhatIsPutOffComesWithALaterTurnOfItsBlock) {
  // This holds for any block and after any number of answers.
  for (int num_before = 0; num_before < 13; ++num_before) {
    log_ = {};
    Session s = begun();
    for (int i = 0; i < num_before; ++i) run_trial(s);
    const std::int64_t stage = s.state().stage;
    const std::int64_t trial = *s.state().current_trial();
    start_and_feel(s);
    if (stage == kAdaptive) {
      s.miss_deadline();
      EXPECT_TRUE(s.state().missed_deadline);
    } else {
      s.put_off_attempt("the machine was busy");
    }
    EXPECT_EQ(log_.events.back().kind, "turn_taken") << "the turn passes";
    if (stage == kAdaptive) {
      EXPECT_EQ(s.state().trial(trial).again_after, 0) << "its answers decide what comes next";
    }
    (void)run_on(s);
    EXPECT_EQ(answered(s).size(), 17U) << num_before;
    EXPECT_EQ(s.state().trial(trial).attempt, 2);
    EXPECT_EQ(s.state().answered_in(kAdaptive).size(), 5U);
  }
}

TEST_P(InterleavedSessionTest, WhatIsPutOffPassesTheTurnAlsoAfterAnInterruption) {
  Session s = begun();
  run_trial(s);
  start_and_feel(s);
  s.put_off_attempt("the machine was busy");
  const std::int64_t next = s.state().stage;
  ASSERT_EQ(log_.events.back().kind, "turn_taken");
  log_.events.pop_back();
  Session again = session(log_.events);
  again.resume("repeat", 0, -1);
  EXPECT_EQ(again.state().stage, next);
  EXPECT_EQ(turns_of(log_.events).size(), 3U);
}

TEST_P(InterleavedSessionTest, AnAttemptThatIsGivenUpKeepsItsTurn) {
  Session s = begun();
  run_trial(s);
  const std::int64_t stage = s.state().stage;
  const std::int64_t trial = *s.state().current_trial();
  start_and_feel(s);
  s.discard_attempt("paused");
  EXPECT_EQ(s.state().stage, stage);
  EXPECT_EQ(s.state().current_trial(), trial);
}

TEST_P(InterleavedSessionTest, BeginsAnewTogether) {
  Session s = begun();
  const std::int64_t first = *s.state().current_trial();
  std::vector<std::int64_t> turns;
  for (int i = 0; i < 8; ++i) {
    turns.push_back(s.state().stage);
    run_trial(s);
  }
  start_and_feel(s);
  s.restart_block("misunderstood the task");
  EXPECT_TRUE(s.state().answered_in(kConstant).empty());
  EXPECT_TRUE(s.state().answered_in(kAdaptive).empty());
  EXPECT_TRUE(s.state().answered_in(kRated).empty());
  EXPECT_EQ(s.state().current_trial(), first);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(s.state().stage, turns[static_cast<std::size_t>(i)]) << "the order stays";
    run_trial(s);
  }
  (void)run_on(s);
  EXPECT_EQ(answered(s).size(), 17U);
}

TEST_P(InterleavedSessionTest, FeedbackAndCorrectionsAreThoseOfTheTrialsBlock) {
  Session s = begun();
  while (s.state().stage != kConstant) {
    run_trial(s);
    EXPECT_FALSE(s.state().feedback_right.has_value());
  }
  const std::int64_t trial = *s.state().current_trial();
  start_and_feel(s);
  answer_trial(s);
  EXPECT_TRUE(s.state().feedback_right.has_value());
  while (s.state().stage != kRated) run_trial(s);
  s.correct(trial, 0.0, "misheard");
  EXPECT_EQ(log_.commits.back().trial->block, "constant");
  EXPECT_THROW(s.correct(trial, 5.0, "no step of a scale"), core::Error);
}

TEST_P(InterleavedSessionTest, ACorrectionBesideAnOpenQuestionLosesNothingAndResumes) {
  Session s = begun();
  const auto is_open = [&s] { return s.open_question().has_value(); };
  while (s.state().answered_in(kAdaptive).empty() || s.state().answered_in(kConstant).empty() ||
         !is_open()) {
    if (is_open()) s.answer_question("sure", "yes");
    start_and_feel(s);
    answer_trial(s);
  }
  const OpenQuestion open = s.open_question().value();
  std::int64_t of_staircase = 0, of_constant = 0;
  for (std::int64_t number = 1; number <= std::ssize(s.state().trials); ++number) {
    const TrialState& trial = s.state().trial(number);
    if (trial.stage == kAdaptive && trial.is_answered) of_staircase = number;
    if (trial.stage == kConstant && trial.is_answered) of_constant = number;
  }
  s.correct(of_staircase, 0.0, "misheard");
  s.correct(of_staircase, 1.0, "was right");
  ASSERT_TRUE(is_open());
  EXPECT_EQ(s.open_question()->trial, open.trial);
  ASSERT_GT(of_constant, 0);
  EXPECT_THROW(s.run_again(of_constant, "misheard"), core::Error)
      << "the question would be lost with the turn";
  Session resumed = session(log_.events);
  resumed.resume("repeat", 0, -1);
  ASSERT_TRUE(resumed.open_question().has_value());
  EXPECT_EQ(resumed.open_question()->trial, open.trial);
  (void)run_on(resumed);
  for (const TrialState& trial : resumed.state().trials) {
    if (trial.stage != kRated) continue;
    EXPECT_EQ(trial.question_answers.size(), 1U);
  }
}

TEST_P(InterleavedSessionTest, APlanTellsTheOrderOfBlocksWhoseLengthIsKnown) {
  Study study = study_with(GetParam());
  std::erase_if(study.stages, [](const Stage& stage) { return stage.name == "adaptive"; });
  const ParticipantPlan plan =
      plan_participants(study, {.participants = {"P01"}, .seed = 9}).front();
  ASSERT_EQ(plan.groups.size(), 1U);
  EXPECT_EQ(plan.groups[0].name, "group");
  ASSERT_EQ(plan.groups[0].order.size(), 10U);
  std::vector<const Stage*> stages;
  for (const StageInstance& instance : plan.stages) stages.push_back(instance.stage);
  Session s({.session = 1,
             .seed = session_seed(9, study.name, "P01"),
             .stages = stages,
             .cell = plan.cell},
            {}, log_, clock_);
  s.start();
  s.enter_stage();
  s.finish_stage();
  s.enter_stage();
  for (const std::size_t index : plan.groups[0].order) {
    const std::string name = plan.groups[0].blocks[index]->name;
    EXPECT_EQ(s.current_stage()->name, name);
    const bool rates = name == "rated";
    start_and_feel(s);
    s.answer(rates ? 2.0 : 1.0, {.response_time_s = 1.0}, s.state().last_tick);
    if (s.open_question()) s.answer_question("sure", "yes");
  }
  EXPECT_NO_THROW(s.finish_stage());
  EXPECT_TRUE(plan_participants(study_, {.participants = {"P01"}, .seed = 9})
                  .front()
                  .groups.front()
                  .order.empty())
      << "answers decide how long a staircase is";
}

}  // namespace interleaved_session_test
}  // namespace jnd::experiments
