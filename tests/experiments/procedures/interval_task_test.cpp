#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/random_stream.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/task.h"
#include "experiments/protocol/study_reader.h"

// Tests the tasks with three intervals: three-interval forced choice, oddity, ABX and match to
// sample.

namespace jnd::experiments {
namespace interval_task_test {

constexpr Task kTasks[] = {Task::kThreeInterval, Task::kOddity, Task::kAbx,
                           Task::kMatchToSample};

Block block_of(const std::string& keys) {
  const Study study = read_study_text(R"json({
    "format": 1, "name": "tasks", "languages": ["en"], "title": {"en": "Tasks"},
    "authors": ["A. Author"],
    "stages": [{"kind": "block", "name": "block", "medium": "viscous",
      "instruction": {"en": "Compare."}, "question": {"en": "Which?"},
      "expected_trial_s": 5, )json" + keys +
                                          "}]}",
                                      "study.json");
  return std::get<Block>(study.stages.front().content);
}

std::string constant(const std::string& task) {
  return R"json("procedure": "constant_stimuli", "viscosity_pa_s": [9, 12, 16],
    "reference_viscosity_pa_s": 8, "repetitions": 12, "catch_trials": 1, "task": ")json" +
         task + '"';
}
std::string staircase(const std::string& task, const std::string& more = "") {
  return R"json("procedure": "staircase", "reference_viscosity_pa_s": 8,
    "start_viscosity_pa_s": [16], "lowest_viscosity_pa_s": 8.5, "highest_viscosity_pa_s": 30,
    "step_ratio": [1.2], "task": ")json" +
         task + '"' + more;
}

TEST(ThreeIntervals, TheRightOneIsWorkedOutOfWhatTheyHold) {
  EXPECT_EQ(right_interval(Task::kThreeInterval, "rtr"), 2);
  EXPECT_EQ(right_interval(Task::kThreeInterval, "rrt"), 3);
  EXPECT_EQ(right_interval(Task::kOddity, "trr"), 1);
  EXPECT_EQ(right_interval(Task::kOddity, "trt"), 2) << "the reference can be the odd one";
  EXPECT_EQ(right_interval(Task::kOddity, "ttr"), 3);
  EXPECT_EQ(right_interval(Task::kAbx, "rtr"), 1);
  EXPECT_EQ(right_interval(Task::kAbx, "rtt"), 2);
  EXPECT_EQ(right_interval(Task::kMatchToSample, "trt"), 3);
  EXPECT_EQ(right_interval(Task::kMatchToSample, "ttr"), 2);
  EXPECT_THROW((void)right_interval(Task::kOddity, "rt"), core::Error);
}

TEST(ThreeIntervals, EveryOrderHasOneRightAnswerAndEveryAnswerIsRightEquallyOften) {
  for (const Task task : kTasks) {
    std::map<int, int> right;
    const std::vector<std::string> orders = interval_orders(task);
    EXPECT_EQ(std::set(orders.begin(), orders.end()).size(), orders.size());
    for (const std::string& order : orders) ++right[right_interval(task, order)];
    const TrialForm form = form_of(task);
    EXPECT_EQ(std::ssize(right), form.num_choices);
    EXPECT_EQ(form.num_choices, num_choices_to_guess(task));
    for (const auto& [interval, count] : right) {
      EXPECT_GE(interval, form.first_choice);
      EXPECT_EQ(count * form.num_choices, std::ssize(orders));
    }
  }
}

TEST(ThreeIntervals, AnObserverChoosesByTheRuleOfTheTask) {
  const auto choice = [](Task task, std::array<double, 3> readings) {
    return chosen_interval(task, readings);
  };
  EXPECT_EQ(choice(Task::kThreeInterval, {1, 3, 2}).interval, 2);
  EXPECT_DOUBLE_EQ(choice(Task::kThreeInterval, {1, 3, 2}).margin, 1.0);
  EXPECT_EQ(choice(Task::kOddity, {1, 3, 3.5}).interval, 1)
      << "the smallest can be the odd one";
  EXPECT_DOUBLE_EQ(choice(Task::kOddity, {1, 3, 3.5}).margin, 1.5);
  EXPECT_EQ(choice(Task::kAbx, {1, 3, 1.8}).interval, 1);
  EXPECT_EQ(choice(Task::kAbx, {1, 3, 2.1}).interval, 2);
  EXPECT_NEAR(choice(Task::kAbx, {1, 3, 2.1}).margin, 0.2, 1e-12);
  EXPECT_EQ(choice(Task::kMatchToSample, {1.8, 1, 3}).interval, 2);
  EXPECT_EQ(choice(Task::kMatchToSample, {2.1, 1, 3}).interval, 3);
}

/// Returns the share of right answers of an observer who feels the test one standard deviation
/// above the reference.
double share_right(Task task) {
  constexpr int kTrials = 40000;
  core::RandomStream stream(7, "observer", {static_cast<std::int64_t>(task)});
  const std::vector<std::string> orders = interval_orders(task);
  int num_right = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::string& order = orders[static_cast<std::size_t>(trial) % orders.size()];
    std::array<double, 3> readings{};
    for (std::size_t i = 0; i < 3; ++i) readings[i] = stream.normal() + (order[i] == 't');
    num_right += chosen_interval(task, readings).interval == right_interval(task, order);
  }
  return static_cast<double>(num_right) / kTrials;
}

// Four standard errors of 40,000 trials are 0.01.
TEST(ThreeIntervals, SharesOfRightAnswersAtADPrimeOfOneAreThePublishedOnes) {
  // Macmillan and Creelman (2005), table A5.7, for m = 3.
  EXPECT_NEAR(share_right(Task::kThreeInterval), 0.634, 0.01);
  // Ennis (1993), table 3, triangular method.
  EXPECT_NEAR(share_right(Task::kOddity), 0.418, 0.01);
  // The differencing rule gives Phi(1/sqrt 2) Phi(1/sqrt 6) + Phi(-1/sqrt 2) Phi(-1/sqrt 6),
  // Macmillan and Creelman (2005), chapter 9.
  EXPECT_NEAR(share_right(Task::kAbx), 0.5825, 0.01);
  EXPECT_NEAR(share_right(Task::kMatchToSample), 0.5825, 0.01);
}

TEST(ThreeIntervals, OfConstantStimuliEachHasEveryOrderEquallyOften) {
  for (const char* task : {"three_interval", "oddity", "abx", "match_to_sample"}) {
    const Block block = block_of(constant(task));
    core::RandomStream stream(3, "order");
    const std::vector<PlannedTrial> trials =
        procedure_named("constant_stimuli").draw_next(block, {}, stream);
    std::map<double, std::map<std::string, int>> counts;
    for (const PlannedTrial& trial : trials) {
      EXPECT_EQ(trial.right_interval, right_interval(task_of(block), trial.intervals));
      EXPECT_FALSE(trial.test_interval);
      ++counts[trial.intensity.value()][trial.intervals];
    }
    EXPECT_EQ(counts.size(), 4U) << "the catch trials, too";
    const auto num_orders = static_cast<int>(interval_orders(task_of(block)).size());
    for (const auto& [level, orders] : counts) {
      EXPECT_EQ(static_cast<int>(orders.size()), num_orders) << task;
      for (const auto& [order, count] : orders) EXPECT_EQ(count, 12 / num_orders) << order;
    }
  }
}

TEST(ThreeIntervals, OfAnAdaptiveBlockEveryOrderComesTwiceInASetThatNobodyCanForesee) {
  const Block block = block_of(staircase("oddity"));
  const Procedure& procedure = procedure_named("staircase");
  std::vector<AnsweredTrial> answered;
  std::map<std::string, int> counts;
  while (answered.size() < 12) {
    core::RandomStream stream(3, "order", {static_cast<std::int64_t>(answered.size())});
    const std::vector<PlannedTrial> next = procedure.draw_next(block, answered, stream);
    ASSERT_EQ(next.size(), 1U);
    ++counts[next.front().intervals];
    answered.push_back({next.front(), 1.0});
  }
  EXPECT_EQ(counts.size(), 6U);
  for (const auto& [order, count] : counts) EXPECT_EQ(count, 2) << order;
}

TEST(ThreeIntervals, AnAnswerIsStoredAsRightOrNot) {
  const PlannedTrial trial{
      .intensity = 12.0, .reference_intensity = 8.0, .intervals = "trr", .right_interval = 1};
  EXPECT_EQ(response_of(AnswerKind::kInterval, trial, 1.0), 1.0);
  EXPECT_EQ(response_of(AnswerKind::kInterval, trial, 3.0), 0.0);
  EXPECT_EQ(answer_of(AnswerKind::kInterval, trial, 0.0, 3), 3.0);
  EXPECT_EQ(right_response(Task::kOddity, trial), 1.0);
  PlannedTrial equal = trial;
  equal.intensity = 8.0;
  EXPECT_FALSE(right_response(Task::kOddity, equal)) << "no interval is the odd one";
  EXPECT_EQ(feedback_response(Task::kOddity, equal), 1.0) << "told all the same, right in 1/3";
}

std::string problems_of(const std::string& keys) {
  try {
    (void)block_of(keys);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(ThreeIntervals, AStaircaseAimsAboveGuessingAndAtLevelsOfOneSide) {
  EXPECT_EQ(problems_of(staircase("abx")), "");
  EXPECT_NE(problems_of(staircase("abx", R"(, "num_down": 1)")).find("above 50 %"),
            std::string::npos);
  EXPECT_EQ(problems_of(staircase("oddity", R"(, "num_down": 1)")), "")
      << "1 up and 1 down aim at 50 %, a guess is right in 33 %";
}

}  // namespace interval_task_test
}  // namespace jnd::experiments
