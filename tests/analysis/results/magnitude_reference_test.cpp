#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/reference_values.h"
#include "analysis/results/study_results.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace magnitude_reference_test {

using nlohmann::json;

/// Returns an invented study, which SciPy analysed with the script beside it.
const json& reference() { return test_support::reference_data("magnitudes/magnitudes.json"); }

StudyData invented_study() {
  StudyData data{.study = "invented"};
  data.blocks = {{.block = "magnitude_estimation",
                  .procedure = "magnitude_estimation",
                  .quantity = "scale",
                  .num_trials = 27,
                  .measures = Measure::kMagnitude},
                 {.block = "magnitude_production",
                  .procedure = "magnitude_production",
                  .quantity = "scale",
                  .num_trials = 27,
                  .measures = Measure::kProducedMagnitude}};
  for (const json& person : reference().at("people")) {
    ParticipantData participant{.participant = person.at("participant"),
                                .cells = person.at("cells")};
    for (const json& row : person.at("estimation")) {
      participant.trials.push_back({.trial = row[0],
                                    .block = "magnitude_estimation",
                                    .repetition = row[1],
                                    .intensity = row[2].get<double>(),
                                    .response = row[3].get<double>()});
    }
    for (const json& row : person.at("production")) {
      participant.trials.push_back({.trial = row[0],
                                    .block = "magnitude_production",
                                    .repetition = row[1],
                                    .intensity = row[4].get<double>(),
                                    .starting_intensity = row[2].get<double>(),
                                    .target_percent = row[3].get<double>(),
                                    .response = row[4].get<double>()});
    }
    data.participants.push_back(std::move(participant));
  }
  return data;
}

const StudyResults& results() {
  static const StudyResults kResults =
      results_of(invented_study(), {}, {.num_resamples = 200, .seed = 1});
  return kResults;
}

TEST(MagnitudeReference, EveryGroupValueAgreesWithScipy) {
  for (const auto& [name, expected] : reference().at("estimates").items()) {
    const Estimate* found = results().find(name);
    ASSERT_NE(found, nullptr) << name;
    expect_reference(found->value, expected.at("value"), 1e-7, name);
    if (expected.contains("ci95"))
      expect_reference(found->ci95, expected.at("ci95"), 1e-7, name);
  }
  EXPECT_GE(reference().at("estimates").size(), 70U);
}

TEST(MagnitudeReference, EveryParticipantsOwnValueAgreesWithScipy) {
  for (const json& expected : reference().at("own")) {
    const std::string who = expected.at("participant"), name = expected.at("name");
    bool is_there = false;
    for (const ResultsSection& section : results().sections) {
      for (const ParticipantEstimate& own : section.participants) {
        if (own.participant != who || own.name != name) continue;
        is_there = true;
        expect_reference(own.value, expected.at("value"), 1e-7, who + " " + name);
        if (expected.contains("ci95")) {
          expect_reference(own.ci95, expected.at("ci95"), 1e-7, who + " " + name);
        }
      }
    }
    EXPECT_TRUE(is_there) << who << ' ' << name;
  }
}

TEST(MagnitudeReference, EveryTestAgreesWithScipyAndIsAdjustedByHolm) {
  std::size_t num_adjusted = 0;
  for (const auto& [name, expected] : reference().at("tests").items()) {
    const NamedComparison* found = nullptr;
    for (const ResultsSection& section : results().sections) {
      for (const NamedComparison& named : section.comparisons) {
        if (named.name == name) found = &named;
      }
    }
    ASSERT_NE(found, nullptr) << name;
    const Comparison& c = found->comparison;
    expect_reference(c.p_value, expected.at("p_value"), 1e-7, name + ": p");
    if (expected.contains("estimate"))
      expect_reference(c.estimate, expected.at("estimate"), 1e-7, name);
    if (expected.contains("statistic")) {
      expect_reference(c.statistic, expected.at("statistic"), 1e-7, name + ": statistic");
    }
    if (expected.contains("ci95")) expect_reference(c.ci95, expected.at("ci95"), 1e-7, name);
    EXPECT_EQ(found->p_value_holm.has_value(), expected.contains("p_value_holm")) << name;
    if (!expected.contains("p_value_holm")) continue;
    ++num_adjusted;
    expect_reference(found->p_value_holm, expected.at("p_value_holm"), 1e-7, name + ": Holm");
  }
  const auto exploratory =
      std::ranges::find(results().sections, "exploratory", &ResultsSection::name);
  ASSERT_NE(exploratory, results().sections.end());
  const auto is_sensitivity = [](const NamedComparison& named) {
    return named.name.ends_with(", sensitivity");
  };
  const auto num_ranks = std::ranges::count_if(exploratory->comparisons, is_sensitivity);
  EXPECT_EQ(num_adjusted + static_cast<std::size_t>(num_ranks), exploratory->comparisons.size())
      << "no test is left unadjusted";
}

TEST(MagnitudeReference, IntervalsOverParticipantsHoldTheEstimateAndAreTheSameEveryTime) {
  const StudyResults again =
      results_of(invented_study(), {}, {.num_resamples = 200, .seed = 1});
  for (const ResultsSection& section : results().sections) {
    for (const Estimate& estimate : section.estimates) {
      const Estimate* other = again.find(estimate.name);
      EXPECT_EQ(estimate.ci95.low, other->ci95.low) << estimate.name;
      EXPECT_EQ(estimate.ci95.high, other->ci95.high) << estimate.name;
      if (estimate.ci95.low) {
        EXPECT_LE(*estimate.ci95.low, *estimate.value) << estimate.name;
      }
      if (estimate.ci95.high) {
        EXPECT_GE(*estimate.ci95.high, *estimate.value) << estimate.name;
      }
    }
  }
}

}  // namespace magnitude_reference_test
}  // namespace jnd::analysis
