#include "analysis/results/block_words.h"

#include <gtest/gtest.h>

#include "app/operator/study_outline.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace block_words_test {

experiments::Study study_with(const std::string& keys) {
  return experiments::read_study_text(
      R"json({"format": 1, "name": "adaptive", "languages": ["en"], "title": {"en": "A"},
        "authors": ["A. Author"], "stages": [{"kind": "block", "name": "one",
        "medium": "viscous", "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
        "expected_trial_s": 5, )json" +
          keys + "}]}",
      "study.json");
}

const std::string kStaircase = R"json("procedure": "staircase",
  "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16, 4], "lowest_viscosity_pa_s": 1,
  "highest_viscosity_pa_s": 30, "step_ratio": [1.5, 1.25], "num_down": 2,
  "max_reversals": 10)json";

TEST(BlockWords, AStaircaseTellsItsRuleAndWhereItsLevelsLie) {
  const StudyOutline outline = outline_of(study_with(kStaircase));
  ASSERT_EQ(outline.stages.size(), 1U);
  EXPECT_EQ(outline.stages[0].what,
            "2 staircases, 1 up 2 down, each to 10 reversals or 60 trials: about 54 trials");
  EXPECT_EQ(outline.stages[0].details,
            (std::vector<std::string>{
                "viscous, from 1 to 30 Pa s", "viscous, starting at 16, 4 Pa s",
                "viscous, steps by the factors 1.5, 1.25", "reference 8 Pa s"}));
}

TEST(BlockWords, AllOfItStandsInOneLineOfAReport) {
  const experiments::Study study = study_with(kStaircase);
  EXPECT_EQ(
      analysis::adaptive_design_words(
          std::get<experiments::Block>(study.stages.front().content), "Pa s"),
      "2 staircases, 1 up 2 down, each to 10 reversals or 60 trials, the last 6 reversals "
      "averaged; from 1 to 30 Pa s; starting at 16, 4 Pa s; steps by the factors 1.5, "
      "1.25");
}

TEST(BlockWords, LimitsAndQuestPlusTellTheirLevels) {
  const StudyOutline limits = outline_of(study_with(R"json("procedure": "limits",
    "task": "yes_no", "viscosity_pa_s": [1, 2, 4, 8], "num_series": 6)json"));
  EXPECT_EQ(limits.stages[0].what, "6 series over 4 levels: about 12 trials");
  const StudyOutline quest = outline_of(study_with(R"json("procedure": "quest_plus",
    "viscosity_pa_s": [4, 8, 16], "reference_viscosity_pa_s": 8,
    "pse_viscosity_pa_s": [4, 16], "max_trials": 40)json"));
  EXPECT_EQ(quest.stages[0].what, "QUEST+ over 3 levels: about 40 trials");
  EXPECT_EQ(quest.stages[0].details[1], "viscous, levels 4, 8, 16 Pa s");
}

TEST(BlockWords, ARuleWithoutListedLevelsTellsNone) {
  experiments::Block block{.procedure = "rating"};
  EXPECT_EQ(analysis::adaptive_words(block), "rating on a scale");
  block.intensities = {1.0, 2.0};
  EXPECT_EQ(analysis::adaptive_words(block), "rating on a scale over 2 levels");
}

TEST(BlockWords, WhereTheDesignDecidesTheNumberIsNoGuess) {
  const experiments::Study study = study_with(R"json("procedure": "constant_stimuli",
    "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8, "repetitions": 3)json");
  const auto& block = std::get<experiments::Block>(study.stages.front().content);
  EXPECT_FALSE(analysis::length_is_expected(block));
  EXPECT_EQ(analysis::trials_to_expect(block, 6), "6");
  EXPECT_EQ(outline_of(study).stages[0].what, "2 stimuli, 3 times: 6 trials");
}

}  // namespace block_words_test
}  // namespace jnd::app
