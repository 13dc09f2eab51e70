#include "app/planning/plan_statistics.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/session/pseudonym.h"
#include "app/session/shipped_files.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace plan_statistics_test {

using experiments::Study;

/// Returns a study with a staircase and an estimation. How long the staircase takes depends on
/// the person.
Study study_with(const std::string& stairs) {
  return experiments::read_study_text(R"json({
  "format": 1, "name": "adaptive", "languages": ["en"], "title": {"en": "A"}, "authors": ["A"],
  "stages": [
    {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation",
     "medium": "viscous", "viscosity_pa_s": [2, 8], "repetitions": 2,
     "instruction": {"en": "Say."}, "question": {"en": "How?"}, "expected_trial_s": 30},
    {"kind": "block", "name": "stairs", "procedure": "staircase", "medium": "viscous",)json" +
                                          stairs + R"json(
     "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
     "free_space_between_s": 2, "expected_trial_s": 33}]})json",
                                      "x");
}

const std::string kStairs = R"json(
     "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16], "lowest_viscosity_pa_s": 1,
     "highest_viscosity_pa_s": 30, "step_ratio": [1.5, 1.25, 1.1], "max_reversals": 6,)json";

PlanStatistics statistics_of(const Study& study, int num_participants) {
  const experiments::Laboratory laboratory =
      experiments::read_laboratory(user_or_shipped("thesis", "data/laboratories"));
  return plan_statistics(
      study,
      plan_participants(study,
                        {.participants = next_participants({}, num_participants), .seed = 4}),
      laboratory, 4);
}

TEST(PlanStatistics, SpreadIsWorkedByHand) {
  const Spread spread = spread_of({2.0, 4.0, 9.0});
  EXPECT_DOUBLE_EQ(spread.mean, 5.0);
  EXPECT_DOUBLE_EQ(spread.standard_deviation, std::sqrt((9.0 + 1.0 + 16.0) / 2.0));
  EXPECT_DOUBLE_EQ(spread.least, 2.0);
  EXPECT_DOUBLE_EQ(spread.most, 9.0);
  EXPECT_DOUBLE_EQ(spread_of({7.0}).standard_deviation, 0.0);
  EXPECT_DOUBLE_EQ(spread_of({}).mean, 0.0);
  const Spread alike = spread_of(std::vector<double>(30, 50.0));
  EXPECT_EQ(alike.mean, 50.0);
  EXPECT_EQ(alike.standard_deviation, 0.0);
}

TEST(PlanStatistics, AdaptiveBlocksTakeAsLongAsSimulatedParticipantsNeed) {
  const Study study = study_with(kStairs);
  const PlanStatistics statistics = statistics_of(study, 12);
  EXPECT_TRUE(statistics.adapts);
  EXPECT_EQ(statistics.not_simulated, "");
  ASSERT_EQ(statistics.num_trials.size(), 1u);
  const Spread& trials = statistics.num_trials.at("stairs");
  EXPECT_GE(trials.least, 6.0) << "a reversal takes a trial";
  EXPECT_GT(trials.most, trials.least) << "people differ";
  const Spread durations = spread_of(statistics.durations_s);
  // There are four estimations of 30 s, and each trial of the staircase takes 35 s.
  EXPECT_DOUBLE_EQ(durations.least, 120.0 + 35.0 * trials.least);
  EXPECT_DOUBLE_EQ(durations.most, 120.0 + 35.0 * trials.most);
  ASSERT_EQ(statistics.orders.size(), 1u);
  EXPECT_EQ(statistics.orders[0].block, "estimation");
  nlohmann::ordered_json json;
  add_to_json(statistics, json);
  EXPECT_EQ(json["durations"]["of_participants_s"].size(), 12u);
  EXPECT_EQ(json["durations"]["adaptive_blocks"][0]["block"], "stairs");
  EXPECT_EQ(json["order_statistics"][0]["stimuli"], (std::vector<double>{2.0, 8.0}));
}

TEST(PlanStatistics, LevelsThatEndTooEarlyAreSeenByWhereTrialsPileUp) {
  const LevelEnds wide = statistics_of(study_with(kStairs), 12).level_ends.at("stairs");
  EXPECT_EQ(wide.lowest_ratio, 0.0);
  EXPECT_LT(wide.highest_ratio, 0.1);
  // For everybody, one and a half times the reference is thicker.
  const Study narrow = study_with(R"json(
     "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [20], "num_down": 2,
     "lowest_viscosity_pa_s": 14, "highest_viscosity_pa_s": 30,
     "step_ratio": [1.5, 1.25, 1.1], "max_reversals": 20, "max_trials": 40,)json");
  const PlanStatistics statistics = statistics_of(narrow, 12);
  EXPECT_GT(statistics.level_ends.at("stairs").lowest_ratio, 0.4);
  testing::internal::CaptureStdout();
  print(statistics);
  std::fflush(stdout);
  const std::string told = testing::internal::GetCapturedStdout();
  EXPECT_NE(told.find("of its trials are at its lowest level"), std::string::npos) << told;
}

TEST(PlanStatistics, ABlockTakesNoLessThanItsStimuliAreFelt) {
  Study study = study_with(kStairs);
  const PlanStatistics patient = statistics_of(study, 3);
  EXPECT_FALSE(patient.trial_lengths.at("estimation").is_underrated());
  auto& estimation = std::get<experiments::Block>(study.stages.front().content);
  // This is as if a person could stroke and answer within a second.
  estimation.expected_trial_s = 1.0;
  const PlanStatistics hasty = statistics_of(study, 3);
  const TrialLength& length = hasty.trial_lengths.at("estimation");
  EXPECT_TRUE(length.is_underrated());
  EXPECT_DOUBLE_EQ(length.felt_s.mean, patient.trial_lengths.at("estimation").felt_s.mean);
  // Each of the four trials takes 30 s in the one plan, and the time for which it is felt in
  // the other.
  EXPECT_NEAR(spread_of(hasty.durations_s).mean,
              spread_of(patient.durations_s).mean - 4.0 * (30.0 - length.felt_s.mean), 1e-9);
}

}  // namespace plan_statistics_test
}  // namespace jnd::app
