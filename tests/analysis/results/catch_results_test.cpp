#include "analysis/results/catch_results.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/hand_made_study.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace catch_results_test {

/// Adds answers of one participant to trials of a block whose reference is 8 Pa s.
void answer(HandMadeStudy& study, core::TrialRow row, int num_yes, int num_trials) {
  row.procedure = "constant_stimuli";
  row.quantity = "viscosity_pa_s";
  row.repetition = 1;
  row.reference_intensity = 8.0;
  for (int i = 0; i < num_trials; ++i) {
    row.response = i < num_yes ? 1.0 : 0.0;
    (void)study.answer(row);
  }
}

void levels(HandMadeStudy& study, const std::string& block,
            std::optional<std::int64_t> test_interval = {}) {
  for (const auto& [level, num_yes] : {std::pair{4.0, 2}, {8.5, 5}, {16.0, 8}}) {
    answer(study, {.block = block, .intensity = level, .test_interval = test_interval}, num_yes,
           10);
  }
}

void catches(HandMadeStudy& study, const std::string& block, int num_yes, int num_trials,
             std::optional<std::int64_t> test_interval = {}) {
  answer(study,
         {.block = block, .intensity = 8.0, .test_interval = test_interval, .is_catch = true},
         num_yes, num_trials);
}

const ResultsSection* section(const StudyResults& results, const std::string& name) {
  const auto found = std::ranges::find(results.sections, name, &ResultsSection::name);
  return found == results.sections.end() ? nullptr : &*found;
}

std::optional<double> own(const ResultsSection& of, const std::string& participant,
                          const std::string& name) {
  for (const ParticipantEstimate& one : of.participants) {
    if (one.participant == participant && one.name == name) return one.value;
  }
  return std::nullopt;
}

const ResultsOptions kQuick = {.num_resamples = 50};

TEST(CatchResults, FalseAlarmsOfAReminderAreCountedForEverybodyAndTheGroup) {
  HandMadeStudy study;
  study.add("P01");
  levels(study, "honey");
  catches(study, "honey", 1, 4);
  study.add("P02");
  levels(study, "honey");
  catches(study, "honey", 5, 6);
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const ResultsSection* const of = section(results, "honey_catch_trials");
  ASSERT_NE(of, nullptr);
  EXPECT_EQ(own(*of, "P01", "honey.num_catch_trials"), 4.0);
  EXPECT_EQ(own(*of, "P01", "honey.num_false_alarms"), 1.0);
  EXPECT_EQ(own(*of, "P02", "honey.false_alarm_rate"), 5.0 / 6.0);
  EXPECT_EQ(results.find("honey.num_catch_trials")->value, 10.0);
  EXPECT_EQ(results.find("honey.num_catch_trials")->n, 2);
  EXPECT_EQ(results.find("honey.num_false_alarms")->value, 6.0);
  EXPECT_NEAR(*results.find("honey.false_alarm_rate")->value, 0.5 * (0.25 + 5.0 / 6.0), 1e-12);
  EXPECT_EQ(of->participants[2].name, "honey.false_alarm_rate");
  // The interval is that of Wilson (1927) for 1 of 4.
  EXPECT_NEAR(*of->participants[2].ci95.low, 0.0456, 1e-4);
  EXPECT_NEAR(*of->participants[2].ci95.high, 0.6994, 1e-4);
}

TEST(CatchResults, OfTwoIntervalsTheyTellABiasAndWhetherSomethingElseGivesTheTestAway) {
  HandMadeStudy study;
  study.add("P01");
  levels(study, "pairs", 1);
  levels(study, "pairs", 2);
  // The test came first, and the second interval is chosen in 3 of 4.
  catches(study, "pairs", 1, 4, 1);
  catches(study, "pairs", 2, 4, 2);  // The test came second, and it is chosen in 2 of 4.
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const ResultsSection* const of = section(results, "pairs_catch_trials");
  ASSERT_NE(of, nullptr);
  EXPECT_EQ(own(*of, "P01", "pairs.num_catch_trials"), 8.0);
  EXPECT_EQ(own(*of, "P01", "pairs.catch_test_chosen_rate"), 3.0 / 8.0);
  EXPECT_EQ(own(*of, "P01", "pairs.catch_second_chosen_rate"), 5.0 / 8.0);
  EXPECT_EQ(own(*of, "P01", "pairs.num_false_alarms"), std::nullopt) << "neither is false";
  EXPECT_EQ(results.find("pairs.false_alarm_rate"), nullptr);
}

TEST(CatchResults, TheyMoveNoCurveAndAreAbsentWhereThereAreNone) {
  HandMadeStudy with, without;
  for (HandMadeStudy* study : {&with, &without}) {
    study->add("P01");
    levels(*study, "honey");
  }
  catches(with, "honey", 4, 4);
  const StudyResults a = results_of(load_study(with.store()), {}, kQuick);
  const StudyResults b = results_of(load_study(without.store()), {}, kQuick);
  EXPECT_EQ(a.find("honey.weber_fraction_ml")->value, b.find("honey.weber_fraction_ml")->value);
  EXPECT_EQ(section(b, "honey_catch_trials"), nullptr);
}

}  // namespace catch_results_test
}  // namespace jnd::analysis
