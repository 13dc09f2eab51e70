#include <gtest/gtest.h>

#include "core/random_stream.h"
#include "experiments/adaptive/staircase.h"
#include "experiments/procedures/adaptive_trial.h"
#include "experiments/procedures/staircase_procedure.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session_in_memory.h"

namespace jnd::experiments {
namespace adaptive_session_test {

const std::string kStudy = R"json({
  "format": 1, "name": "adaptive", "languages": ["en"], "title": {"en": "Adaptive"},
  "authors": ["A. Author"],
  "stages": [{"kind": "block", "name": "stairs", "procedure": "staircase",
    "medium": "viscous", "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16, 4],
    "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [1.5, 1.2],
    "max_reversals": 6, "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
    "expected_trial_s": 5}]})json";

/// Tests a block whose trials are drawn one after the other.
class AdaptiveSessionTest : public ::testing::Test {
 protected:
  Session session() {
    return Session({.session = 1, .seed = 42, .stages = {&study_.stages.front()}}, log_.events,
                   log_, clock_);
  }
  Session begun() {
    Session s = session();
    s.start();
    s.enter_stage();
    return s;
  }
  static double level(const Session& s) {
    return s.state().trial(*s.state().current_trial()).planned.intensity.value();
  }
  static void run_trial(Session& s, double response) {
    s.start_trial(s.state().last_tick + 1);
    present(s, "reference");
    present(s, "test");
    s.answer(response, {.response_time_s = 1.5}, s.state().last_tick);
  }
  /// Answers "yes" above 6 Pa s, to the end of the block.
  static void run_to_end(Session& s) {
    while (s.state().current_trial()) run_trial(s, level(s) > 6.0 ? 1.0 : 0.0);
  }

  Study study_ = read_study_text(kStudy, "study.json");
  MemoryLog log_;
  core::SimulatedClock clock_;
};

TEST_F(AdaptiveSessionTest, ATrialThatCannotWaitForOthersIsRunAgainAtOnce) {
  Session s = begun();
  const std::int64_t trial = *s.state().current_trial();
  s.start_trial(0);
  s.put_off_attempt("came off: index");
  EXPECT_EQ(s.state().current_trial(), trial);
}

TEST_F(AdaptiveSessionTest, TheNextTrialIsDrawnWhenTheOneBeforeIsAnswered) {
  Session s = begun();
  EXPECT_EQ(s.state().trials.size(), 1U);
  run_trial(s, 1.0);
  EXPECT_EQ(s.state().trials.size(), 2U);
  run_to_end(s);
  EXPECT_GT(s.state().trials.size(), 20U);
  s.finish_stage();
  s.complete();
  EXPECT_TRUE(s.state().completed);
}

TEST_F(AdaptiveSessionTest, AnotherAnswerAfterAnUndoDrawsAnotherTrial) {
  Session s = begun();
  for (int trial = 0; trial < 6; ++trial) run_trial(s, level(s) > 6.0 ? 1.0 : 0.0);
  const double before = level(s);
  const auto answered = s.state().answered_in(0);
  const double undone = *answered.back().planned.intensity;
  const double response = *answered.back().response;
  s.undo("wrong key");
  EXPECT_EQ(level(s), undone) << "the trial itself is run again";
  EXPECT_TRUE(s.state().trials.back().is_void);
  run_trial(s, response);
  EXPECT_EQ(level(s), before) << "the same answer draws the same trial";
  s.undo("wrong after all");
  run_trial(s, 1.0 - response);
  EXPECT_EQ(s.state().answered_in(0).size(), 6U);
  run_to_end(s);
  s.finish_stage();
}

TEST_F(AdaptiveSessionTest, ARestartedBlockBeginsAnewAndEndsTheSame) {
  Session s = begun();
  for (int trial = 0; trial < 9; ++trial) run_trial(s, 1.0);
  s.restart_block("somebody came in");
  EXPECT_EQ(s.state().answered_in(0).size(), 0U);
  EXPECT_EQ(*s.state().current_trial(), 1);
  run_to_end(s);
  std::vector<double> levels;
  for (const AnsweredTrial& trial : s.state().answered_in(0)) {
    levels.push_back(*trial.planned.intensity);
  }

  log_.events.clear();
  Session other = begun();
  run_to_end(other);
  std::vector<double> undisturbed;
  for (const AnsweredTrial& trial : other.state().answered_in(0)) {
    undisturbed.push_back(*trial.planned.intensity);
  }
  EXPECT_EQ(levels, undisturbed);
}

TEST_F(AdaptiveSessionTest, AResumedSessionGoesOnAsAnUninterruptedOne) {
  Session s = begun();
  for (int trial = 0; trial < 7; ++trial) run_trial(s, level(s) > 6.0 ? 1.0 : 0.0);
  s.undo("wrong key");
  const std::vector<core::EventRow> half = log_.events;
  run_to_end(s);
  const std::size_t num_events = log_.events.size();
  const SessionState whole = s.state();

  log_.events = half;
  Session resumed = session();
  run_to_end(resumed);
  EXPECT_EQ(log_.events.size(), num_events);
  ASSERT_EQ(resumed.state().trials.size(), whole.trials.size());
  for (std::size_t i = 0; i < whole.trials.size(); ++i) {
    EXPECT_EQ(resumed.state().trials[i].planned.intensity, whole.trials[i].planned.intensity);
    EXPECT_EQ(resumed.state().trials[i].is_void, whole.trials[i].is_void);
  }
}

/// Of the block's rule over the answers that the session holds.
std::pair<bool, int> ends_and_answers_after(const Session& s, int series) {
  const Block block = s.current_block();
  const StaircaseState state = Staircase(staircase_rule_of(block, series))
                                   .after(level_answers(s.state().answered_in(0), series));
  return {state.is_finished(), state.num_after_end};
}

TEST_F(AdaptiveSessionTest, ACorrectionThatPutsTheEndBeforeAnswersLosesNoneAndTheBlockGoesOn) {
  int num_that_moved_the_end = 0;
  for (std::int64_t corrected = 1; corrected <= 24; ++corrected) {
    log_.events.clear();
    Session s = begun();
    while (s.state().trials.size() < 30 && s.state().current_trial()) {
      run_trial(s, level(s) > 6.0 ? 1.0 : 0.0);
    }
    const std::size_t num_answered = s.state().answered_in(0).size();
    if (corrected > std::ssize(s.state().answered_in(0))) break;
    const double response = s.state().trial(corrected).response.value();
    ASSERT_NO_THROW(s.correct(corrected, 1.0 - response, "misheard"));
    EXPECT_EQ(s.state().answered_in(0).size(), num_answered);
    num_that_moved_the_end +=
        ends_and_answers_after(s, 1).second + ends_and_answers_after(s, 2).second;
    Session resumed = session();
    ASSERT_NO_THROW(resumed.resume("repeat", 0, -1)) << "trial " << corrected;
    ASSERT_NO_THROW(run_to_end(resumed)) << "trial " << corrected;
    EXPECT_TRUE(ends_and_answers_after(resumed, 1).first);
    EXPECT_TRUE(ends_and_answers_after(resumed, 2).first);
    EXPECT_NO_THROW(resumed.finish_stage());
    EXPECT_NO_THROW((void)session()) << "and is replayed";
  }
  EXPECT_GT(num_that_moved_the_end, 0) << "or nothing was tried";
}

TEST_F(AdaptiveSessionTest, ACorrectionThatTakesTheEndAwayDrawsTheNextTrial) {
  int num_that_took_the_end_away = 0;
  Session first = begun();
  run_to_end(first);
  const std::vector<core::EventRow> ended = log_.events;
  for (auto corrected = std::ssize(first.state().trials); corrected >= 1; --corrected) {
    log_.events = ended;
    Session s = session();
    s.correct(corrected, 1.0 - s.state().trial(corrected).response.value(), "misheard");
    const bool has_ended =
        ends_and_answers_after(s, 1).first && ends_and_answers_after(s, 2).first;
    EXPECT_EQ(s.state().current_trial().has_value(), !has_ended) << "trial " << corrected;
    num_that_took_the_end_away += has_ended ? 0 : 1;
    run_to_end(s);
    EXPECT_NO_THROW(s.finish_stage());
  }
  EXPECT_GT(num_that_took_the_end_away, 0) << "or nothing was tried";
}

TEST_F(AdaptiveSessionTest, ACorrectionAfterTheEndOfTheSessionDrawsNothing) {
  Session s = begun();
  run_to_end(s);
  s.end_early("enough");
  const std::size_t num_trials = s.state().trials.size();
  for (auto trial = std::ssize(s.state().trials); trial > 0; --trial) {
    s.correct(trial, 1.0 - s.state().trial(trial).response.value(), "misheard");
  }
  EXPECT_EQ(s.state().trials.size(), num_trials);
}

TEST_F(AdaptiveSessionTest, TheLastAnswerIsTheOneThatWasGivenLastWhateverWasCorrectedSince) {
  Session s = begun();
  for (int trial = 0; trial < 5; ++trial) run_trial(s, 1.0);
  s.correct(2, 0.0, "misheard");
  EXPECT_EQ(s.state().last_answered_trial(), 5);
  EXPECT_FALSE(s.can_run_again(2)) << "it decided what came next";
}

}  // namespace adaptive_session_test
}  // namespace jnd::experiments
