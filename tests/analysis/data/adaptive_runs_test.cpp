#include "analysis/data/adaptive_runs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/protocol/study_reader.h"

namespace jnd::analysis {
namespace adaptive_runs_test {

using experiments::Block;

/// Returns the block of a study whose one block has these keys besides those of every block.
Block block_with(const std::string& keys) {
  const experiments::Study study = experiments::read_study_text(
      R"json({"format": 1, "name": "adaptive", "languages": ["en"], "title": {"en": "A"},
        "authors": ["A. Author"], "stages": [{"kind": "block", "name": "one",
        "medium": "viscous", "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
        "expected_trial_s": 5, )json" +
          keys + "}]}",
      "study.json");
  return std::get<Block>(study.stages.front().content);
}

struct Answer {
  double level;
  bool yes;
  int series = 1;
};

AdaptiveRun run_of(const Block& block, const std::vector<Answer>& answers,
                   std::vector<bool> set_aside = {}) {
  std::vector<core::TrialRow> rows;
  for (const Answer& answer : answers) {
    rows.push_back({.intensity = answer.level,
                    .response = answer.yes ? 1.0 : 0.0,
                    .series = answer.series});
  }
  set_aside.resize(rows.size());
  return adaptive_run_of(block, rows, set_aside);
}

Block staircase_block(const std::string& more = "") {
  return block_with(R"json("procedure": "staircase", "reference_viscosity_pa_s": 8,
    "start_viscosity_pa_s": [16, 4], "lowest_viscosity_pa_s": 1,
    "highest_viscosity_pa_s": 64, "step_ratio": [2], "num_down": 1,
    "num_reversals_averaged": 2)json" +
                    more);
}

TEST(AdaptiveRuns, AStaircaseIsTheMeanOfItsLastReversalsAndOfThoseInterleaved) {
  // First: 16 yes, 8 no (turns), 16 yes (turns), 8. Second: 4 no, 8 yes (turns), 4 no (turns).
  const AdaptiveRun run = run_of(staircase_block(), {{16, true, 1},
                                                     {4, false, 2},
                                                     {8, false, 1},
                                                     {8, true, 2},
                                                     {16, true, 1},
                                                     {4, false, 2}});
  EXPECT_EQ(run.problem, "");
  EXPECT_EQ(run.rule, "1 up, 1 down; Levitt 1971");
  EXPECT_NEAR(*run.target_probability, 0.5, 1e-12);
  EXPECT_TRUE(run.is_logarithmic);
  ASSERT_EQ(run.tracks.size(), 2U);
  EXPECT_NEAR(*run.tracks[0].threshold, std::sqrt(8.0 * 16.0), 1e-9);
  EXPECT_NEAR(*run.tracks[1].threshold, std::sqrt(8.0 * 4.0), 1e-9);
  EXPECT_NEAR(*run.threshold, 8.0, 1e-9);
  const TrackPoint& turned = run.tracks[0].points[1];
  EXPECT_EQ(turned.trial, 3) << "in the block";
  EXPECT_TRUE(turned.is_reversal);
  EXPECT_TRUE(turned.is_averaged);
  EXPECT_FALSE(run.tracks[0].points[0].is_reversal);
}

TEST(AdaptiveRuns, AWeightedStaircaseSaysItsRatio) {
  const AdaptiveRun run =
      run_of(staircase_block(R"(, "down_per_up_ratio": 0.5)"), {{16, true, 1}, {4, true, 2}});
  EXPECT_EQ(run.rule, "1 up, 1 down, steps down 0.5 times those up; Kaernbach 1991");
  EXPECT_NEAR(*run.target_probability, 2.0 / 3.0, 1e-12);
  EXPECT_FALSE(run.threshold.has_value()) << "nothing turned";
}

TEST(AdaptiveRuns, LimitsAreMeansOfTransitionsByDirection) {
  const Block block = block_with(R"json("procedure": "limits", "task": "yes_no",
    "viscosity_pa_s": [1, 2, 4, 8], "num_series": 2, "first_series": "ascending",
    "max_start_offset": 0)json");
  const AdaptiveRun run = run_of(block, {{1, false, 1},
                                         {2, false, 1},
                                         {4, true, 1},
                                         {8, true, 2},
                                         {4, true, 2},
                                         {2, true, 2},
                                         {1, false, 2}});
  EXPECT_EQ(run.problem, "");
  ASSERT_EQ(run.tracks.size(), 2U);
  EXPECT_EQ(run.tracks[0].direction, "ascending");
  EXPECT_EQ(run.tracks[1].direction, "descending");
  EXPECT_NEAR(*run.limits.ascending, std::sqrt(8.0), 1e-9);
  EXPECT_NEAR(*run.limits.descending, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(*run.threshold, 2.0, 1e-9);
  EXPECT_NEAR(*run.limits.constant_error, std::log(2.0), 1e-9) << "habituation";
}

/// Returns ten answers at each level of a person with the pse 10 and the Weber fraction 0.2.
std::vector<Answer> around_10() {
  std::vector<Answer> answers;
  for (const auto& [level, num_yes] : std::vector<std::pair<double, int>>{
           {7, 0}, {8, 1}, {9, 3}, {10, 5}, {11, 7}, {12, 8}, {14, 10}}) {
    for (int i = 0; i < 10; ++i) answers.push_back({level, i < num_yes, 0});
  }
  return answers;
}

TEST(AdaptiveRuns, APosteriorAtTheEndOfAGridHasNoIntervalOnAnyAxis) {
  const std::string keys = R"json("procedure": "quest_plus",
    "viscosity_pa_s": [7, 8, 9, 10, 11, 12, 14], "reference_viscosity_pa_s": 10,
    "weber_fraction": [0.02, 2], "max_trials": 70, "pse_viscosity_pa_s": )json";
  const AdaptiveRun wide = run_of(block_with(keys + "[5, 20]"), around_10());
  ASSERT_EQ(wide.posterior.size(), 2U);
  EXPECT_TRUE(wide.reached_ends.empty());
  EXPECT_NEAR(wide.posterior[0].mean, 10.0, 0.2);
  EXPECT_LT(wide.posterior[0].low.value(), 10.0);
  EXPECT_GT(wide.posterior[0].high.value(), 10.0);
  EXPECT_NEAR(wide.posterior[1].mean, 0.2, 0.03);

  const AdaptiveRun cut = run_of(block_with(keys + "[9.9, 16]"), around_10());
  EXPECT_EQ(cut.reached_ends,
            std::vector<std::string>{"the lower end of `pse_viscosity_pa_s` (9.9)"});
  for (const analysis::PosteriorEstimate& one : cut.posterior) {
    EXPECT_FALSE(one.low || one.high) << one.parameter;
  }
}

TEST(AdaptiveRuns, QuestPlusIsItsPosteriorWithoutTrialsSetAside) {
  const Block block = block_with(R"json("procedure": "quest_plus",
    "viscosity_pa_s": [4, 6, 8, 11, 16], "reference_viscosity_pa_s": 8,
    "pse_viscosity_pa_s": [8, 8], "weber_fraction": [0.05, 2], "max_trials": 10)json");
  const std::vector<Answer> answers = {{11, true, 0}, {6, false, 0}, {11, false, 0}};
  const AdaptiveRun all = run_of(block, answers);
  const AdaptiveRun two = run_of(block, answers, {false, false, true});
  ASSERT_EQ(all.posterior.size(), 1U) << "the pse is taken for known, as are lapses";
  EXPECT_EQ(all.posterior.front().parameter, "weber_fraction");
  EXPECT_LT(two.posterior.front().mean, all.posterior.front().mean);
  EXPECT_EQ(two.num_set_aside, 1);
  EXPECT_EQ(two.tracks.front().points.size(), 3U);
  EXPECT_EQ(all.reached_ends, std::vector<std::string>{"the upper end of `weber_fraction` (2)"})
      << "who does not feel 11 beside 8 has no small Weber fraction";
}

TEST(AdaptiveRuns, CatchTrialsMoveNoLevel) {
  std::vector<core::TrialRow> rows;
  for (const double level : {16.0, 8.0, 8.0}) {
    rows.push_back({.intensity = level, .response = 1.0, .series = 1});
  }
  rows[1].is_catch = true;
  const AdaptiveRun run = adaptive_run_of(staircase_block(), rows, std::vector<bool>(3));
  ASSERT_EQ(run.tracks[0].points.size(), 2U);
  EXPECT_EQ(run.tracks[0].points[1].trial, 3);
}

TEST(AdaptiveRuns, AnswersThatDoNotFollowTheRuleAreAProblemNamed) {
  const AdaptiveRun run = run_of(staircase_block(), {{-1, true, 1}});
  EXPECT_NE(run.problem.find("do not follow"), std::string::npos) << run.problem;
  EXPECT_EQ(run_of(staircase_block(), {}).problem, "no answers");
}

}  // namespace adaptive_runs_test
}  // namespace jnd::analysis
