#include "analysis/results/threshold_results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/fits/same_different_fit.h"
#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "experiments/procedures/procedure_registry.h"

namespace jnd::analysis {
namespace threshold_results_test {

const ResultsOptions kQuick = {.num_resamples = 200, .seed = 1};

const char* const kProtocol = R"json({"name": "by_hand", "stages": [
  {"kind": "block", "name": "felt", "procedure": "constant_stimuli", "task": "yes_no"},
  {"kind": "counterbalance", "name": "order", "arms": [{"name": "a", "stages": [
    {"kind": "block", "name": "pairs", "procedure": "constant_stimuli", "task": "same_different"}]}]}]})json";

/// Answers at one level, and how many of them were "yes".
struct Level {
  double intensity;
  int num_yes, num_trials;
};

void add(HandMadeStudy& study, core::TrialRow row, const std::vector<Level>& levels) {
  row.procedure = "constant_stimuli";
  row.quantity = "viscosity_pa_s";
  row.repetition = 1;
  for (const Level& level : levels) {
    for (int i = 0; i < level.num_trials; ++i) {
      row.intensity = level.intensity;
      row.response = i < level.num_yes ? 1.0 : 0.0;
      (void)study.answer(row);
    }
  }
}

void felt(HandMadeStudy& study, const std::vector<Level>& levels, bool is_catch = false) {
  add(study, {.block = "felt", .is_catch = is_catch}, levels);
}

void pairs(HandMadeStudy& study, const std::vector<Level>& levels) {
  add(study, {.block = "pairs", .reference_intensity = 8.0}, levels);
}

/// The answers are symmetric about a threshold in ln: 2, 5 and 8 of 10 at half of it, at it,
/// and at its double.
std::vector<Level> about(double threshold) {
  return {{0.5 * threshold, 2, 10}, {threshold, 5, 10}, {2.0 * threshold, 8, 10}};
}

TEST(DetectionResults, AThresholdIsWhereHalfOfTheStimuliAreFelt) {
  HandMadeStudy study(kProtocol);
  study.add("P01");
  felt(study, about(0.2));
  study.add("P02");
  felt(study, about(0.8));
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const ResultsSection& of = section_of(results, "felt");
  EXPECT_NEAR(*own_of(of, "P01", "felt.threshold").value, 0.2, 1e-9);
  EXPECT_NEAR(*own_of(of, "P02", "felt.threshold").value, 0.8, 1e-9);
  EXPECT_LT(*own_of(of, "P01", "felt.threshold").ci95.low, 0.2);
  // Phi(ln 2 / s) = 0.8, so s = 0.8236.
  EXPECT_NEAR(*own_of(of, "P01", "felt.spread_ln").value, std::log(2.0) / 0.8416212, 1e-6);
  EXPECT_NEAR(value_of(results, "felt.threshold"), 0.4, 1e-9) << "geometric mean";
  EXPECT_NEAR(value_of(results, "felt.threshold_sd_ln"), std::log(4.0) / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(results.find("felt.threshold")->unit, "Pa s");
  EXPECT_EQ(results.find("felt.threshold")->n, 2);
  EXPECT_EQ(results.find("felt.d_prime"), nullptr) << "nobody had catch trials";
  EXPECT_EQ(results.find("felt.weber_fraction"), nullptr) << "there is no reference";
}

TEST(DetectionResults, AMeanRateStaysBetween0And1) {
  HandMadeStudy study(kProtocol);
  for (const int num_false : {0, 6}) {
    study.add(num_false == 0 ? "P01" : "P02");
    felt(study, about(0.2));
    felt(study, {{0.0, num_false, 20}}, /*is_catch=*/true);
  }
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const Estimate* rate = results.find("felt.false_alarm_rate");
  ASSERT_NE(rate, nullptr);
  EXPECT_NEAR(*rate->value, 0.15, 1e-12);
  // Student's interval would extend by 12.7 times 0.15 on both sides.
  EXPECT_EQ(rate->ci95.low, 0.0);
  EXPECT_EQ(rate->ci95.high, 1.0);
}

TEST(DetectionResults, FalseAlarmsAreToldAndCorrectedFor) {
  HandMadeStudy study(kProtocol);
  study.add("P01");
  felt(study, about(0.2));
  felt(study, {{0.0, 3, 20}}, /*is_catch=*/true);
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const ResultsSection& of = section_of(results, "felt");
  EXPECT_NEAR(*own_of(of, "P01", "felt.threshold").value, 0.2, 1e-9)
      << "without regard to catch trials";
  EXPECT_GT(*own_of(of, "P01", "felt.threshold_corrected").value, 0.21);
  EXPECT_NEAR(*own_of(of, "P01", "felt.false_alarm_rate").value, 0.15, 1e-12);
  // There are 15 of 30 hits and 3 of 20 false alarms: z(15.5 / 31) = 0, z(3.5 / 21) = -0.96742.
  EXPECT_NEAR(*own_of(of, "P01", "felt.d_prime").value, 0.9674216, 1e-6);
  EXPECT_NEAR(*own_of(of, "P01", "felt.criterion").value, 0.5 * 0.9674216, 1e-6);
}

TEST(DetectionResults, WhoHasNoThresholdIsNamedAndComesInAgainWithHalfAnAnswer) {
  HandMadeStudy study(kProtocol);
  study.add("P01");
  felt(study, about(0.2));
  study.add("P02");
  felt(study, {{0.1, 0, 10}, {0.2, 0, 10}, {0.4, 10, 10}});
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const ResultsSection& of = section_of(results, "felt");
  EXPECT_FALSE(own_of(of, "P02", "felt.threshold").value.has_value());
  EXPECT_NE(own_of(of, "P02", "felt.threshold").reason, "");
  EXPECT_EQ(results.find("felt.threshold")->n, 1);
  EXPECT_EQ(results.find("felt.threshold.with_degenerate")->n, 2);
  EXPECT_TRUE(std::ranges::any_of(of.excluded, [](const ExcludedParticipant& one) {
    return one.participant == "P02" && one.reason.starts_with("felt: no threshold");
  }));
}

TEST(DetectionResults, TrialsSetAsideAreShownBesides) {
  HandMadeStudy study(kProtocol);
  study.add("P01");
  felt(study, about(0.2));
  study.exclude(1);
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  EXPECT_NE(value_of(results, "felt.threshold"),
            value_of(results, "felt.threshold.with_excluded_trials"));
  EXPECT_NEAR(value_of(results, "felt.threshold.with_excluded_trials"), 0.2, 1e-9);
}

TEST(SameDifferentResults, AreThoseOfTheDifferencingModel) {
  HandMadeStudy study(kProtocol);
  study.add("P01");
  pairs(study, {{8.0, 4, 20}, {10.0, 9, 20}, {16.0, 18, 20}});
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const ResultsSection& of = section_of(results, "pairs");
  const SameDifferentFit fit =
      fit_same_different({{8.0, 4, 20}, {10.0, 9, 20}, {16.0, 18, 20}}, 8.0);
  EXPECT_EQ(own_of(of, "P01", "pairs.weber_fraction").value, fit.weber_fraction);
  EXPECT_EQ(own_of(of, "P01", "pairs.criterion_ln").value, fit.criterion_ln);
  EXPECT_NEAR(*own_of(of, "P01", "pairs.false_alarm_rate").value, 0.2, 1e-12);
  EXPECT_NEAR(value_of(results, "pairs.weber_fraction"), *fit.weber_fraction, 1e-12);
  EXPECT_EQ(results.find("pairs.weber_fraction_free_pse"), nullptr)
      << "no psychometric function over \"more\"";
}

AdaptiveRun staircase_run(const std::string& participant, double threshold) {
  AdaptiveRun run{.participant = participant, .block = "stairs", .procedure = "staircase"};
  run.is_logarithmic = true;
  run.rule = "1 up, 2 down; Levitt 1971";
  run.target_probability = std::sqrt(0.5);
  run.tracks = {{.series = 1, .points = {}, .threshold = threshold, .num_reversals = 6}};
  run.threshold = threshold;
  return run;
}

StudyData adaptive_study(const std::string& procedure) {
  StudyData data{.study = "by_hand"};
  data.blocks.push_back({.block = "stairs",
                         .procedure = procedure,
                         .quantity = "viscosity_pa_s",
                         .reference_intensity = 8.0,
                         .rule = experiments::procedure_named(procedure).rule()});
  return data;
}

TEST(AdaptiveResults, AStaircaseHasAThresholdAndAWeberFractionOfTheOneDefinition) {
  StudyData data = adaptive_study("staircase");
  // On the curve with w = 0.25 and the pse at 8, the level of 70.71 % is 8 * 1.25^0.5449.
  const double level = 8.0 * std::pow(1.25, 0.5449521);
  data.runs = {staircase_run("P01", level), staircase_run("P02", 7.5)};
  const ResultsSection of = adaptive_results(data, data.blocks.front());
  EXPECT_EQ(of.name, "stairs_staircase");
  EXPECT_NEAR(*own_of(of, "P01", "stairs.staircase_weber_fraction").value, 0.25, 1e-6);
  EXPECT_FALSE(own_of(of, "P02", "stairs.staircase_weber_fraction").value.has_value());
  EXPECT_NE(own_of(of, "P02", "stairs.staircase_weber_fraction").reason, "");
  const auto named = [&](const std::string& name) {
    return *std::ranges::find(of.estimates, name, &Estimate::name);
  };
  EXPECT_NEAR(*named("stairs.staircase_threshold").value, std::sqrt(level * 7.5), 1e-9);
  EXPECT_NE(named("stairs.staircase_threshold").meaning.find("70.7 % (1 up, 2 down; Levitt"),
            std::string::npos);
  EXPECT_NEAR(*named("stairs.staircase_weber_fraction").value, 0.25, 1e-6);
  EXPECT_EQ(named("stairs.staircase_weber_fraction").n, 1);
}

TEST(AdaptiveResults, AStaircaseAboutFiftyPercentHasNoWeberFraction) {
  StudyData data = adaptive_study("staircase");
  data.runs = {staircase_run("P01", 9.0)};
  data.runs.front().target_probability = 0.5;
  const ResultsSection of = adaptive_results(data, data.blocks.front());
  EXPECT_NE(own_of(of, "P01", "stairs.staircase_weber_fraction").reason.find("50 %"),
            std::string::npos);
}

TEST(AdaptiveResults, LimitsTellHabituationFromExpectation) {
  StudyData data = adaptive_study("limits");
  for (const auto& [name, error] : {std::pair{"P01", 0.2}, {"P02", 0.1}, {"P03", -0.06}}) {
    AdaptiveRun run{.participant = name, .block = "stairs", .procedure = "limits"};
    run.is_logarithmic = true;
    run.threshold = 8.0;
    run.limits = {8.0 * std::exp(0.5 * error), 8.0 * std::exp(-0.5 * error), error, 4, 4};
    data.runs.push_back(run);
  }
  const ResultsSection of = adaptive_results(data, data.blocks.front());
  EXPECT_NEAR(*own_of(of, "P02", "stairs.limits_constant_error").value, 0.1, 1e-12);
  ASSERT_EQ(of.comparisons.size(), 1U);
  EXPECT_NEAR(*of.comparisons.front().comparison.estimate, 0.08, 1e-12);
}

TEST(AdaptiveResults, ARunWithoutAnEstimateIsNamed) {
  StudyData data = adaptive_study("quest_plus");
  AdaptiveRun found{.participant = "P01", .block = "stairs", .procedure = "quest_plus"};
  found.posterior = {{"weber_fraction", 0.3, 0.1, 0.2, 0.5}, {"pse", 8.2, 0.1, 7.0, 9.0}};
  const AdaptiveRun empty{.participant = "P02", .block = "stairs", .problem = "no answers"};
  data.runs = {found, empty};
  const ResultsSection of = adaptive_results(data, data.blocks.front());
  EXPECT_EQ(*own_of(of, "P01", "stairs.quest_plus_weber_fraction").value, 0.3);
  EXPECT_EQ(*own_of(of, "P01", "stairs.quest_plus_weber_fraction").ci95.high, 0.5);
  ASSERT_EQ(of.excluded.size(), 1U);
  EXPECT_EQ(of.excluded.front().reason, "stairs: no answers");
}

TEST(AdaptiveResults, APosteriorAtTheEndOfItsGridSaysSoBesideEveryNumberOfIt) {
  StudyData data = adaptive_study("quest_plus");
  const auto run = [](const char* name, const std::vector<std::string>& reached) {
    AdaptiveRun one{.participant = name, .block = "stairs", .procedure = "quest_plus"};
    one.posterior = {{"pse", 12.0, 0.1, 11.0, 14.0}, {"weber_fraction", 0.1, 0.2, 0.08, 0.2}};
    one.reached_ends = reached;
    if (reached.empty()) return one;
    for (PosteriorEstimate& parameter : one.posterior) parameter.low = parameter.high = {};
    return one;
  };
  data.runs = {run("P01", {}), run("P02", {}), run("P03", {})};
  const ResultsSection sound = adaptive_results(data, data.blocks.front());
  for (const Estimate& estimate : sound.estimates) EXPECT_TRUE(estimate.cautions.empty());
  EXPECT_TRUE(std::ranges::find(sound.estimates, "stairs.quest_plus_pse", &Estimate::name)
                  ->ci95.low.has_value());

  for (int i = 4; i <= 10; ++i) data.runs.push_back(run(("P" + std::to_string(i)).c_str(), {}));
  data.runs.push_back(run("P11", {"the lower end of `pse_viscosity_pa_s` (12)"}));
  const ResultsSection one_of_eleven = adaptive_results(data, data.blocks.front());
  for (const Estimate& estimate : one_of_eleven.estimates) {
    EXPECT_TRUE(estimate.cautions.empty()) << "P11 says so";
  }
  data.runs.resize(3);
  data.runs.back() = run("P03", {"the lower end of `pse_viscosity_pa_s` (12)"});
  const ResultsSection of = adaptive_results(data, data.blocks.front());
  EXPECT_TRUE(own_of(of, "P01", "stairs.quest_plus_weber_fraction").cautions.empty());
  EXPECT_TRUE(own_of(of, "P01", "stairs.quest_plus_weber_fraction").ci95.low.has_value());
  for (const char* name : {"stairs.quest_plus_pse", "stairs.quest_plus_weber_fraction"}) {
    const ParticipantEstimate& one = own_of(of, "P03", name);
    EXPECT_TRUE(one.value.has_value()) << name;
    EXPECT_FALSE(one.ci95.low || one.ci95.high) << name;
    EXPECT_NE(one.cautions.at(0).find("reaches the lower end of `pse_viscosity_pa_s` (12)"),
              std::string::npos)
        << one.cautions.at(0);
    const Estimate& group = *std::ranges::find(of.estimates, name, &Estimate::name);
    EXPECT_TRUE(group.value.has_value()) << name;
    EXPECT_FALSE(group.ci95.low || group.ci95.high) << name;
    EXPECT_NE(group.cautions.at(0).find("of 1 of 3 participants"), std::string::npos)
        << group.cautions.at(0);
    EXPECT_NE(group.cautions.at(0).find("stairs.weber_fraction_median_person"),
              std::string::npos);
  }
}

TEST(IntervalResults, AnOrderEffectMovesThePseAndNotTheSlope) {
  HandMadeStudy study;
  study.add("P01");
  // The test is chosen equally often one step later if it comes second.
  for (const auto& [interval, levels] :
       {std::pair{1, std::vector<Level>{{4.0, 2, 10}, {8.0, 5, 10}, {16.0, 8, 10}}},
        {2, std::vector<Level>{{8.0, 2, 10}, {16.0, 5, 10}, {32.0, 8, 10}}}}) {
    add(study, {.block = "order", .reference_intensity = 8.0, .test_interval = interval},
        levels);
  }
  const StudyResults results = results_of(load_study(study.store()), {}, kQuick);
  const ResultsSection& of = section_of(results, "order_intervals");
  EXPECT_NEAR(*own_of(of, "P01", "order.order_effect_ln").value, std::log(2.0), 1e-6);
  EXPECT_NEAR(*own_of(of, "P01", "order.interval_bias").value, 0.0, 1e-12)
      << "half of all answers, at levels that differ";
}

}  // namespace threshold_results_test
}  // namespace jnd::analysis
