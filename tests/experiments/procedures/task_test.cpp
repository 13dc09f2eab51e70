#include "experiments/procedures/task.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::experiments {
namespace task_test {

/// Returns a comparison of fluids with a reference of 8 Pa s and with these additional keys.
Block block_with(const std::string& keys) {
  const Study study = read_study_text(
      R"json({
    "format": 1, "name": "tasks", "languages": ["en"], "title": {"en": "Tasks"},
    "authors": ["A. Author"],
    "stages": [{"kind": "block", "name": "one", "medium": "viscous",
      "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
      "expected_trial_s": 5, )json" +
          keys + "}]}",
      "study.json");
  return std::get<Block>(study.stages.front().content);
}

const std::string kConstant = R"json("procedure": "constant_stimuli",
    "viscosity_pa_s": [4, 6, 12, 16], "repetitions": 5)json";
const std::string kReference = R"json(, "reference_viscosity_pa_s": 8)json";
const std::string kTwoInterval = kConstant + kReference + R"json(, "task": "two_interval")json";
const std::string kSameDifferent =
    kConstant + kReference + R"json(, "task": "same_different")json";

std::vector<PlannedTrial> drawn(const Block& block, std::uint64_t seed,
                                const std::vector<AnsweredTrial>& answered = {}) {
  core::RandomStream stream(seed, "order", {static_cast<std::int64_t>(answered.size())});
  return procedure_named(block.procedure).draw_next(block, answered, stream);
}

/// This many trials one after the other, answered with yes and no in turn.
std::vector<AnsweredTrial> answered_one_by_one(const Block& block, std::size_t num_trials,
                                               std::uint64_t seed) {
  std::vector<AnsweredTrial> answered;
  while (answered.size() < num_trials) {
    const std::vector<PlannedTrial> next = drawn(block, seed, answered);
    if (next.size() != 1) break;
    answered.push_back({next.front(), answered.size() % 2 == 0 ? 1.0 : 0.0});
  }
  return answered;
}

TEST(Task, DecidesWhatABlockMeasuresWhicheverProcedureChoosesItsStimuli) {
  for (const char* name : {"constant_stimuli", "limits", "staircase", "quest_plus"}) {
    const Procedure& procedure = procedure_named(name);
    Block block{.procedure = name};
    for (const auto& [task, measure] : {std::pair("reminder", Measure::kComparison),
                                        {"two_interval", Measure::kComparison},
                                        {"yes_no", Measure::kDetection},
                                        {"same_different", Measure::kDifference}}) {
      block.settings.set("task", task);
      EXPECT_EQ(procedure.measures(block), measure) << name << ' ' << task;
    }
    EXPECT_EQ(procedure.adapts(), name != std::string("constant_stimuli"));
  }
  EXPECT_EQ(procedure_named("magnitude_estimation").measures({}), Measure::kMagnitude);
  EXPECT_EQ(procedure_named("magnitude_production").measures({}), Measure::kProducedMagnitude);
  EXPECT_EQ(procedure_named("matching").measures({}), Measure::kMatch);
}

TEST(Task, SaysHowATrialIsAnswered) {
  EXPECT_EQ(form_of(Task::kReminder).answer, AnswerKind::kYesNo);
  EXPECT_FALSE(form_of(Task::kReminder).order_is_drawn);
  EXPECT_FALSE(form_of(Task::kYesNo).has_reference);
  EXPECT_EQ(form_of(Task::kTwoInterval).answer, AnswerKind::kInterval);
  EXPECT_TRUE(form_of(Task::kTwoInterval).order_is_drawn);
  EXPECT_EQ(form_of(Task::kSameDifferent).answer, AnswerKind::kYesNo);
  EXPECT_TRUE(form_of(Task::kSameDifferent).order_is_drawn);
  EXPECT_TRUE(form_of(Task::kSameDifferent).has_reference);
}

TEST(Task, StoresTheChosenIntervalAsWhetherItHeldTheTest) {
  const PlannedTrial first{.test_interval = 1}, second{.test_interval = 2};
  EXPECT_EQ(response_of(AnswerKind::kInterval, first, 1.0), 1.0);
  EXPECT_EQ(response_of(AnswerKind::kInterval, first, 2.0), 0.0);
  EXPECT_EQ(response_of(AnswerKind::kInterval, second, 2.0), 1.0);
  for (const PlannedTrial& trial : {first, second}) {
    for (const double interval : {1.0, 2.0}) {
      const double response = response_of(AnswerKind::kInterval, trial, interval);
      EXPECT_EQ(answer_of(AnswerKind::kInterval, trial, response), interval);
      // The codebook tells this rule.
      EXPECT_EQ(response == 1.0 ? *trial.test_interval : 3 - *trial.test_interval, interval);
    }
  }
  EXPECT_EQ(response_of(AnswerKind::kPercent, first, 120.0), 120.0);
  EXPECT_EQ(answer_of(AnswerKind::kYesNo, second, 1.0), 1.0);
}

TEST(Task, KnowsWhichAnswerIsRightAndThatNoneIs) {
  const PlannedTrial more{.intensity = 9.0, .reference_intensity = 8.0};
  const PlannedTrial less{.intensity = 7.0, .reference_intensity = 8.0};
  const PlannedTrial equal{.intensity = 8.0, .reference_intensity = 8.0, .is_catch = true};
  const PlannedTrial nothing{.intensity = 0.0, .is_catch = true};
  for (const Task task : {Task::kReminder, Task::kTwoInterval}) {
    EXPECT_EQ(right_response(task, more), 1.0);
    EXPECT_EQ(right_response(task, less), 0.0);
    EXPECT_EQ(right_response(task, equal), std::nullopt);
  }
  EXPECT_EQ(right_response(Task::kSameDifferent, less), 1.0);
  EXPECT_EQ(right_response(Task::kSameDifferent, equal), 0.0);
  EXPECT_EQ(right_response(Task::kYesNo, {.intensity = 0.2}), 1.0);
  EXPECT_EQ(right_response(Task::kYesNo, nothing), 0.0);
}

TEST(Task, FeedbackCallsAnAnswerRightAlsoWhereTwoEqualStimuliAreCompared) {
  const PlannedTrial equal{.intensity = 8.0, .reference_intensity = 8.0, .is_catch = true};
  const PlannedTrial more{.intensity = 9.0, .reference_intensity = 8.0};
  EXPECT_EQ(feedback_response(Task::kReminder, equal), 0.0) << "the test is not more";
  EXPECT_EQ(feedback_response(Task::kReminder, more), 1.0);
  EXPECT_EQ(feedback_response(Task::kSameDifferent, equal), 0.0);
  EXPECT_EQ(feedback_response(Task::kYesNo, {.intensity = 0.0, .is_catch = true}), 0.0);
  // With two intervals, the one that was drawn for the test counts as right, so that either is
  // right half the time.
  for (const int test : {1, 2}) {
    PlannedTrial trial = equal;
    trial.test_interval = test;
    const double right = feedback_response(Task::kTwoInterval, trial).value();
    EXPECT_EQ(answer_of(AnswerKind::kInterval, trial, right), test);
  }
  EXPECT_EQ(procedure_named("magnitude_estimation").feedback_response({}, {.intensity = 2.0}),
            std::nullopt);
}

TEST(Task, OfAMagnitudeNoAnswerIsRight) {
  for (const char* name : {"magnitude_estimation", "magnitude_production"}) {
    EXPECT_EQ(procedure_named(name).right_response({}, {.intensity = 2.0}), std::nullopt);
  }
}

TEST(TwoInterval, RandomOrderHasTheTestFirstInAboutHalfOfTheTrials) {
  int first = 0, trials = 0;
  std::set<std::vector<int>> orders;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::vector<int> order;
    for (const PlannedTrial& trial : drawn(block_with(kTwoInterval), seed)) {
      first += trial.test_interval == 1 ? 1 : 0;
      order.push_back(trial.test_interval.value());
      ++trials;
    }
    orders.insert(order);
  }
  EXPECT_EQ(trials, 200 * 20);
  EXPECT_NEAR(first, 2000, 4 * std::sqrt(1000.0));
  EXPECT_EQ(orders.size(), 200U);
}

TEST(TwoInterval, BalancedOrderHasEveryStimulusFirstAsOftenAsSecond) {
  const std::string balanced = R"json(, "interval_order": "balanced", "catch_trials": 2)json";
  const Block block = block_with(kTwoInterval + balanced);
  std::map<double, int> more_often_first;
  std::set<std::vector<int>> orders;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    std::map<std::pair<bool, double>, int> first, all;
    std::vector<int> order;
    for (const PlannedTrial& trial : drawn(block, seed)) {
      const std::pair stimulus{trial.is_catch, trial.intensity.value()};
      first[stimulus] += trial.test_interval == 1 ? 1 : 0;
      ++all[stimulus];
      order.push_back(trial.test_interval.value());
    }
    orders.insert(order);
    ASSERT_EQ(all.size(), 5U);
    for (const auto& [stimulus, count] : all) {
      const int excess = 2 * first[stimulus] - count;
      EXPECT_EQ(std::abs(excess), count % 2) << stimulus.second << " in " << count;
      more_often_first[stimulus.second] += excess > 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(orders.size(), 100U) << "which comes first cannot be foreseen";
  for (const double intensity : {4.0, 6.0, 12.0, 16.0}) {
    EXPECT_NEAR(more_often_first[intensity], 50, 25) << intensity;
  }
}

TEST(TwoInterval, OrderOfStimuliIsThatOfAReminderOfTheSameSeed) {
  const std::vector<PlannedTrial> reminder = drawn(block_with(kConstant + kReference), 5);
  const std::vector<PlannedTrial> two = drawn(block_with(kTwoInterval), 5);
  ASSERT_EQ(reminder.size(), two.size());
  for (std::size_t i = 0; i < two.size(); ++i) {
    EXPECT_EQ(reminder[i].intensity, two[i].intensity);
    EXPECT_EQ(reminder[i].test_interval, std::nullopt);
  }
}

TEST(CatchTrials, AreInEveryRepetitionAnywhere) {
  const Block block = block_with(kConstant + kReference + R"json(, "catch_trials": 3)json");
  EXPECT_EQ(procedure_named("constant_stimuli").expected_trials(block), 5 * 7);
  std::set<int> positions;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const std::vector<PlannedTrial> trials = drawn(block, seed);
    ASSERT_EQ(trials.size(), 35U);
    std::map<int, int> num_catch;
    std::map<int, std::multiset<double>> tests;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const PlannedTrial& trial = trials[i];
      EXPECT_EQ(trial.repetition, static_cast<int>(i / 7) + 1);
      EXPECT_EQ(trial.position, static_cast<int>(i % 7) + 1);
      EXPECT_EQ(trial.reference_intensity, 8.0);
      if (trial.is_catch) {
        EXPECT_EQ(trial.intensity, 8.0) << "the test equals the reference";
        ++num_catch[trial.repetition];
        positions.insert(trial.position);
      } else {
        tests[trial.repetition].insert(*trial.intensity);
      }
    }
    for (int repetition = 1; repetition <= 5; ++repetition) {
      EXPECT_EQ(num_catch[repetition], 3);
      EXPECT_EQ(tests[repetition], (std::multiset<double>{4, 6, 12, 16}));
    }
  }
  EXPECT_EQ(positions.size(), 7U);
}

TEST(CatchTrials, OfAYesNoTaskPresentNothing) {
  const Block block =
      block_with(kConstant + R"json(, "task": "yes_no", "catch_trials": 1)json");
  int num_catch = 0;
  for (const PlannedTrial& trial : drawn(block, 3)) {
    EXPECT_EQ(trial.reference_intensity, std::nullopt);
    if (!trial.is_catch) continue;
    EXPECT_EQ(trial.intensity, 0.0);
    ++num_catch;
  }
  EXPECT_EQ(num_catch, 5);
}

TEST(SameDifferent, ByDefaultHalfOfTheTrialsAreTheSame) {
  const Block block = block_with(kSameDifferent);
  const std::vector<PlannedTrial> trials = drawn(block, 3);
  EXPECT_EQ(trials.size(), 40U);
  int num_same = 0;
  for (const PlannedTrial& trial : trials) {
    const bool same = trial.intensity == trial.reference_intensity;
    EXPECT_EQ(same, trial.is_catch);
    EXPECT_TRUE(trial.test_interval);
    num_same += same ? 1 : 0;
  }
  EXPECT_EQ(num_same, 20);
  EXPECT_EQ(drawn(block_with(kSameDifferent + R"json(, "catch_trials": 1)json"), 3).size(),
            25U);
}

TEST(PracticeTrials, AreDrawnOneByOneEveryStimulusOnceARepetition) {
  const std::string practice = R"json(, "practice": {"min_correct_ratio": 0.9,
      "num_trials_judged": 10, "max_trials": 20}, "catch_trials": 1, "repetitions": 4)json";
  const Block block = block_with(R"json("procedure": "constant_stimuli",
      "viscosity_pa_s": [4, 6, 12, 16])json" +
                                 kReference + practice);
  std::set<std::vector<double>> orders;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const std::vector<AnsweredTrial> answered = answered_one_by_one(block, 100, seed);
    ASSERT_EQ(answered.size(), 20U) << "no more than all repetitions";
    std::vector<double> order;
    for (int repetition = 0; repetition < 4; ++repetition) {
      std::multiset<double> shown;
      for (int i = 0; i < 5; ++i) {
        const PlannedTrial& trial =
            answered[static_cast<std::size_t>(5 * repetition + i)].planned;
        EXPECT_EQ(trial.repetition, repetition + 1);
        EXPECT_EQ(trial.position, i + 1);
        shown.insert(*trial.intensity);
        order.push_back(*trial.intensity);
      }
      EXPECT_EQ(shown, (std::multiset<double>{4, 6, 8, 12, 16}));
    }
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 30U);
}

const std::string kStaircase = R"json("procedure": "staircase", "start_viscosity_pa_s": [16, 4],
    "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64, "step_ratio": [1.5, 1.2],
    "max_reversals": 100, "max_trials": 500)json";

TEST(AdaptiveTrials, HaveCatchTrialsAmongThemThatMoveNoLevel) {
  const std::string keys = R"json(, "catch_probability": 0.25)json";
  int num_catch = 0, num_trials = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const AnsweredTrial& trial :
         answered_one_by_one(block_with(kStaircase + kReference + keys), 100, seed)) {
      ++num_trials;
      if (!trial.planned.is_catch) continue;
      ++num_catch;
      EXPECT_EQ(trial.planned.intensity, 8.0);
      EXPECT_EQ(trial.planned.series, std::nullopt);
    }
  }
  EXPECT_EQ(num_trials, 2000);
  EXPECT_NEAR(num_catch, 500, 4 * std::sqrt(375.0));

  // Without catch trials the levels of each staircase are the same, one answer after the other.
  const Block block = block_with(kStaircase + kReference + keys);
  std::vector<AnsweredTrial> answered;
  std::map<int, std::vector<double>> levels;
  while (answered.size() < 80) {
    const PlannedTrial next = drawn(block, 4, answered).at(0);
    if (!next.is_catch) levels[*next.series].push_back(*next.intensity);
    answered.push_back({next, *next.intensity > 8.0 ? 1.0 : 0.0});
  }
  const Block plain = block_with(kStaircase + kReference);
  std::vector<AnsweredTrial> without;
  std::map<int, std::vector<double>> plain_levels;
  while (without.size() < 80) {
    const PlannedTrial next = drawn(plain, 4, without).at(0);
    plain_levels[*next.series].push_back(*next.intensity);
    without.push_back({next, *next.intensity > 8.0 ? 1.0 : 0.0});
  }
  for (auto& [series, own] : levels) {
    plain_levels[series].resize(std::min(own.size(), plain_levels[series].size()));
    own.resize(plain_levels[series].size());
    EXPECT_EQ(own, plain_levels[series]) << series;
  }
}

TEST(AdaptiveTrials, OfATwoIntervalTaskBalanceTheOrderInPairs) {
  const Block block = block_with(kStaircase + kReference + R"json(, "task": "two_interval",
      "interval_order": "balanced", "catch_probability": 0.2)json");
  std::set<std::vector<int>> orders;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const std::vector<AnsweredTrial> answered = answered_one_by_one(block, 40, seed);
    std::vector<int> order;
    for (std::size_t i = 0; i + 1 < answered.size(); i += 2) {
      EXPECT_EQ(*answered[i].planned.test_interval + *answered[i + 1].planned.test_interval, 3);
      order.push_back(*answered[i].planned.test_interval);
    }
    orders.insert(order);
  }
  EXPECT_GT(orders.size(), 28U);
}

TEST(AdaptiveTrials, ExpectTheCatchTrialsToo) {
  const Block plain = block_with(kStaircase + kReference);
  const Block more =
      block_with(kStaircase + kReference + R"json(, "catch_probability": 0.2)json");
  const Procedure& staircase = procedure_named("staircase");
  EXPECT_NEAR(staircase.expected_trials(more), 1.25 * staircase.expected_trials(plain), 1.0);
}

}  // namespace task_test
}  // namespace jnd::experiments
