#include "experiments/protocol/study_rules.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace study_rules_test {

TEST(StudyRules, WantStagesItemsOptionsAndArmsToHaveNamesOfTheirOwn) {
  EXPECT_EQ(problems_of(broken("\"name\": \"rest\"", "\"name\": \"bucket\"")),
            "x.json:30:34: /stages/2/between/0/name: expected a name of its own, found "
            "`bucket`, the name of /stages/0/arms/0/stages/0 already");
  EXPECT_EQ(problems_of(broken("\"name\": \"handedness\"", "\"name\": \"freedom\"")),
            "x.json:39:17: /stages/3/items/2/name: expected a name of its own, found "
            "`freedom`, the name of /stages/3/items/1 already");
  EXPECT_EQ(
      problems_of(broken("\"value\": \"left\"", "\"value\": \"right\"")),
      "x.json:38:31: /stages/3/items/1/options/1/value: expected a name of its own, found "
      "`right`, the name of /stages/3/items/1/options/0 already");
  EXPECT_EQ(problems_of(broken("\"name\": \"high\"", "\"name\": \"low\"")),
            "x.json:24:16: /stages/2/arms/1/name: expected a name of its own, found `low`, the "
            "name of /stages/2/arms/0 already");
}

TEST(StudyRules, WantEveryStimulusOnce) {
  EXPECT_EQ(problems_of(broken("[0, 1, 2]", "[0, 1, 1.0]")),
            "x.json:14:41: /stages/1/scale/2: expected each value once, found 1.0 at index 1 "
            "already");
}

TEST(StudyRules, WantTheReferenceAmongTheTestStimuli) {
  for (const std::string reference : {"10.5", "20", "160"}) {
    EXPECT_EQ(
        problems_of(broken("\"reference_viscosity_pa_s\": 16",
                           "\"reference_viscosity_pa_s\": " + reference)),
        "x.json:26:89: /stages/2/arms/1/stages/0/reference_viscosity_pa_s: expected a "
        "number between the smallest and the largest test stimulus (10.5 and 20), found " +
            reference);
  }
}

TEST(StudyRules, TakeNoScaleOfZeroWhereRatiosAreCompared) {
  const std::string water =
      broken("\"viscous\", \"viscosity_pa_s\": [10.5, 20], \"reference_viscosity_pa_s\": 16",
             "\"water\", \"scale\": [0, 2], \"reference_scale\": 1");
  EXPECT_EQ(problems_of(water),
            "x.json:26:39: /stages/2/arms/1/stages/0/scale/0: expected a number > 0, as "
            "`constant_stimuli` compares ratios, found 0");
}

TEST(StudyRules, WantTheFineStepSmallerThanTheCoarseOne) {
  EXPECT_EQ(problems_of(broken("\"fine_step_scale\": 0.1", "\"fine_step_scale\": 0.5")),
            "x.json:21:55: /stages/2/arms/0/stages/0/fine_step_scale: expected a number < "
            "`coarse_step_scale` (0.5), found 0.5");
}

TEST(StudyRules, WantEveryStartingValueWithinTheEndOfTheAdjustment) {
  EXPECT_EQ(problems_of(broken("\"max_scale\": 8", "\"max_scale\": 3")),
            "x.json:21:73: /stages/2/arms/0/stages/0/max_scale: expected a number >= the "
            "largest starting value (4), found 3");
}

TEST(StudyRules, WantTheLargestAnswerAboveTheSmallest) {
  EXPECT_EQ(problems_of(broken("\"maximum\": 2.5", "\"maximum\": 1")),
            "x.json:34:90: /stages/3/items/0/maximum: expected a number > `minimum` (1), found "
            "1");
}

TEST(StudyRules, WantSomethingToBeOrderedInEveryArmOfAnOrder) {
  EXPECT_EQ(
      problems_of(broken("\"only_for\": {\"priming\": \"primed\"},", "",
                         broken("\"method\": \"one_of\"", "\"method\": \"order\""))),
      "x.json:12:38: /stages/0/arms/1/stages: expected one or more stages, as `method` is "
      "`order`, found an empty list");
}

TEST(StudyRules, PutNothingBetweenArmsOfWhichOnlyOneIsRun) {
  EXPECT_EQ(
      problems_of(broken("\"method\": \"order\"", "\"method\": \"one_of\"")),
      "x.json:29:6: /stages/2/between: expected this key only where `method` is `order` or "
      "`latin`, found it where `method` is `one_of`");
}

TEST(StudyRules, TakeNoCounterbalanceInsideAnother) {
  const std::string inner =
      R"({"kind": "counterbalance", "name": "inner", "method": "one_of",
          "arms": [{"name": "a", "stages": []}, {"name": "b", "stages": []}]}, )";
  EXPECT_EQ(problems_of(broken("{\"kind\": \"break\", \"name\": \"bucket\"",
                               inner + "{\"kind\": \"break\", \"name\": \"bucket\"")),
            "x.json:11:18: /stages/0/arms/0/stages/0/kind: expected no counterbalance inside "
            "another, found one; side by side they are crossed");
  EXPECT_EQ(
      problems_of(broken("\"between\": [", "\"between\": [" + inner)),
      "x.json:29:27: /stages/2/between/0/kind: expected no counterbalance inside another, "
      "found one; side by side they are crossed");
}

TEST(StudyRules, WantOnlyForToNameAnArmThatExists) {
  EXPECT_EQ(problems_of(broken("{\"priming\": \"primed\"}", "{\"prining\": \"primed\"}")),
            "x.json:30:66: /stages/2/between/0/only_for/prining: expected the name of a "
            "`one_of` counterbalance, found `prining`; did you mean `priming`?");
  EXPECT_EQ(problems_of(broken("{\"priming\": \"primed\"}", "{\"priming\": \"prime\"}")),
            "x.json:30:66: /stages/2/between/0/only_for/priming: expected an arm of `priming`: "
            "`primed` or `unprimed`, found `prime`; did you mean `primed`?");
  EXPECT_EQ(problems_of(broken("{\"priming\": \"primed\"}", "{\"group_order\": \"low\"}")),
            "x.json:30:70: /stages/2/between/0/only_for/group_order: expected the name of a "
            "`one_of` counterbalance (`priming`), found `group_order`, whose method is `order` "
            "and of which everybody gets every arm");
}

TEST(StudyRules, RefuseMoreTrialsThanAnyoneCanDo) {
  std::string scales = "[0";
  for (int i = 1; i < 51; ++i) scales += ", " + std::to_string(i);
  // The trials are so short that the session is not too long.
  const std::string text =
      broken("[0, 1, 2], \"repetitions\": 3", scales + "], \"repetitions\": 1000",
             broken("\"expected_trial_s\": 20", "\"expected_trial_s\": 0.1"));
  EXPECT_EQ(problems_of(text),
            "x.json:8:13: /stages: expected at most 50000 trials in all blocks together, found "
            "51014");
  EXPECT_EQ(problems_of(broken("1000", "900", text)), "");
}

TEST(StudyRules, AWallStandsWhereTheFluidEndsAndFrictionOnAWall) {
  const auto with = [](const std::string& immersion) {
    return problems_of(
        broken("\"blinding\": \"none\"", "\"device\": {\"immersion\": {" + immersion + "}}"));
  };
  EXPECT_EQ(with("\"wall_stiffness_n_per_m\": 800, \"depth_m\": 0.3"), "");
  EXPECT_EQ(with("\"wall_stiffness_n_per_m\": 800, \"radius_m\": 0.3, "
                 "\"wall_friction_ratio\": 0.5"),
            "");
  EXPECT_EQ(with("\"wall_friction_ratio\": 0"), "");
  EXPECT_EQ(with("\"wall_stiffness_n_per_m\": 800"),
            "x.json:7:54: /device/immersion/wall_stiffness_n_per_m: expected this key only "
            "beside `radius_m` or `depth_m`, which say where the wall is, found neither");
  EXPECT_EQ(with("\"depth_m\": 0.3, \"wall_friction_ratio\": 0.5"),
            "x.json:7:67: /device/immersion/wall_friction_ratio: expected this key only beside "
            "`wall_stiffness_n_per_m`, found no wall");
}

TEST(StudyRules, RefuseMoreCellsThanAnyoneCanFill) {
  std::string many = "\"stages\": [";
  for (int i = 0; i < 6; ++i) {
    many += R"({"kind": "counterbalance", "name": "c)" + std::to_string(i) +
            R"(", "method": "one_of", "arms": [)";
    for (int arm = 0; arm < 5; ++arm) {
      many += std::string(arm > 0 ? "," : "") + R"({"name": "a)" + std::to_string(arm) +
              R"(", "stages": []})";
    }
    many += "]},";
  }
  EXPECT_EQ(problems_of(broken("\"stages\": [", many)),
            "x.json:8:13: /stages: expected fields, counterbalances and squares that cross to "
            "at most "
            "10000 cells, "
            "found 62500");
}

TEST(StudyRules, AForceMapNeedsEveryAngleWithEverySpeedAndNoLiftAtItsEnds) {
  const auto with_map = [](const std::string& rows) {
    return problems_of(
        broken("\"blinding\": \"none\"",
               "\"blinding\": \"none\", \"device\": {\"force_map\": [" + rows + "]}"));
  };
  const std::string edge_on =
      R"({"angle_of_attack_rad": 0, "speed_m_per_s": 1, "drag_coefficient": 0.3})";
  const std::string head_on =
      R"({"angle_of_attack_rad": 1.5708, "speed_m_per_s": 1, "drag_coefficient": 0.9})";
  EXPECT_EQ(with_map(edge_on + ", " + head_on), "");
  EXPECT_NE(with_map(edge_on + ", " + edge_on), "");
  EXPECT_NE(with_map(edge_on), "") << "one angle is no curve";
  EXPECT_NE(with_map(edge_on + ", " + head_on + R"(,
      {"angle_of_attack_rad": 0, "speed_m_per_s": 2, "drag_coefficient": 0.3})"),
            "");
  const std::string lifted = with_map(
      R"({"angle_of_attack_rad": 0, "speed_m_per_s": 1, "drag_coefficient": 0.3,
          "lift_coefficient": 0.1}, )" +
      head_on);
  EXPECT_NE(lifted.find("/device/force_map: line "), std::string::npos) << lifted;
  EXPECT_NE(lifted.find("lift_coefficient: expected 0 at the angles 0 and pi/2, found 0.1"),
            std::string::npos)
      << lifted;
  const std::string twice =
      with_map(R"({"angle_of_attack_rad": 45, "speed_m_per_s": 1, "drag_coefficient": 0.3}, )" +
               head_on);
  EXPECT_EQ(std::count(twice.begin(), twice.end(), '\n'), 0) << "one mistake, one problem";
}

}  // namespace study_rules_test
}  // namespace jnd::experiments
