#include "analysis/results/exploratory_results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/results/test_families.h"

namespace jnd::analysis {
namespace exploratory_results_test {

/// Returns the section as results_of makes it, with the adjustment.
ResultsSection adjusted(const StudyData& data, const std::vector<ResultsSection>& sections) {
  std::vector<ResultsSection> all = {exploratory_results(data, sections)};
  adjust_by_family(all);
  return all.front();
}

const BlockDesign kEstimation = {.block = "estimation",
                                 .procedure = "magnitude_estimation",
                                 .quantity = "scale",
                                 .num_trials = 9,
                                 .measures = Measure::kMagnitude};
const BlockDesign kProduction = {.block = "production",
                                 .procedure = "magnitude_production",
                                 .quantity = "scale",
                                 .num_trials = 9,
                                 .measures = Measure::kProducedMagnitude};

double own(const ResultsSection& section, const std::string& participant,
           const std::string& name) {
  for (const ParticipantEstimate& one : section.participants) {
    if (one.participant == participant && one.name == name) return one.value.value_or(NAN);
  }
  return NAN;
}

const NamedComparison& comparison(const ResultsSection& section, const std::string& name) {
  for (const NamedComparison& named : section.comparisons) {
    if (named.name == name) return named;
  }
  throw core::Error("no comparison " + name);
}

/// Returns a person who sets twice the target. `weight` says how strongly each start draws the
/// setting.
ParticipantData anchored(const std::string& name, double weight) {
  ParticipantData person{.participant = name};
  std::int64_t trial = 0;
  for (const double target : {50.0, 100.0, 200.0}) {
    for (const double start : {4.0, 0.0, 2.0}) {
      // High targets come from high starts alone. A difference between targets must not count
      // as an anchor.
      if (target == 200.0 && start == 0.0) continue;
      const double matched = 0.02 * target;
      const double set = matched + weight * (start - matched);
      person.trials.push_back({.trial = ++trial,
                               .block = "production",
                               .intensity = set,
                               .starting_intensity = start,
                               .target_percent = target,
                               .response = set});
    }
  }
  return person;
}

TEST(ExploratoryResults, TheStartingValueSlopeIsTheWeightOfTheAnchor) {
  StudyData data{.participants = {anchored("P01", 0.25), anchored("P02", 0.0)},
                 .blocks = {kProduction}};
  const ResultsSection section = exploratory_results(data, {});
  EXPECT_NEAR(own(section, "P01", "production.starting_value_slope"), 0.25, 1e-12);
  EXPECT_NEAR(own(section, "P02", "production.starting_value_slope"), 0.0, 1e-12);
  const auto mean =
      std::ranges::find(section.estimates, "production.starting_value_slope", &Estimate::name);
  ASSERT_NE(mean, section.estimates.end());
  EXPECT_NEAR(mean->value.value(), 0.125, 1e-12);
  EXPECT_EQ(mean->meaning.find("exploratory: "), 0U);
}

TEST(ExploratoryResults, ADriftIsSeenWhateverTheOrderOfTheStimuli) {
  // The answers rise with each trial by 10 % of the first one.
  ParticipantData person{.participant = "P01"};
  std::int64_t trial = 0;
  for (const double intensity : {1.0, 3.0, 2.0, 3.0, 2.0, 1.0, 0.0, 0.0}) {
    const double drift = 1.0 + 0.1 * static_cast<double>(trial);
    person.trials.push_back({.trial = ++trial,
                             .block = "estimation",
                             .intensity = intensity,
                             .response = 100.0 * intensity * drift});
  }
  const StudyData data{.participants = {person}, .blocks = {kEstimation}};
  const ResultsSection section = exploratory_results(data, {});
  // Stimulus 1 comes at trials 1 and 6, 2 at 3 and 5, and 3 at 2 and 4, with means of 1.25, 1.3
  // and 1.2. The slopes are 0.1 over these, weighted by the squared distances within, 12.5, 2
  // and 2.
  const double by_hand = (12.5 * (0.1 / 1.25) + 2.0 * (0.1 / 1.3) + 2.0 * (0.1 / 1.2)) / 16.5;
  EXPECT_NEAR(own(section, "P01", "estimation.drift_per_ten_trials"), 10.0 * by_hand, 1e-12);
}

TEST(ExploratoryResults, AnAnswerLeansOnTheStimulusBeforeItWithinABlockOnly) {
  ParticipantData person{.participant = "P01"};
  const std::vector<double> stimuli = {2.0, 1.0, 2.0, 4.0, 2.0, 1.0, 4.0, 1.0};
  for (std::size_t i = 0; i < stimuli.size(); ++i) {
    // The trials are 1 to 4 and, after another block, 15 to 18.
    const auto trial = static_cast<std::int64_t>(i < 4 ? i + 1 : i + 11);
    const double before = i % 4 == 0 ? 77.0 : stimuli[i - 1];
    person.trials.push_back({.trial = trial,
                             .block = "estimation",
                             .intensity = stimuli[i],
                             .response = stimuli[i] * (100.0 + 5.0 * before)});
  }
  const StudyData data{.participants = {person}, .blocks = {kEstimation}};
  const double found =
      own(exploratory_results(data, {}), "P01", "estimation.previous_stimulus_slope");
  // 1 comes after 2, 2, 4; 2 after 1; 4 after 2, 1. The slopes are relative to the means over
  // all answers to each stimulus: of 1 over 110, 110, 120, and of 4 over 110, 105.
  const double mean_of_1 = (110.0 + 110.0 + 120.0) / 3.0, mean_of_4 = (110.0 + 105.0) / 2.0;
  const double squares_1 = 8.0 / 3.0, squares_4 = 0.5;
  const double by_hand =
      (squares_1 * 5.0 / mean_of_1 + squares_4 * 5.0 / mean_of_4) / (squares_1 + squares_4);
  EXPECT_NEAR(found, by_hand, 1e-12);
}

TEST(ExploratoryResults, ArmsOfACounterbalanceAreComparedByTheParticipantsOwnParameters) {
  StudyData data{.blocks = {kEstimation}};
  ResultsSection fits{.name = "estimation"};
  const std::vector<std::pair<std::string, double>> people = {
      {"priming=primed;method_order=a,b", 0.5},
      {"priming=unprimed;method_order=a,b", 0.9},
      {"priming=primed;method_order=b,a", 0.6},
      {"priming=unprimed;method_order=b,a", 0.7}};
  for (std::size_t i = 0; i < people.size(); ++i) {
    const std::string name = "P0" + std::to_string(i + 1);
    data.participants.push_back({.participant = name, .cells = people[i].first});
    fits.participants.push_back({name, "estimation.a", people[i].second, {}, ""});
    fits.participants.push_back({name, "estimation.k", std::exp(people[i].second), {}, ""});
  }
  const ResultsSection section = adjusted(data, {fits});
  const NamedComparison& primed =
      comparison(section, "priming: primed - unprimed: a of estimation, t");
  EXPECT_NEAR(primed.comparison.estimate.value(), 0.55 - 0.8, 1e-12);
  EXPECT_EQ(primed.comparison.kind, Comparison::Kind::kWelch);
  EXPECT_NEAR(comparison(section, "method_order: a,b - b,a: ln k of estimation, t")
                  .comparison.estimate.value(),
              0.7 - 0.65, 1e-12);
  // Four t tests are the family. The four rank tests beside them do not belong to it.
  EXPECT_EQ(section.comparisons.size(), 8U);
  const NamedComparison& ranks =
      comparison(section, "priming: primed - unprimed: a of estimation, ranks, sensitivity");
  EXPECT_FALSE(ranks.p_value_holm.has_value());
  EXPECT_TRUE(ranks.family.empty());
  EXPECT_GE(primed.p_value_holm.value(), primed.comparison.p_value.value());
  EXPECT_LE(primed.p_value_holm.value(), 4.0 * primed.comparison.p_value.value() + 1e-12);
}

/// Returns everybody's exponent and k of one block. Each person has cells of their own.
ResultsSection of_cells(const BlockDesign& block, const std::vector<std::string>& cells) {
  StudyData data{.blocks = {block}};
  ResultsSection fits{.name = block.block};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string name = "P" + std::to_string(10 + i);
    data.participants.push_back({.participant = name, .cells = cells[i]});
    const double value = 0.5 + 0.1 * static_cast<double>(i * i % 7);
    fits.participants.push_back({name, block.block + ".a", value, {}, ""});
    fits.participants.push_back({name, block.block + ".k", value, {}, ""});
  }
  return adjusted(data, {fits});
}

TEST(ExploratoryResults, RowsOfASquareAndOrdersOfManyAreNotCompared) {
  EXPECT_TRUE(of_cells(kEstimation, {"estimation=row_1", "estimation=row_2", "estimation=row_1",
                                     "estimation=row_2"})
                  .comparisons.empty());
  EXPECT_TRUE(
      of_cells(kEstimation, {"order=a,b,c", "order=b,c,a", "order=a,b,c", "order=b,c,a"})
          .comparisons.empty());
  EXPECT_EQ(of_cells(kEstimation, {"order=a,b", "order=b,a", "order=a,b", "order=b,a"})
                .comparisons.size(),
            4U)
      << "of two the order is";
}

TEST(ExploratoryResults, AnArmOfOneIsNotComparedAndSaysSo) {
  const ResultsSection section =
      of_cells(kEstimation, {"sex=f", "sex=f", "sex=m", "sex=m", "sex=x"});
  EXPECT_EQ(section.comparisons.size(), 4U);
  for (const NamedComparison& named : section.comparisons) {
    EXPECT_EQ(named.name.find("sex: f - m: "), 0U) << named.name;
  }
  ASSERT_EQ(section.excluded.size(), 1U);
  EXPECT_EQ(section.excluded.front().participant, "P14");
  EXPECT_NE(section.excluded.front().reason.find("the only one in sex = x"), std::string::npos);
}

TEST(ExploratoryResults, TheSizeOfNumbersThatPeopleChoseIsNotCompared) {
  BlockDesign free = kEstimation;
  free.written.settings.set("modulus", "free");
  const ResultsSection section = of_cells(free, {"sex=f", "sex=f", "sex=m", "sex=m"});
  EXPECT_EQ(section.comparisons.size(), 2U);
  EXPECT_NE(section.comparisons.front().name.find(": a of estimation"), std::string::npos);
}

TEST(ExploratoryResults, ATestThatCannotBeMadeSpoilsNoOther) {
  StudyData data{.participants = {anchored("P01", 0.2), anchored("P02", 0.3),
                                  anchored("P03", 0.25), anchored("P04", 0.25)},
                 .blocks = {kProduction}};
  data.participants[0].cells = data.participants[3].cells = "priming=primed";
  data.participants[1].cells = data.participants[2].cells = "priming=unprimed";
  ResultsSection fits{.name = "production"};
  for (const char* name : {"P01", "P02", "P03", "P04"}) {
    fits.participants.push_back({name, "production.a", 1.0, {}, ""});
  }
  const ResultsSection section = adjusted(data, {fits});
  const NamedComparison& alike =
      comparison(section, "priming: primed - unprimed: a of production, t");
  EXPECT_EQ(alike.comparison.status, FitStatus::kDegenerate);
  EXPECT_FALSE(alike.p_value_holm.has_value());
  const NamedComparison& start =
      comparison(section, "production.starting_value_slope against 0, t");
  EXPECT_TRUE(start.p_value_holm.has_value());
}

TEST(ExploratoryResults, AStudyWithNothingOfThisHasNone) {
  StudyData data{.participants = {{.participant = "P01"}},
                 .blocks = {{"group_d", "constant_stimuli", "viscosity_pa_s", 40, 1.853}}};
  const ResultsSection section = exploratory_results(data, {});
  EXPECT_TRUE(section.estimates.empty());
  EXPECT_TRUE(section.comparisons.empty());
}

/// Postponed trials have numbers that are too low for the time at which they were run.
TEST(ExploratoryResults, DriftAndTheStimulusBeforeGoByWhenTrialsWereRun) {
  ParticipantData by_number{.participant = "P01"};
  const std::vector<double> stimuli = {1.0, 3.0, 2.0, 3.0, 2.0, 1.0};
  const std::vector<double> answers = {90.0, 310.0, 190.0, 290.0, 220.0, 120.0};
  for (std::size_t i = 0; i < stimuli.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i + 1);
    by_number.trials.push_back({.trial = number,
                                .block = "estimation",
                                .intensity = stimuli[i],
                                .response = answers[i],
                                .first_tick = 1000 * number});
  }
  // These are the same trials in the same order, but the trial that was run fifth had been
  // drawn as the second.
  ParticipantData put_off = by_number;
  const std::vector<std::int64_t> drawn_as = {1, 3, 4, 5, 2, 6};
  for (std::size_t i = 0; i < drawn_as.size(); ++i) put_off.trials[i].trial = drawn_as[i];
  const auto effect_of = [](const ParticipantData& person, const std::string& name) {
    const StudyData data{.participants = {person}, .blocks = {kEstimation}};
    return own(exploratory_results(data, {}), "P01", "estimation." + name);
  };
  for (const std::string name : {"drift_per_ten_trials", "previous_stimulus_slope"}) {
    EXPECT_DOUBLE_EQ(effect_of(put_off, name), effect_of(by_number, name)) << name;
  }
}

}  // namespace exploratory_results_test
}  // namespace jnd::analysis
