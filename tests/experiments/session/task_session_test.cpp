#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session_in_memory.h"

namespace jnd::experiments {
namespace task_session_test {

std::string study_of(const std::string& keys) {
  return R"json({
  "format": 1, "name": "tasks", "languages": ["en"], "title": {"en": "Tasks"},
  "authors": ["A. Author"],
  "stages": [{"kind": "block", "name": "block", "medium": "viscous",
    "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
    "expected_trial_s": 5, )json" +
         keys + "}]}";
}

const std::string kConstant = R"json("procedure": "constant_stimuli",
    "viscosity_pa_s": [4, 12, 16], "reference_viscosity_pa_s": 8, "repetitions": 4)json";
const std::string kTwoInterval =
    kConstant + R"json(, "task": "two_interval", "interval_order": "balanced")json";
const std::string kStaircase = R"json("procedure": "staircase", "task": "two_interval",
    "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16, 4],
    "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [1.5, 1.2],
    "interval_order": "balanced", "catch_probability": 0.2, "max_reversals": 6)json";
const std::string kPractice = kConstant + R"json(, "catch_trials": 1, "feedback": true,
    "practice": {"min_correct_ratio": 0.75, "num_trials_judged": 4, "max_trials": 10})json";

class TaskSessionTest : public ::testing::Test {
 protected:
  void use(const std::string& keys) { study_ = read_study_text(study_of(keys), "study.json"); }

  Session session() {
    return Session({.session = 1, .seed = 42, .stages = {&study_.stages.front()}}, log_.events,
                   log_, clock_);
  }
  Session begun(const std::string& keys) {
    use(keys);
    Session s = session();
    s.start();
    s.enter_stage();
    return s;
  }
  static const PlannedTrial& now(const Session& s) {
    return s.state().trial(*s.state().current_trial()).planned;
  }
  static void run_trial(Session& s, double answer) {
    s.start_trial(s.state().last_tick + 1);
    const TrialForm form = s.current_form();
    if (form.order_is_drawn) {
      present(s, "first");
      present(s, "second");
    } else {
      if (form.has_reference) present(s, "reference");
      present(s, "test");
    }
    s.answer(answer, {.response_time_s = 1.5}, s.state().last_tick);
  }
  /// Returns the right answer as a person gives it, or the other one.
  static double answer(const Session& s, bool right) {
    const PlannedTrial& trial = now(s);
    const bool more = *trial.intensity > *trial.reference_intensity;
    if (s.current_form().answer != AnswerKind::kInterval) return more == right ? 1.0 : 0.0;
    const int test = *trial.test_interval;
    return more == right ? test : 3 - test;
  }
  /// The answer as the person gave it.
  static double answer_in(const AnsweredTrial& trial) {
    const int test = *trial.planned.test_interval;
    return trial.response == 1.0 ? test : 3 - test;
  }
  static void run_to_end(Session& s) {
    while (s.state().current_trial()) run_trial(s, answer(s, true));
  }
  static std::vector<PlannedTrial> planned(const Session& s) {
    std::vector<PlannedTrial> all;
    for (const AnsweredTrial& trial : s.state().answered_in(0)) all.push_back(trial.planned);
    return all;
  }
  static void expect_same(const std::vector<PlannedTrial>& a,
                          const std::vector<PlannedTrial>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].intensity, b[i].intensity) << i;
      EXPECT_EQ(a[i].test_interval, b[i].test_interval) << i;
      EXPECT_EQ(a[i].is_catch, b[i].is_catch) << i;
    }
  }
  /// Expects that a session that is cut anywhere and resumed has the trials of an uninterrupted
  /// one.
  void expect_resumes_anywhere(const std::string& keys) {
    Session whole = begun(keys);
    run_to_end(whole);
    whole.finish_stage();
    const std::vector<core::EventRow> complete = log_.events;
    for (std::size_t cut = 2; cut < complete.size(); ++cut) {
      log_.events.assign(complete.begin(), complete.begin() + static_cast<std::ptrdiff_t>(cut));
      Session s = session();
      if (s.state().stage == 1) continue;
      s.resume("repeat", 0, -1);
      run_to_end(s);
      expect_same(planned(s), planned(whole));
    }
  }
  /// Expects that a block that is restarted in the middle runs as one that was not disturbed.
  void expect_restarts_the_same(const std::string& keys) {
    Session whole = begun(keys);
    run_to_end(whole);
    const std::vector<PlannedTrial> undisturbed = planned(whole);
    log_.events.clear();
    Session s = begun(keys);
    for (int trial = 0; trial < 3; ++trial) run_trial(s, answer(s, false));
    s.restart_block("somebody came in");
    EXPECT_TRUE(s.state().answered_in(0).empty());
    run_to_end(s);
    expect_same(planned(s), undisturbed);
  }

  Study study_;
  MemoryLog log_;
  core::SimulatedClock clock_;
};

TEST_F(TaskSessionTest, FirstAndSecondPresentTestAndReferenceAsTheOrderWasDrawn) {
  Session s = begun(kTwoInterval);
  std::set<int> orders;
  for (int trial = 0; trial < 6; ++trial) {
    const PlannedTrial planned = now(s);
    orders.insert(planned.test_interval.value());
    s.start_trial(s.state().last_tick + 1);
    EXPECT_NO_THROW(s.require_interval("second"));
    present(s, "first");
    present(s, "second");
    const auto& felt = s.state().trial(*s.state().current_trial()).presentations;
    const bool test_first = planned.test_interval == 1;
    EXPECT_EQ(felt[0].interval, test_first ? "test" : "reference");
    EXPECT_EQ(felt[1].interval, test_first ? "reference" : "test");
    EXPECT_EQ(felt[test_first ? 0 : 1].intensity, *planned.intensity);
    EXPECT_EQ(felt[test_first ? 1 : 0].intensity, 8.0);
    s.answer(1.0, {.response_time_s = 1.0}, s.state().last_tick);
  }
  EXPECT_EQ(orders.size(), 2U);
}

TEST_F(TaskSessionTest, AFixedOrderHasNoFirstAndSecond) {
  Session s = begun(kConstant);
  s.start_trial(0);
  EXPECT_THROW(s.begin_presentation("first", 0), core::Error);
}

TEST_F(TaskSessionTest, AnIntervalIsAnsweredAndWhetherItHeldTheTestIsStored) {
  Session s = begun(kTwoInterval);
  for (int trial = 0; trial < 8; ++trial) {
    const int chosen = 1 + trial % 2;
    const int test = *now(s).test_interval;
    run_trial(s, chosen);
    const core::TrialRow& row = log_.trials.back();
    EXPECT_EQ(row.response, chosen == test ? 1.0 : 0.0);
    EXPECT_EQ(row.test_interval, test);
    EXPECT_EQ(row.response == 1.0 ? *row.test_interval : 3 - *row.test_interval, chosen)
        << "the codebook's rule";
  }
  const double stored = *log_.trials.back().response;
  const auto corrected = *log_.trials.back().test_interval;
  s.correct(
      8, stored == 1.0 ? 3.0 - static_cast<double>(corrected) : static_cast<double>(corrected),
      "meant the other one");
  EXPECT_EQ(log_.trials.back().response, 1.0 - stored);
}

TEST_F(TaskSessionTest, NothingButAnIntervalIsTaken) {
  Session s = begun(kTwoInterval);
  s.start_trial(0);
  present(s, "first");
  present(s, "second");
  for (const double wrong : {0.0, 3.0, 1.5}) {
    EXPECT_THROW(s.require_answer(wrong), core::Error) << wrong;
  }
  EXPECT_NO_THROW(s.require_answer(2.0));
}

TEST_F(TaskSessionTest, AnAnswerTakenBackLeavesTheOrderOfTheIntervals) {
  Session s = begun(kTwoInterval);
  run_trial(s, 1.0);
  const PlannedTrial second = now(s);
  run_trial(s, 1.0);
  s.undo("wrong key");
  EXPECT_EQ(now(s).test_interval, second.test_interval);
  EXPECT_EQ(now(s).intensity, second.intensity);
  run_trial(s, 2.0);
  run_to_end(s);
  EXPECT_EQ(s.state().answered_in(0).size(), 12U);
  s.finish_stage();
}

TEST_F(TaskSessionTest, ATwoIntervalStaircaseIsTheSameAfterUndoRestartAndResumption) {
  Session s = begun(kStaircase);
  for (int trial = 0; trial < 9; ++trial) run_trial(s, answer(s, true));
  const PlannedTrial before = now(s);
  const AnsweredTrial last = s.state().answered_in(0).back();
  s.undo("wrong key");
  EXPECT_TRUE(s.state().trials.back().is_void);
  EXPECT_EQ(now(s).test_interval, last.planned.test_interval);
  run_trial(s, answer_in(last));
  EXPECT_EQ(now(s).intensity, before.intensity) << "the same answer draws the same trial";
  EXPECT_EQ(now(s).test_interval, before.test_interval);
  log_.events.clear();
  expect_restarts_the_same(kStaircase);
  log_.events.clear();
  expect_resumes_anywhere(kStaircase);
}

TEST_F(TaskSessionTest, CatchTrialsOfAYesNoTaskAreFreeSpaceAndStoredAsSuch) {
  Session s = begun(R"json("procedure": "constant_stimuli", "task": "yes_no",
      "viscosity_pa_s": [0.5, 1], "repetitions": 3, "catch_trials": 1)json");
  const auto& block = std::get<Block>(study_.stages.front().content);
  int num_catch = 0;
  while (s.state().current_trial()) {
    const bool is_catch = now(s).is_catch;
    run_trial(s, is_catch ? 0.0 : 1.0);
    const core::TrialRow& row = log_.trials.back();
    EXPECT_EQ(row.is_catch, is_catch);
    const MediumSetting felt = setting_of(block, "test", *row.intensity);
    EXPECT_EQ(felt.medium, is_catch ? "free_space" : "viscous");
    num_catch += is_catch ? 1 : 0;
  }
  EXPECT_EQ(num_catch, 3);
}

TEST_F(TaskSessionTest, SameDifferentIsResumedAndRestartedTheSame) {
  const std::string keys = kConstant + R"json(, "task": "same_different")json";
  expect_resumes_anywhere(keys);
  log_.events.clear();
  expect_restarts_the_same(keys);
}

TEST_F(TaskSessionTest, FeedbackTellsRightOrWrongUntilTheNextTrial) {
  Session s = begun(kConstant + R"json(, "feedback": true)json");
  EXPECT_EQ(s.state().feedback_right, std::nullopt);
  run_trial(s, answer(s, true));
  EXPECT_EQ(s.state().feedback_right, true);
  run_trial(s, answer(s, false));
  EXPECT_EQ(s.state().feedback_right, false);
  EXPECT_EQ(session().state().feedback_right, false) << "it is in the log";
  s.start_trial(s.state().last_tick + 1);
  EXPECT_EQ(s.state().feedback_right, std::nullopt);
  s.undo("wrong key");
  EXPECT_EQ(s.state().feedback_right, std::nullopt);

  log_.events.clear();
  Session silent = begun(kConstant);
  run_trial(silent, 1.0);
  EXPECT_EQ(silent.state().feedback_right, std::nullopt);
}

TEST_F(TaskSessionTest, FeedbackComesAfterEveryTrialSoThatNoCatchTrialIsFoundOut) {
  const std::string quest_plus =
      R"json("procedure": "quest_plus", "viscosity_pa_s": [4, 6, 11, 16],
    "reference_viscosity_pa_s": 8, "pse_viscosity_pa_s": [2, 32], "max_trials": 12)json";
  const std::string limits = R"json("procedure": "limits", "viscosity_pa_s": [4, 6, 11, 16],
    "reference_viscosity_pa_s": 8, "num_series": 4)json";
  const std::string some = R"json(, "catch_probability": 0.4)json";
  for (const std::string& keys :
       {kConstant + R"json(, "catch_trials": 5)json",
        kTwoInterval + R"json(, "catch_trials": 5)json", kStaircase, quest_plus + some,
        limits + some, quest_plus + some + R"json(, "task": "two_interval")json"}) {
    log_.events.clear();
    Session s = begun(keys + R"json(, "feedback": true)json");
    int num_catch = 0;
    while (s.state().current_trial()) {
      const bool is_catch = now(s).is_catch;
      const bool is_reminder = !now(s).test_interval;
      run_trial(s, is_catch ? 1.0 : answer(s, true));
      ASSERT_TRUE(s.state().feedback_right.has_value()) << keys;
      num_catch += is_catch ? 1 : 0;
      if (is_catch && is_reminder) {
        EXPECT_EQ(s.state().feedback_right, false) << "equal is not more";
      }
    }
    EXPECT_GT(num_catch, 0) << keys;
  }
}

TEST_F(TaskSessionTest, PracticeEndsAtItsCriterionWithANote) {
  Session s = begun(kPractice);
  run_to_end(s);
  const std::size_t num_trials = s.state().answered_in(0).size();
  EXPECT_GE(num_trials, 4U);
  EXPECT_LE(num_trials, 10U);
  s.finish_stage();
  ASSERT_EQ(s.state().notes.size(), 1U);
  EXPECT_EQ(s.state().notes[0],
            "practice over after " + std::to_string(num_trials) +
                " trials: 4 of the last 4 answers were right, at least 3 were asked for");
  s.complete();
}

TEST_F(TaskSessionTest, PracticeWithoutSuccessEndsAfterItsMostTrials) {
  Session s = begun(kPractice);
  while (s.state().current_trial()) run_trial(s, answer(s, false));
  EXPECT_EQ(s.state().answered_in(0).size(), 10U);
}

TEST_F(TaskSessionTest, TakingTheLastAnswerBackGoesOnWithThePractice) {
  Session s = begun(kPractice);
  run_to_end(s);
  const std::size_t num_trials = s.state().answered_in(0).size();
  s.undo("wrong key");
  EXPECT_TRUE(s.state().current_trial());
  EXPECT_THROW(s.finish_stage(), core::Error);
  // One wrong answer of four would still do, so two are taken back.
  s.undo("and the one before");
  run_trial(s, answer(s, false));
  ASSERT_TRUE(s.state().current_trial());
  run_trial(s, answer(s, false));
  EXPECT_TRUE(s.state().current_trial()) << "2 of 4 are too few";
  run_to_end(s);
  EXPECT_GT(s.state().answered_in(0).size(), num_trials);
  s.finish_stage();
  EXPECT_EQ(s.state().notes.size(), 1U) << "told once, at its end";
}

TEST_F(TaskSessionTest, PracticeIsTheSameRestartedAndResumed) {
  expect_resumes_anywhere(kPractice);
  log_.events.clear();
  expect_restarts_the_same(kPractice);
}

}  // namespace task_session_test
}  // namespace jnd::experiments
