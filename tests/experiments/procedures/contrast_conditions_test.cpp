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
  // Half for each group of people, and half of that for either of the thin ones.
  EXPECT_EQ(found.weights[0], (std::vector<double>{0.25, -0.5, 0.25}));
}

TEST(ContrastConditions, BlocksCanBeComparedByName) {
  const ContrastConditions found =
      conditions_of(R"({"block": {"thin_a": 1, "thick_b": 1, "thin_c": -2}})");
  ASSERT_EQ(found.conditions.size(), 3U);
  EXPECT_EQ(found.conditions[1].name, "thick_b");
  EXPECT_EQ(found.weights[0], (std::vector<double>{0.25, 0.25, -0.5}));
}

TEST(ContrastConditions, WhatIsNotMeasuredIsAProblem) {
  const Study study = read_study_text(designed_study(fluid_contrast()), "x.json");
  PlannedContrast plan = study.contrasts.front();
  plan.measure = ContrastMeasure::kMatch;
  EXPECT_NE(contrast_conditions(study, plan).problem, "");
  plan.measure = ContrastMeasure::kResponseTime;
  EXPECT_EQ(contrast_conditions(study, plan).problem, "");
}

}  // namespace contrast_conditions_test
}  // namespace jnd::experiments
