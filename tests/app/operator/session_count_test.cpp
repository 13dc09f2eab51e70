#include "app/operator/session_count.h"

#include "app/operator/operated_session_fixture.h"

namespace jnd::app {
namespace session_count_test {

using namespace experiments;

Stage block_stage(const std::string& name, const std::string& procedure) {
  return {.name = name,
          .content = Block{.procedure = procedure,
                           .medium = "viscous",
                           .quantity = "viscosity_pa_s",
                           .intensities = {1.0, 2.0},
                           .reference_intensity = 1.5,
                           .repetitions = 3}};
}

TEST(SessionCount, CountsBlocksThatNobodyHasEntered) {
  const Stage first = block_stage("first", "constant_stimuli");
  const Stage second = block_stage("second", "constant_stimuli");
  const Stage rest{.name = "rest", .content = Break{}};
  SessionState state;
  const SessionCount before = count_of_session(state, {&first, &rest, &second});
  EXPECT_EQ(before.num_answers, 0);
  EXPECT_EQ(before.num_trials, 12);
  EXPECT_FALSE(before.is_expected);

  // The first block is over, and one of its trials is void. Six trials of the second block are
  // drawn, and one of them is answered.
  state.stage = 2;
  state.first_together = 2;
  state.stage_open = true;
  for (int i = 0; i < 6; ++i) state.trials.push_back({.stage = 0, .is_answered = true});
  state.trials.push_back({.stage = 0, .is_void = true});
  state.trials.push_back({.stage = 2, .is_answered = true});
  for (int i = 0; i < 5; ++i) state.trials.push_back({.stage = 2});
  const SessionCount now = count_of_session(state, {&first, &rest, &second});
  EXPECT_EQ(now.num_answers, 7);
  EXPECT_EQ(now.num_trials, 12);
}

TEST(SessionCount, SaysSoWhereAnswersDecideHowManyThereWillBe) {
  const Stage first = block_stage("first", "constant_stimuli");
  Stage second = block_stage("second", "constant_stimuli");
  std::get<Block>(second.content).practice = Practice{};
  EXPECT_TRUE(count_of_session({}, {&first, &second}).is_expected);
  SessionState over;
  over.stage = 2;
  over.trials.push_back({.stage = 1, .is_answered = true});
  const SessionCount count = count_of_session(over, {&first, &second});
  EXPECT_FALSE(count.is_expected) << "it is known by now";
  EXPECT_EQ(count.num_trials, 1);
}

class CountedSessionTest : public OperatedSessionTest {};

TEST_F(CountedSessionTest, ASessionUnderWayCountsAllItsBlocks) {
  open();
  EXPECT_EQ(run_to_block("estimation").num_trials, kTinyTrials);
  answer_trial(view(), 100.0);
  EXPECT_EQ(view().trials_on_disk, 1);
  EXPECT_EQ(view().num_trials, kTinyTrials);
}

TEST_F(CountedSessionTest, TheTimeThatHasElapsedGoesOnAfterAnInterruption) {
  open();
  run_to_block("estimation");
  pass(30.0);
  const double before_s = view().elapsed_s;
  EXPECT_GT(before_s, 30.0);
  act(operate::Leave{});
  reopen();
  EXPECT_NEAR(view().elapsed_s, before_s, 0.5) << "nothing goes on yet";
  act(operate::Begin{"repeat"});
  pass(2.0);
  EXPECT_NEAR(view().elapsed_s, before_s + 2.0, 0.5);
  act(operate::Leave{});
  reopen();
  EXPECT_NEAR(view().elapsed_s, before_s + 2.0, 0.8) << "a third time";
}

TEST_F(CountedSessionTest, WhatSpeaksAgainstAnAnswerIsToldBesideIt) {
  open();
  run_to_block("estimation");
  std::int64_t trial = view().trial->trial;
  act(operate::Present{trial, "test"});
  pass(10.0);
  act(operate::Answer{trial, 100.0});
  EXPECT_EQ(view().answers.front().hint, "");
  trial = view().trial->trial;
  act(operate::Present{trial, "test"});
  pass(0.3);
  act(operate::Answer{trial, 70000.0});
  EXPECT_EQ(view().answers.front().hint,
            "more than 1000 %; 700 times the last answer; 0.3 s after the stimulus began; no "
            "stroke in the test");
  EXPECT_EQ(view().answers.at(1).hint, "") << "the one before stays as it was";
}

}  // namespace session_count_test
}  // namespace jnd::app
