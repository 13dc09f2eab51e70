#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/study_results.h"
#include "support/places.h"

namespace jnd::analysis {
namespace magnitude_reference_test {

using nlohmann::json;

/// An invented study and its analysis by SciPy, see the script beside it.
const json& reference() {
  static const json kDocument = [] {
    std::ifstream in(test_support::source_folder().string() +
                     "/data/reference/magnitudes/magnitudes.json");
    return json::parse(in);
  }();
  return kDocument;
}

StudyData invented_study() {
  StudyData data{.study = "invented"};
  data.blocks = {{"magnitude_estimation", "magnitude_estimation", "scale", 27},
                 {"magnitude_production", "magnitude_production", "scale", 27}};
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

void expect_close(const std::optional<double>& found, const json& expected,
                  const std::string& where) {
  ASSERT_TRUE(found.has_value()) << where;
  const double value = expected.get<double>();
  EXPECT_NEAR(*found, value, 1e-7 * std::max(std::fabs(value), 1e-3)) << where;
}

void expect_interval(const Interval& found, const json& expected, const std::string& where) {
  expect_close(found.low, expected.at(0), where + " low");
  expect_close(found.high, expected.at(1), where + " high");
}

TEST(MagnitudeReference, EveryGroupValueAgreesWithScipy) {
  for (const auto& [name, expected] : reference().at("estimates").items()) {
    const Estimate* found = results().find(name);
    ASSERT_NE(found, nullptr) << name;
    expect_close(found->value, expected.at("value"), name);
    if (expected.contains("ci95")) expect_interval(found->ci95, expected.at("ci95"), name);
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
        expect_close(own.value, expected.at("value"), who + " " + name);
        if (expected.contains("ci95")) {
          expect_interval(own.ci95, expected.at("ci95"), who + " " + name);
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
    expect_close(c.p_value, expected.at("p_value"), name + ": p");
    if (expected.contains("estimate")) expect_close(c.estimate, expected.at("estimate"), name);
    if (expected.contains("statistic")) {
      expect_close(c.statistic, expected.at("statistic"), name + ": statistic");
    }
    if (expected.contains("ci95")) expect_interval(c.ci95, expected.at("ci95"), name);
    EXPECT_EQ(found->p_value_holm.has_value(), expected.contains("p_value_holm")) << name;
    if (!expected.contains("p_value_holm")) continue;
    ++num_adjusted;
    expect_close(found->p_value_holm, expected.at("p_value_holm"), name + ": Holm");
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
