#include <gtest/gtest.h>

#include <cmath>

#include "core/psychometric_function.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/median_person.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/procedures/adaptive_trial.h"
#include "experiments/procedures/quest_plus_procedure.h"
#include "experiments/procedures/staircase_procedure.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/protocol/study_reader.h"

// Tests that every task gives back what its simulated participant has, and that a criterion
// shows where theory says it does.

namespace jnd::experiments {
namespace task_answers_test {

constexpr double kWeber = 0.152;
constexpr double kReference = 8.0;

/// A laboratory with reading noise alone.
Laboratory plain_laboratory() {
  Laboratory laboratory = without_noise(thesis_laboratory());
  laboratory.perceiver.weber_fraction = kWeber;
  return laboratory;
}

Study study_with(const std::string& keys) {
  return read_study_text(R"json({
    "format": 1, "name": "tasks", "languages": ["en"], "title": {"en": "Tasks"},
    "authors": ["A. Author"],
    "stages": [{"kind": "block", "name": "one", "medium": "viscous",
      "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
      "expected_trial_s": 0.1, )json" +
                             keys + "}]}",
                         "study.json");
}

std::vector<AnsweredTrial> answers(Study& study, const Laboratory& laboratory,
                                   std::uint64_t seed = 1) {
  const AnswerSimulator simulator(study, laboratory);
  return simulator.answers({{.stage = &study.stages.front()}}, seed).front().trials;
}

/// Returns a study with one block of many trials, whose one test stimulus is one Weber fraction
/// above the reference.
Study many_trials(const std::string& task, const Laboratory& laboratory) {
  Study study = study_with(R"json("procedure": "constant_stimuli", "viscosity_pa_s": [7, 9],
      "reference_viscosity_pa_s": 8, "repetitions": 1, )json" +
                           task);
  auto& block = std::get<Block>(study.stages.front().content);
  block.intensities = {kReference * (1.0 + median_weber_fraction(laboratory, block))};
  block.repetitions = 10000;
  return study;
}

/// The share of ones among the responses that are counted, with four of its standard
/// deviations.
struct Share {
  double ratio = 0.0, tolerance = 0.0;
};
template <typename Counts>
Share share_of_ones(const std::vector<AnsweredTrial>& trials, Counts counts) {
  double ones = 0.0, all = 0.0;
  for (const AnsweredTrial& trial : trials) {
    if (!counts(trial.planned)) continue;
    ones += *trial.response;
    all += 1.0;
  }
  return {ones / all, 4.0 * std::sqrt(0.25 / all)};
}

bool is_catch(const PlannedTrial& trial) { return trial.is_catch; }
bool is_test(const PlannedTrial& trial) { return !trial.is_catch; }

TEST(TwoIntervalAnswers, ChooseTheTestOneWeberFractionAboveAsOftenAsAReminderDoes) {
  const Laboratory laboratory = plain_laboratory();
  Study study = many_trials(R"json("task": "two_interval", "catch_trials": 1)json", laboratory);
  const std::vector<AnsweredTrial> trials = answers(study, laboratory);
  const Share test = share_of_ones(trials, is_test);
  EXPECT_NEAR(test.ratio, 0.8413, test.tolerance);
  const Share equal = share_of_ones(trials, is_catch);
  EXPECT_NEAR(equal.ratio, 0.5, equal.tolerance);
}

TEST(TwoIntervalAnswers, ACriterionIsABiasForAnIntervalNotForTheTest) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.criterion_sd_ln = 0.1;
  Study study = many_trials(R"json("task": "two_interval", "catch_trials": 1,
      "interval_order": "balanced")json",
                            laboratory);
  const std::vector<AnsweredTrial> trials = answers(study, laboratory, 2);
  const double criterion = draw_person(laboratory, 2).criterion_ln;
  ASSERT_GT(std::abs(criterion), 0.02);
  const double second = core::standard_normal_cdf(-criterion / std::log1p(kWeber));
  const Share when_second = share_of_ones(
      trials, [](const PlannedTrial& t) { return t.is_catch && t.test_interval == 2; });
  const Share when_first = share_of_ones(
      trials, [](const PlannedTrial& t) { return t.is_catch && t.test_interval == 1; });
  EXPECT_NEAR(when_second.ratio, second, when_second.tolerance);
  EXPECT_NEAR(when_first.ratio, 1.0 - second, when_first.tolerance);
  EXPECT_NEAR(share_of_ones(trials, is_catch).ratio, 0.5, 0.02) << "it cancels";
}

TEST(SameDifferentAnswers, FollowTheDifferencingRule) {
  const Laboratory laboratory = plain_laboratory();
  Study study = many_trials(R"json("task": "same_different")json", laboratory);
  const std::vector<AnsweredTrial> trials = answers(study, laboratory);
  // A difference has a standard deviation of ln(1 + w), which is also the criterion.
  const Share false_alarms = share_of_ones(trials, is_catch);
  EXPECT_NEAR(false_alarms.ratio, 0.3173, false_alarms.tolerance) << "2 Phi(-1)";
  const Share hits = share_of_ones(trials, is_test);
  EXPECT_NEAR(hits.ratio, 0.5228, hits.tolerance) << "Phi(0) + Phi(-2)";
}

TEST(YesNoAnswers, AreYesHalfOfTheTimeOneWeberFractionAboveFreeSpace) {
  const Laboratory laboratory = plain_laboratory();
  Study study = study_with(R"json("procedure": "constant_stimuli", "task": "yes_no",
      "viscosity_pa_s": [1], "repetitions": 1, "catch_trials": 1)json");
  auto& block = std::get<Block>(study.stages.front().content);
  const double damping_of_one = amounts_of(setting_of(block, "test", 1.0)).damping_n_s_per_m;
  block.intensities = {kWeber * laboratory.device.mechanical_viscosity_n_s_per_m /
                       damping_of_one};
  block.repetitions = 10000;
  const std::vector<AnsweredTrial> trials = answers(study, laboratory);
  const Share hits = share_of_ones(trials, is_test);
  EXPECT_NEAR(hits.ratio, 0.5, hits.tolerance);
  // One reading alone has a noise of ln(1 + w) / sqrt 2.
  const Share false_alarms = share_of_ones(trials, is_catch);
  EXPECT_NEAR(false_alarms.ratio, 0.0786, false_alarms.tolerance) << "Phi(-sqrt 2)";
}

TEST(TwoIntervalStaircase, FindsTheLevelAtWhichItsRuleBalances) {
  const Laboratory laboratory = plain_laboratory();
  Study study = study_with(R"json("procedure": "staircase", "task": "two_interval",
      "interval_order": "balanced", "catch_probability": 0.1,
      "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16, 6],
      "lowest_viscosity_pa_s": 4, "highest_viscosity_pa_s": 32,
      "step_ratio": [1.2, 1.1, 1.05], "max_reversals": 16, "num_reversals_averaged": 10,
      "max_trials": 200)json");
  const auto& block = std::get<Block>(study.stages.front().content);
  double sum_ln = 0.0;
  constexpr int kPersons = 40;
  for (std::uint64_t seed = 1; seed <= kPersons; ++seed) {
    const std::vector<AnsweredTrial> trials = answers(study, laboratory, seed);
    for (int series = 1; series <= 2; ++series) {
      const Staircase staircase(staircase_rule_of(block, series));
      sum_ln +=
          0.5 *
          std::log(*staircase.threshold(staircase.after(level_answers(trials, series))).level);
    }
  }
  // 70.7 % choose the test if it is 0.545 standard deviations above the reference.
  const double w = median_weber_fraction(laboratory, block);
  const double expected = kReference * std::exp(0.545 * std::log1p(w));
  EXPECT_NEAR(std::exp(sum_ln / kPersons) / expected, 1.0, 0.03);
}

TEST(TwoIntervalQuestPlus, FindsPointOfSubjectiveEqualityAndWeberFraction) {
  const Laboratory laboratory = plain_laboratory();
  Study study = study_with(R"json("procedure": "quest_plus", "task": "two_interval",
      "viscosity_pa_s": [5, 5.5, 6, 6.5, 7, 7.5, 8, 8.5, 9, 9.5, 10, 11, 12, 14],
      "reference_viscosity_pa_s": 8, "pse_viscosity_pa_s": [5, 12],
      "weber_fraction": [0.05, 1], "max_trials": 100)json");
  const auto& block = std::get<Block>(study.stages.front().content);
  const QuestPlus quest(quest_plus_rule_of(block));
  double pse_ln = 0.0, weber_ln = 0.0;
  constexpr int kPersons = 30;
  for (std::uint64_t seed = 1; seed <= kPersons; ++seed) {
    const auto estimates =
        quest.estimates(quest.posterior(level_answers(answers(study, laboratory, seed))));
    pse_ln += std::log(estimates[0].mean) / kPersons;
    weber_ln += std::log(estimates[1].mean) / kPersons;
  }
  EXPECT_NEAR(std::exp(pse_ln) / kReference, 1.0, 0.03);
  EXPECT_NEAR(std::exp(weber_ln) / median_weber_fraction(laboratory, block), 1.0, 0.15);
}

TEST(TwoIntervalLimits, ChangeTheirAnswerAboutTheReference) {
  const Laboratory laboratory = plain_laboratory();
  Study study = study_with(R"json("procedure": "limits", "task": "two_interval",
      "viscosity_pa_s": [5, 5.7, 6.4, 7.2, 8.1, 9.1, 10.2, 11.4, 12.8],
      "reference_viscosity_pa_s": 8, "num_series": 20)json");
  double sum_ln = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<AnsweredTrial> trials = answers(study, laboratory, seed);
    for (std::size_t i = 1; i < trials.size(); ++i) {
      if (trials[i].planned.series != trials[i - 1].planned.series ||
          trials[i].response == trials[i - 1].response) {
        continue;
      }
      sum_ln += 0.5 * std::log(*trials[i].planned.intensity * *trials[i - 1].planned.intensity);
      ++count;
    }
  }
  EXPECT_NEAR(std::exp(sum_ln / count) / kReference, 1.0, 0.03);
}

TEST(PracticeAnswers, EndWhereTheCriterionIsMet) {
  const Laboratory laboratory = plain_laboratory();
  Study study = study_with(R"json("procedure": "constant_stimuli", "viscosity_pa_s": [4, 16],
      "reference_viscosity_pa_s": 8, "repetitions": 30, "feedback": true,
      "practice": {"min_correct_ratio": 0.9, "num_trials_judged": 10, "max_trials": 60})json");
  const std::vector<AnsweredTrial> trials = answers(study, laboratory);
  EXPECT_GE(trials.size(), 10U);
  EXPECT_LT(trials.size(), 20U) << "these are easy";
}

/// The share of "cannot tell" in a block of many trials whose test equals the reference.
double share_open(Study& study, const Laboratory& laboratory) {
  double open = 0.0, all = 0.0;
  for (const AnsweredTrial& trial : answers(study, laboratory)) {
    open += trial.response ? 0.0 : 1.0;
    all += 1.0;
  }
  return open / all;
}

TEST(CannotTellAnswers, AreAsOftenAsTheNoiseIsWithinTheCertaintyThatPeopleAskFor) {
  // For two equal stimuli the difference over its noise is normal, and the certainty 2 Phi(|z|)
  // - 1 is uniform from 0 to 1.
  Laboratory laboratory = plain_laboratory();
  Study study =
      many_trials(R"json("task": "two_interval", "cannot_tell": true)json", laboratory);
  std::get<Block>(study.stages.front().content).intensities = {kReference};
  for (const double certainty : {0.0, 0.2, 0.5}) {
    laboratory.perceiver.cannot_tell_certainty = certainty;
    EXPECT_NEAR(share_open(study, laboratory), certainty,
                4.0 * std::sqrt(certainty * (1.0 - certainty) / 10000.0));
  }
}

TEST(CannotTellAnswers, WhoLapsesCannotTell) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.lapse_rate = 0.1;
  Study study = many_trials(R"json("cannot_tell": true)json", laboratory);
  auto& block = std::get<Block>(study.stages.front().content);
  block.intensities = {40.0 * kReference};  // At this level nobody is in doubt.
  EXPECT_NEAR(share_open(study, laboratory), 0.2, 0.016) << "twice the rate of errors";
}

TEST(CannotTellAnswers, LeaveTheOthersAsTheyAreWithoutThem) {
  for (const char* task : {"reminder", "yes_no", "two_interval", "same_different",
                           "three_interval", "oddity", "abx", "match_to_sample"}) {
    const Laboratory laboratory = thesis_laboratory();
    const std::string name = task;
    const bool is_above = name == "three_interval";
    const std::string keys =
        R"json("procedure": "constant_stimuli", "repetitions": 40, "task": ")json" + name +
        (is_above ? R"json(", "viscosity_pa_s": [9, 10, 12])json"
                  : R"json(", "viscosity_pa_s": [6, 7, 9, 12])json") +
        (name == "yes_no" ? "" : R"json(, "reference_viscosity_pa_s": 8)json");
    Study plain = study_with(keys);
    Study open = plain;
    std::get<Block>(open.stages.front().content).cannot_tell = true;
    const auto forced = answers(plain, laboratory);
    const auto told = answers(open, laboratory);
    ASSERT_EQ(told.size(), forced.size()) << task;
    int num_open = 0;
    for (std::size_t i = 0; i < told.size(); ++i) {
      num_open += told[i].response ? 0 : 1;
      if (!told[i].response) continue;
      EXPECT_EQ(told[i].response, forced[i].response) << task << i;
    }
    EXPECT_GT(num_open, 0) << task;
  }
}

AnsweredBlock timed(Study& study, const Laboratory& laboratory) {
  return AnswerSimulator(study, laboratory)
      .answers({{.stage = &study.stages.front()}}, 2)
      .front();
}

TEST(TimedAnswers, FeelEachStimulusAsLongAsTheBlockSays) {
  const Laboratory laboratory = plain_laboratory();  // People look at each stimulus once.
  Study study = study_with(R"json("procedure": "constant_stimuli", "viscosity_pa_s": [7, 9],
      "reference_viscosity_pa_s": 8, "repetitions": 10)json");
  auto& block = std::get<Block>(study.stages.front().content);
  const double usual_s = timed(study, laboratory).felt_s / 40.0;
  ASSERT_GT(usual_s, 1.0);
  ASSERT_LT(usual_s, 20.0);
  block.max_stimulus_s = 0.5;
  EXPECT_NEAR(timed(study, laboratory).felt_s, 40 * 0.5, 1e-9);
  block.max_stimulus_s = block.min_stimulus_s = 20.0;
  EXPECT_NEAR(timed(study, laboratory).felt_s, 40 * 20.0, 1e-9);
}

TEST(TimedAnswers, AMissedDeadlineTakesItsTimeAndTheTrialIsAnsweredOnce) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.look_again_probability = 0.5;
  Study study = study_with(R"json("procedure": "constant_stimuli", "viscosity_pa_s": [7, 9],
      "reference_viscosity_pa_s": 8, "repetitions": 50)json");
  auto& block = std::get<Block>(study.stages.front().content);
  block.min_stimulus_s = 20.0;
  block.answer_deadline_s = 21.0;  // A person who looks again misses this deadline.
  const AnsweredBlock answered = timed(study, laboratory);
  EXPECT_EQ(answered.trials.size(), 100U);
  const double missed = (answered.felt_s - 100.0 * 40.0) / 41.0;
  EXPECT_NEAR(missed, std::round(missed), 1e-9) << "20 s of the reference, 21 s until then";
  EXPECT_NEAR(missed, 50.0, 4.0 * 5.0) << "half of them look again, and hurry thereafter";
  block.max_returns = 1;
  EXPECT_NEAR(timed(study, laboratory).felt_s, 100.0 * 40.0, 1e-6)
      << "a second look takes two returns";
}

TEST(TimedAnswers, WhoMissedADeadlineHurriesWhenTheTrialComesAgain) {
  const Laboratory laboratory = plain_laboratory();
  Study study = study_with(R"json("procedure": "constant_stimuli", "viscosity_pa_s": [7, 9],
      "reference_viscosity_pa_s": 8, "repetitions": 5, "answer_deadline_s": 0.5)json");
  auto& block = std::get<Block>(study.stages.front().content);
  // With this duration, nobody can be in time.
  block.min_stimulus_s = block.max_stimulus_s.emplace(2.0);
  const AnsweredBlock answered = timed(study, laboratory);
  EXPECT_EQ(answered.trials.size(), 10U);
  EXPECT_NEAR(answered.felt_s, 10 * 2 * 2.5, 1e-9) << "each twice";
}

TEST(TimedAnswers, WhoHurriesStepsAsOftenAsThereIsTime) {
  const Laboratory laboratory = plain_laboratory();
  Study study = study_with(R"json("procedure": "magnitude_production", "viscosity_pa_s": [50],
      "target_percent": [1], "coarse_step_viscosity_pa_s": 1, "fine_step_viscosity_pa_s": 0.5,
      "answer_deadline_s": 7)json");
  auto& block = std::get<Block>(study.stages.front().content);
  block.min_stimulus_s = block.max_stimulus_s.emplace(2.0);
  const AnsweredBlock answered = timed(study, laboratory);
  EXPECT_EQ(answered.trials.front().response, 48.0) << "two steps, three looks";
  EXPECT_NEAR(answered.felt_s, 7.0 + 6.0, 1e-9);
}

}  // namespace task_answers_test
}  // namespace jnd::experiments
