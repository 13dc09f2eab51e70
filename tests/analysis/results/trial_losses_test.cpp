#include "analysis/results/trial_losses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/hand_made_study.h"

namespace jnd::analysis {
namespace trial_losses_test {

const ResultsOptions kQuick = {.num_resamples = 50};

core::TrialRow trial_at(double intensity, bool yes, const std::string& block = "honey") {
  return {.block = block,
          .procedure = "constant_stimuli",
          .quantity = "viscosity_pa_s",
          .repetition = 1,
          .intensity = intensity,
          .reference_intensity = 8.0,
          .response = yes ? 1.0 : 0.0};
}

/// Adds the presentations of the trial answered last: the reference with a stroke, the test
/// with or without one.
void felt(HandMadeStudy& study, std::int64_t num_strokes, std::int64_t limited_ticks = 0) {
  study.move({.presentation = 1,
              .interval = "reference",
              .intensity = 8.0,
              .measures = {.num_strokes = 2}});
  study.move({.presentation = 2,
              .interval = "test",
              .measures = {.num_strokes = num_strokes, .limited_ticks = limited_ticks}});
}

/// Adds ten answers at each of four levels, all without losses.
void add_sound_answers(HandMadeStudy& study, const std::string& block = "honey") {
  for (const auto& [level, num_yes] : {std::pair{4.0, 1}, {6.0, 3}, {11.0, 7}, {16.0, 9}}) {
    for (int i = 0; i < 10; ++i) {
      (void)study.answer(trial_at(level, i < num_yes, block));
      felt(study, 1);
    }
  }
}

const LevelLoss& loss_at(const std::vector<LevelLoss>& losses, std::optional<double> level) {
  return *std::ranges::find_if(losses,
                               [&](const LevelLoss& one) { return one.level == level; });
}

TEST(TrialLosses, AreCountedByLevel) {
  HandMadeStudy study;
  study.add("P01");
  add_sound_answers(study);
  // The test was felt once more without a stroke, but it had had one before.
  study.move({.presentation = 3, .interval = "test", .measures = {.num_strokes = 0}});
  (void)study.answer(trial_at(16.0, true));
  felt(study, 0);
  (void)study.answer(trial_at(16.0, true));
  felt(study, 1, 30);
  (void)study.answer(trial_at(16.0, true));
  study.undo_last_answer();
  study.answer_again(trial_at(16.0, false), 2);
  const std::int64_t faulted = study.answer(trial_at(16.0, true));
  study.happen("trial_started", faulted);
  study.happen("fault_raised");
  study.happen("attempt_discarded", faulted);
  study.happen("fault_raised");  // This happens between trials.
  study.exclude(study.answer(trial_at(4.0, true)));
  (void)study.draw(trial_at(4.0, true));
  const std::vector<LevelLoss> losses = level_losses(load_study(study.store()));
  ASSERT_EQ(losses.size(), 4U);
  EXPECT_FALSE(loss_at(losses, 6.0).is_any());
  const LevelLoss& low = loss_at(losses, 4.0);
  EXPECT_EQ(low.num_drawn, 12);
  EXPECT_EQ(low.num_answered, 10);
  EXPECT_EQ(low.num_set_aside, 1);
  EXPECT_EQ(low.num_unanswered(), 1);
  EXPECT_EQ(low.num_affected, 0);
  const LevelLoss& high = loss_at(losses, 16.0);
  EXPECT_EQ(high.num_answered, 14);
  EXPECT_EQ(high.num_strokeless, 1);
  EXPECT_EQ(high.num_limited, 1);
  EXPECT_EQ(high.num_repeated, 2);
  EXPECT_EQ(high.num_discarded, 1);
  EXPECT_EQ(high.num_faulted, 1);
  EXPECT_EQ(high.num_affected, 4);
  EXPECT_EQ(high.num_unanswered(), 0);
}

TEST(TrialLosses, CatchTrialsAreALevelOfTheirOwnAndManyLevelsAreOne) {
  HandMadeStudy study;
  study.add("P01");
  for (int i = 0; i < 40; ++i) (void)study.answer(trial_at(4.0 + 0.1 * i, i > 20));
  core::TrialRow nothing = trial_at(8.0, true);
  nothing.is_catch = true;
  (void)study.draw(nothing);
  const std::vector<LevelLoss> losses = level_losses(load_study(study.store()));
  ASSERT_EQ(losses.size(), 2U);
  EXPECT_FALSE(losses[0].level.has_value());
  EXPECT_EQ(losses[0].num_drawn, 40);
  EXPECT_TRUE(losses[1].is_catch);
  EXPECT_EQ(losses[1].num_unanswered(), 1);
}

/// Returns the results of twelve people, with this many additional "no" answers of each at 16
/// Pa s without a whole stroke.
StudyResults results_with(int num_strokeless) {
  HandMadeStudy study;
  for (int person = 11; person <= 22; ++person) {
    study.add("P" + std::to_string(person));
    add_sound_answers(study);
    for (int i = 0; i < num_strokeless; ++i) {
      (void)study.answer(trial_at(16.0, false));
      felt(study, 0);
    }
  }
  return results_of(load_study(study.store()), {}, kQuick);
}

constexpr char kPrimary[] = "honey.weber_fraction_median_person";
constexpr char kWithout[] = "honey.weber_fraction_median_person.without_affected_trials";

TEST(TrialLosses, ThePrimaryValueStandsWithoutThemWhereTheyAreMoreThanTwoInAHundred) {
  const StudyResults sound = results_with(0);
  const StudyResults results = results_with(9);
  ASSERT_NE(results.find(kWithout), nullptr);
  EXPECT_EQ(sound.find(kWithout), nullptr);
  EXPECT_NEAR(*results.find(kWithout)->value, *sound.find(kPrimary)->value, 1e-9);
  EXPECT_GT(*results.find(kPrimary)->value, 1.3 * *sound.find(kPrimary)->value);
  EXPECT_NE(results.find(kWithout)->meaning.find("18.4 % of the answers"), std::string::npos)
      << results.find(kWithout)->meaning;
  EXPECT_FALSE(results.find(kWithout)->primary);
  EXPECT_TRUE(std::ranges::any_of(results.find(kPrimary)->cautions, [](const std::string& one) {
    return one.find("outside of the interval") != std::string::npos;
  })) << "it moves out of its interval";
}

TEST(TrialLosses, OneInAHundredIsCountedAndMovesNothing) {
  HandMadeStudy study;
  study.add("P01");
  for (int block = 0; block < 3; ++block) add_sound_answers(study);
  (void)study.answer(trial_at(16.0, true));
  felt(study, 0);
  const StudyData data = load_study(study.store());
  EXPECT_NEAR(affected_ratio(data, "honey"), 1.0 / 121.0, 1e-12);
  EXPECT_EQ(affected_ratio(data, "no_such_block"), 0.0);
  const StudyResults results = results_of(data, {}, kQuick);
  EXPECT_EQ(results.find(kWithout), nullptr);
  EXPECT_EQ(loss_at(results.losses, 16.0).num_affected, 1);
}

TEST(TrialLosses, OtherBlocksKeepTheirAnswers) {
  HandMadeStudy study;
  study.add("P01");
  add_sound_answers(study);
  add_sound_answers(study, "water");
  (void)study.answer(trial_at(16.0, true, "water"));
  felt(study, 0);
  const StudyData data = load_study(study.store());
  const StudyData left = without_affected(data, {"water"});
  EXPECT_EQ(left.participants[0].trials_in("water").size(), 40U);
  EXPECT_EQ(left.participants[0].trials_in("honey").size(), 40U);
  EXPECT_EQ(without_affected(data, {"honey"}).participants[0].trials_in("water").size(), 41U);
}

TEST(TrialLosses, WhatARuleMadeOfThemHasNothingToSayWithoutThem) {
  HandMadeStudy study(R"json({"name": "by_hand", "stages": [
    {"kind": "block", "name": "felt", "procedure": "staircase", "task": "yes_no"}]})json");
  study.add("P01");
  for (int i = 0; i < 10; ++i) {
    core::TrialRow row = trial_at(0.1 * (1 + i % 3), i % 3 > 1, "felt");
    row.procedure = "staircase";
    row.reference_intensity.reset();
    (void)study.answer(row);
    study.move(
        {.presentation = 1, .interval = "test", .measures = {.num_strokes = i == 0 ? 0 : 1}});
  }
  StudyData data = load_study(study.store());
  data.runs.clear();  // The runs are made by hand instead.
  AdaptiveRun run{.participant = "P01", .block = "felt", .procedure = "staircase"};
  run.is_logarithmic = true;
  run.rule = "1 up, 2 down; Levitt 1971";
  run.target_probability = 0.7;
  run.tracks = {{.series = 1, .threshold = 0.2, .num_reversals = 2}};
  run.threshold = 0.2;
  data.runs.push_back(run);
  const StudyResults results = results_of(data, {}, kQuick);
  const Estimate* const found =
      results.find("felt.staircase_threshold.without_affected_trials");
  ASSERT_NE(found, nullptr);
  EXPECT_FALSE(found->value.has_value());
  EXPECT_NE(found->reason.find("its rule saw these trials"), std::string::npos);
}

}  // namespace trial_losses_test
}  // namespace jnd::analysis
