#include "experiments/procedures/matching.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/stimulus.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"

namespace jnd::experiments {
namespace matching_test {

/// A study in which water is the standard of a viscous fluid.
const std::string kStudy = R"json({
  "format": 1, "name": "matching", "languages": ["en"], "title": {"en": "Matching"},
  "authors": ["A. Author"],
  "stages": [
    {"kind": "block", "name": "match", "procedure": "matching", "medium": "viscous",
     "viscosity_pa_s": [0.2, 5], "standard_medium": "water", "standard_scale": [1, 2, 4],
     "repetitions": 3, "coarse_step_viscosity_pa_s": 0.5, "fine_step_viscosity_pa_s": 0.1,
     "max_viscosity_pa_s": 20, "instruction": {"en": "Set it."},
     "question": {"en": "Alike?"}, "free_space_between_s": 2, "expected_trial_s": 45}]
})json";

const Block& block_of(const Study& study) {
  return std::get<Block>(study.stages.front().content);
}

std::vector<PlannedTrial> drawn(const Block& block, std::uint64_t seed) {
  core::RandomStream stream(seed, "order");
  return procedure_named("matching").draw_next(block, {}, stream);
}

TEST(Matching, PairsEveryStandardWithEveryStartOnceInEachRepetition) {
  const Study study = read_study_text(kStudy, "m.json");
  const Block& block = block_of(study);
  EXPECT_EQ(procedure_named("matching").expected_trials(block), 18);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<PlannedTrial> trials = drawn(block, seed);
    ASSERT_EQ(trials.size(), 18U);
    for (std::size_t first = 0; first < trials.size(); first += 6) {
      std::set<std::pair<double, double>> pairs;
      for (std::size_t i = first; i < first + 6; ++i) {
        EXPECT_EQ(trials[i].repetition, static_cast<int>(first / 6) + 1);
        EXPECT_EQ(trials[i].position, static_cast<int>(i - first) + 1);
        EXPECT_FALSE(trials[i].intensity) << "the participant sets it";
        pairs.emplace(trials[i].reference_intensity.value(),
                      trials[i].starting_intensity.value());
      }
      EXPECT_EQ(pairs.size(), 6U);
    }
  }
}

TEST(Matching, OrdersDifferBetweenSeedsAndRepetitions) {
  const Study study = read_study_text(kStudy, "m.json");
  std::set<std::vector<double>> orders;
  int num_alike = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<double> order;
    for (const PlannedTrial& trial : drawn(block_of(study), seed)) {
      order.push_back(*trial.reference_intensity + 100.0 * *trial.starting_intensity);
    }
    num_alike += std::equal(order.begin(), order.begin() + 6, order.begin() + 6) ? 1 : 0;
    orders.insert(std::move(order));
  }
  EXPECT_EQ(orders.size(), 20U);
  EXPECT_LE(num_alike, 2) << "one in 720";
}

TEST(Matching, IsFinishedOnceEverythingDrawnIsAnswered) {
  const Study study = read_study_text(kStudy, "m.json");
  std::vector<AnsweredTrial> answered;
  for (const PlannedTrial& trial : drawn(block_of(study), 1)) answered.push_back({trial, 1.0});
  core::RandomStream stream(1, "order");
  EXPECT_TRUE(procedure_named("matching").draw_next(block_of(study), answered, stream).empty());
}

TEST(Matching, IsAnsweredByAdjustingWithTheStandardToGoBackTo) {
  const TrialForm form = procedure_named("matching").form({});
  EXPECT_EQ(form.answer, AnswerKind::kMatch);
  EXPECT_TRUE(form.has_reference);
  EXPECT_TRUE(form.adjustable);
}

TEST(Matching, TheReferenceIsTheStandardsMediumAndTheTestTheBlocks) {
  const Study study = read_study_text(kStudy, "m.json");
  const MediumSetting standard = setting_of(block_of(study), "reference", 2.0);
  EXPECT_EQ(standard.medium, "water");
  EXPECT_EQ(standard.quantity, "scale");
  EXPECT_EQ(standard.intensity, 2.0);
  const MediumSetting comparison = setting_of(block_of(study), "test", 2.0);
  EXPECT_EQ(comparison.medium, "viscous");
  EXPECT_EQ(comparison.quantity, "viscosity_pa_s");
}

TEST(Matching, TheRangeHoldsStandardsStartsAndTheEndOfTheSteps) {
  const Study study = read_study_text(kStudy, "m.json");
  std::set<std::pair<std::string, double>> planned;
  for (const RangeEntry& entry : planned_range(study, {})) {
    planned.emplace(entry.setting.medium, entry.setting.intensity);
  }
  EXPECT_EQ(planned, (std::set<std::pair<std::string, double>>{{"viscous", 0.2},
                                                               {"viscous", 5.0},
                                                               {"viscous", 20.0},
                                                               {"water", 1.0},
                                                               {"water", 2.0},
                                                               {"water", 4.0}}));
}

TEST(Matching, APlanKnowsHowLongItTakes) {
  const Study study = read_study_text(kStudy, "m.json");
  EXPECT_EQ(expected_duration_s(study.stages.front()), 18 * 47.0);
}

}  // namespace matching_test
}  // namespace jnd::experiments
