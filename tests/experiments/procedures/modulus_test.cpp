#include <gtest/gtest.h>

#include <set>

#include "experiments/procedures/magnitude_estimation.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"

namespace jnd::experiments {
namespace modulus_test {

Study study_with(const std::string& keys) {
  return read_study_text(R"json({
  "format": 1, "name": "modulus", "languages": ["en"], "title": {"en": "Modulus"},
  "authors": ["A. Author"],
  "stages": [
    {"kind": "block", "name": "how_thick", "procedure": "magnitude_estimation",
     "medium": "viscous", "viscosity_pa_s": [2, 4, 8, 16], "repetitions": 2, )json" +
                             keys + R"json(
     "instruction": {"en": "Say."}, "question": {"en": "How thick?"}, "expected_trial_s": 15}]
})json",
                         "modulus.json");
}

const Block& block_of(const Study& study) {
  return std::get<Block>(study.stages.front().content);
}

std::vector<PlannedTrial> drawn(const Block& block) {
  core::RandomStream stream(3, "order");
  return procedure_named("magnitude_estimation").draw_next(block, {}, stream);
}

TrialForm form_of(const Block& block) {
  return procedure_named("magnitude_estimation").form(block);
}

TEST(Modulus, IsPercentOfWaterUnlessTheStudySaysOtherwise) {
  const Study study = study_with("");
  EXPECT_EQ(modulus_of(block_of(study)), Modulus::kWater);
  EXPECT_EQ(form_of(block_of(study)).answer, AnswerKind::kPercent);
  EXPECT_FALSE(form_of(block_of(study)).has_reference);
}

TEST(Modulus, AStandardIsFeltInEveryTrialAndCountsAsItsNumber) {
  const Study study = study_with(
      R"("modulus": "standard", "standard_medium": "water", "standard_scale": [2],)");
  const Block& block = block_of(study);
  EXPECT_EQ(form_of(block).answer, AnswerKind::kNumber);
  EXPECT_TRUE(form_of(block).has_reference);
  EXPECT_EQ(block.settings.number("modulus_value"), 100.0);
  EXPECT_EQ(setting_of(block, "reference", 2.0).medium, "water");
  ASSERT_EQ(drawn(block).size(), 8U);
  for (const PlannedTrial& trial : drawn(block)) EXPECT_EQ(trial.reference_intensity, 2.0);
}

TEST(Modulus, AStandardMayBeFeltEverySoManyTrials) {
  const Study study = study_with(
      R"("modulus": "standard", "standard_medium": "viscous", "standard_viscosity_pa_s": [5],
         "standard_every_trials": 3, "modulus_value": 10,)");
  std::vector<bool> has_standard;
  for (const PlannedTrial& trial : drawn(block_of(study))) {
    has_standard.push_back(trial.reference_intensity.has_value());
  }
  EXPECT_EQ(has_standard,
            (std::vector<bool>{true, false, false, true, false, false, true, false}));
}

TEST(Modulus, AStandardDoesNotChangeTheOrderOfTheStimuli) {
  const Study with = study_with(
      R"("modulus": "standard", "standard_medium": "water", "standard_scale": [2],)");
  const Study without = study_with("");
  const auto a = drawn(block_of(with)), b = drawn(block_of(without));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].intensity, b[i].intensity);
}

TEST(Modulus, WhoChoosesNumbersAnswersAboveZero) {
  const Study study = study_with(R"("modulus": "free",)");
  EXPECT_EQ(form_of(block_of(study)).answer, AnswerKind::kNumber);
  EXPECT_FALSE(form_of(block_of(study)).has_reference);
}

TEST(Modulus, TheRangeHoldsTheStandard) {
  const Study study = study_with(
      R"("modulus": "standard", "standard_medium": "water", "standard_scale": [2],)");
  int num_standards = 0;
  for (const RangeEntry& entry : planned_range(study, {})) {
    num_standards += entry.setting.medium == "water" && entry.setting.intensity == 2.0 ? 1 : 0;
  }
  EXPECT_EQ(num_standards, 1);
}

}  // namespace modulus_test
}  // namespace jnd::experiments
