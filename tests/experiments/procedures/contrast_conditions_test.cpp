#include "experiments/procedures/contrast_conditions.h"

#include <gtest/gtest.h>

#include <tuple>

#include "experiments/designed_study.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::experiments {
namespace contrast_conditions_test {

ContrastConditions conditions_of(const std::string& of) {
  const Study study = read_study_text(designed_study(fluid_contrast("", "one", of)), "x.json");
  return contrast_conditions(study, study.contrasts.front());
}

TEST(ContrastConditions, BlocksWithTheSameLevelsAreOne) {
  const ContrastConditions found = conditions_of(R"({"fluid": {"thin": 1, "thick": -1}})");
  EXPECT_EQ(found.problem, "");
  ASSERT_EQ(found.conditions.size(), 2U);
  EXPECT_EQ(found.conditions[0].name, "thin");
  EXPECT_EQ(found.conditions[0].blocks, (std::vector<std::string>{"thin_a", "thin_c"}));
  EXPECT_EQ(found.conditions[1].blocks, std::vector<std::string>{"thick_b"});
}

TEST(ContrastConditions, PeopleWhoAreNotNamedAreAveraged) {
  const ContrastConditions found = conditions_of(R"({"fluid": {"thin": 1, "thick": -1}})");
  ASSERT_EQ(found.groups.size(), 2U);
  EXPECT_EQ(found.groups[0].name, "primed");
  for (const std::vector<double>& weights : found.weights) {
    EXPECT_EQ(weights, (std::vector<double>{0.5, -0.5}));
  }
}

TEST(ContrastConditions, AnInteractionIsTheProduct) {
  const ContrastConditions found = conditions_of(
      R"({"fluid": {"thin": 2, "thick": -2}, "priming": {"primed": 1, "control": -1}})");
  ASSERT_EQ(found.weights.size(), 2U);
  EXPECT_EQ(found.weights[0], (std::vector<double>{1.0, -1.0})) << "scaled";
  EXPECT_EQ(found.weights[1], (std::vector<double>{-1.0, 1.0}));
}

TEST(ContrastConditions, WeightsAboveZeroAloneRestrict) {
  const ContrastConditions found =
      conditions_of(R"({"fluid": {"thin": 1, "thick": -1}, "priming": {"primed": 3}})");
  ASSERT_EQ(found.groups.size(), 1U);
  EXPECT_EQ(found.groups[0].levels, (Levels{{"priming", "primed"}}));
  EXPECT_EQ(found.weights[0], (std::vector<double>{1.0, -1.0}));
}

TEST(ContrastConditions, APeoplesFactorComparesThemOverAllBlocks) {
  const ContrastConditions found =
      conditions_of(R"({"priming": {"primed": 1, "control": -1}})");
  ASSERT_EQ(found.conditions.size(), 2U);
  EXPECT_EQ(found.weights[0], (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(found.weights[1], (std::vector<double>{-0.5, -0.5}));
}

TEST(ContrastConditions, BlocksFactorsThatAreNotNamedAreAveraged) {
  std::string text = designed_study(fluid_contrast());
  const auto replace = [&](const std::string& from, const std::string& to, std::size_t at) {
    text.replace(text.find(from, at), from.size(), to);
  };
  replace(R"([{"name": "fluid")",
          R"([{"name": "vision", "levels": ["on", "off"]}, {"name": "fluid")", 0);
  for (const auto& [block, fluid, vision] : {std::tuple("thin_a", "thin", "on"),
                                             {"thick_b", "thick", "on"},
                                             {"thin_c", "thin", "off"}}) {
    const std::string level = std::string(R"({"fluid": ")") + fluid + "\"}";
    replace(level, std::string(R"({"fluid": ")") + fluid + R"(", "vision": ")" + vision + "\"}",
            text.find(std::string("\"name\": \"") + block));
  }
  const Study study = read_study_text(text, "x.json");
  const ContrastConditions found = contrast_conditions(study, study.contrasts.front());
  ASSERT_EQ(found.conditions.size(), 3U);
  EXPECT_EQ(found.conditions[0].name, "thin, on");
  // Each group of people has half of the weight, and each of the two thin blocks half of that.
  EXPECT_EQ(found.weights[0], (std::vector<double>{0.25, -0.5, 0.25}));
}

TEST(ContrastConditions, BlocksCanBeComparedByName) {
  const ContrastConditions found =
      conditions_of(R"({"block": {"thin_a": 1, "thick_b": 1, "thin_c": -2}})");
  ASSERT_EQ(found.conditions.size(), 3U);
  EXPECT_EQ(found.conditions[1].name, "thick_b");
  EXPECT_EQ(found.weights[0], (std::vector<double>{0.25, 0.25, -0.5}));
}

TEST(ContrastConditions, WhatIsNotMeasuredIsAProblemThatNamesWhatIs) {
  const Study study = read_study_text(designed_study(fluid_contrast()), "x.json");
  PlannedContrast plan = study.contrasts.front();
  plan.measure = ContrastMeasure::kMatch;
  EXPECT_EQ(
      contrast_conditions(study, plan).problem,
      "expected blocks with these levels that have the measure `match`, found none: "
      "`thick_b`, `thin_a` and `thin_c` have `weber_fraction`, `pse` and `response_time`; "
      "compare in what they have, or compare other blocks");
  plan.measure = ContrastMeasure::kQuestion;
  plan.question = "confidence";
  EXPECT_NE(contrast_conditions(study, plan).problem.find("ask the question `confidence`"),
            std::string::npos);
  plan.measure = ContrastMeasure::kResponseTime;
  EXPECT_EQ(contrast_conditions(study, plan).problem, "");
}

TEST(ContrastConditions, ABlockThatCannotBeComparedIsNamedWithWhatItHas) {
  std::string text = designed_study(
      fluid_contrast("", "one", R"({"fluid": {"thin": 1, "thick": -1}})", "response_time"));
  const std::string thick = R"("name": "thick_b", "procedure": "constant_stimuli",)";
  text.replace(text.find(thick), thick.size(), thick + R"( "task": "two_interval",)");
  const Study study = read_study_text(text, "x.json");
  PlannedContrast plan = study.contrasts.front();
  plan.measure = ContrastMeasure::kPse;
  EXPECT_EQ(
      contrast_conditions(study, plan).problem,
      "expected blocks that have the measure `pse` for each of the 2 combinations of these "
      "levels, found none for `fluid` `thick`: `thick_b` has `weber_fraction` and "
      "`response_time`; compare in what all have, or leave these levels out of the "
      "contrast");
}

// Every measure of the study format must have blocks to which it applies.
TEST(ContrastConditions, ARatingAndAnAnswerToAQuestionAreMeasures) {
  Block rates, compares;
  rates.procedure = "rating";
  compares.procedure = "constant_stimuli";
  for (const auto& [name, kind] : {std::pair("confidence", "scale"), {"remark", "text"}}) {
    QuestionnaireItem& item = compares.questions.emplace_back();
    item.name = name;
    item.kind = kind;
  }
  PlannedContrast plan;
  plan.measure = ContrastMeasure::kRating;
  EXPECT_TRUE(has_measure(rates, plan));
  EXPECT_FALSE(has_measure(compares, plan));
  const auto asks = [&](const std::string& question) {
    plan.measure = ContrastMeasure::kQuestion;
    plan.question = question;
    return has_measure(compares, plan);
  };
  EXPECT_TRUE(asks("confidence"));
  EXPECT_FALSE(asks("remark")) << "words have no mean";
  EXPECT_FALSE(asks("pleasure"));
  EXPECT_FALSE(is_ratio(ContrastMeasure::kRating));
  EXPECT_FALSE(is_ratio(ContrastMeasure::kQuestion));
}

}  // namespace contrast_conditions_test
}  // namespace jnd::experiments
