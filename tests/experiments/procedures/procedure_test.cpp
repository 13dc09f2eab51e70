#include "experiments/procedures/procedure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/error.h"
#include "experiments/procedures/procedure_registry.h"

namespace jnd::experiments {
namespace procedure_test {

Block block_for(std::string_view procedure) {
  Block block{.procedure = std::string(procedure),
              .medium = "water",
              .quantity = "scale",
              .intensities = {0.25, 0.5, 1.0, 2.0, 4.0},
              .reference_intensity = 1.0,
              .target_percent = {200.0, 50.0, 100.0},
              .repetitions = 3};
  if (procedure == "magnitude_production") block.repetitions = 1;
  return block;
}

TrialForm form_of(std::string_view procedure) {
  return procedure_named(procedure).form(block_for(procedure));
}

std::vector<PlannedTrial> drawn(const Block& block, std::uint64_t seed) {
  core::RandomStream stream(seed, "order");
  return procedure_named(block.procedure).draw_next(block, {}, stream);
}

double shown(const PlannedTrial& trial) {
  return trial.intensity.value_or(trial.starting_intensity.value_or(-1.0));
}

class EveryProcedure : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryProcedure, ShowsEveryIntensityOnceInEachRepetition) {
  const Block block = block_for(GetParam());
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const std::vector<PlannedTrial> trials = drawn(block, seed);
    ASSERT_EQ(trials.size(), 15U);
    EXPECT_EQ(procedure_named(block.procedure).expected_trials(block), 15);
    for (int repetition = 1; repetition <= 3; ++repetition) {
      std::multiset<double> intensities;
      for (int position = 1; position <= 5; ++position) {
        const PlannedTrial& trial =
            trials[static_cast<std::size_t>(5 * repetition + position) - 6];
        EXPECT_EQ(trial.repetition, repetition);
        EXPECT_EQ(trial.position, position);
        intensities.insert(shown(trial));
      }
      EXPECT_EQ(intensities,
                std::multiset<double>(block.intensities.begin(), block.intensities.end()));
    }
  }
}

TEST_P(EveryProcedure, OrdersDifferBetweenSeedsAndRepetitionsAndRepeatWithTheSeed) {
  const Block block = block_for(GetParam());
  std::set<std::vector<double>> orders;
  std::set<std::vector<double>> first_repetitions;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::vector<double> order;
    for (const PlannedTrial& trial : drawn(block, seed)) order.push_back(shown(trial));
    std::vector<double> again;
    for (const PlannedTrial& trial : drawn(block, seed)) again.push_back(shown(trial));
    EXPECT_EQ(order, again);
    orders.insert(order);
    first_repetitions.insert({order.begin(), order.begin() + 5});
    EXPECT_FALSE(std::equal(order.begin(), order.begin() + 5, order.begin() + 5) &&
                 std::equal(order.begin(), order.begin() + 5, order.begin() + 10));
  }
  EXPECT_EQ(orders.size(), 40U);
  EXPECT_GT(first_repetitions.size(), 25U) << "of 120 orders";
}

TEST_P(EveryProcedure, IsFinishedOnceEverythingDrawnIsAnswered) {
  const Block block = block_for(GetParam());
  std::vector<AnsweredTrial> answered;
  for (const PlannedTrial& trial : drawn(block, 1)) answered.push_back({trial, 1.0});
  core::RandomStream stream(1, "order");
  EXPECT_TRUE(procedure_named(block.procedure).draw_next(block, answered, stream).empty());
}

INSTANTIATE_TEST_SUITE_P(All, EveryProcedure,
                         ::testing::Values("magnitude_estimation", "magnitude_production",
                                           "constant_stimuli"),
                         [](const auto& one) { return std::string(one.param); });

TEST(MagnitudeProduction, TakesTheTargetsInTheOrderOfTheStudy) {
  std::vector<double> targets;
  for (const PlannedTrial& trial : drawn(block_for("magnitude_production"), 7)) {
    ASSERT_TRUE(trial.target_percent);
    EXPECT_FALSE(trial.intensity) << "the participant sets it";
    targets.push_back(*trial.target_percent);
  }
  EXPECT_EQ(targets, (std::vector<double>{200, 200, 200, 200, 200, 50, 50, 50, 50, 50, 100, 100,
                                          100, 100, 100}));
}

TEST(ConstantStimuli, ComparesWithTheReferenceOrAsksAboutTheTestAlone) {
  Block block = block_for("constant_stimuli");
  for (const PlannedTrial& trial : drawn(block, 7)) EXPECT_EQ(trial.reference_intensity, 1.0);
  EXPECT_TRUE(procedure_named("constant_stimuli").form(block).has_reference);
  block.reference_intensity.reset();
  EXPECT_FALSE(procedure_named("constant_stimuli").form(block).has_reference);
  for (const PlannedTrial& trial : drawn(block, 7)) EXPECT_FALSE(trial.reference_intensity);
}

TEST(TrialForms, SayWhatTheExperimenterCanDo) {
  EXPECT_EQ(form_of("magnitude_estimation").answer, AnswerKind::kPercent);
  EXPECT_EQ(form_of("magnitude_production").answer, AnswerKind::kMatch);
  EXPECT_TRUE(form_of("magnitude_production").adjustable);
  EXPECT_FALSE(form_of("magnitude_estimation").adjustable);
  EXPECT_EQ(form_of("constant_stimuli").answer, AnswerKind::kYesNo);
  EXPECT_TRUE(form_of("constant_stimuli").has_reference);
}

TEST(ProcedureRegistry, KnowsEveryProcedureByItsNameAndTellsThemToWhoAsksForAnother) {
  std::set<std::string_view> names;
  for (const Procedure* procedure : procedures()) {
    names.insert(procedure->name());
    EXPECT_EQ(&procedure_named(procedure->name()), procedure);
  }
  EXPECT_EQ(names.size(), procedures().size());
  try {
    (void)procedure_named("guessing");
    FAIL() << "expected an error";
  } catch (const core::Error& error) {
    const std::string message = error.what();
    for (const std::string_view name : names) {
      EXPECT_NE(message.find(name), std::string::npos) << message;
    }
    EXPECT_NE(message.find("guessing"), std::string::npos) << message;
  }
}

}  // namespace procedure_test
}  // namespace jnd::experiments
