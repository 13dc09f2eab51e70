#include "analysis/results/trial_trends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/results/test_families.h"
#include "core/error.h"
#include "experiments/procedures/procedure_registry.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace trial_trends_test {

using nlohmann::json;

/// Returns answers with one answer for each trial, in the order of the levels.
DiscriminationAnswers answered(const std::string& name, double reference,
                               const std::vector<double>& levels,
                               const std::vector<int>& answers) {
  DiscriminationAnswers one{.participant = name, .reference = reference};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    one.in_order.push_back({.intensity = levels[i],
                            .num_yes = static_cast<double>(answers[i]),
                            .trial = static_cast<double>(i + 1)});
    for (AnswerCount* count : {&one.levels[levels[i]], &one.cells[{levels[i], 0.0}]}) {
      count->intensity = levels[i];
      count->num_yes += answers[i];
      ++count->num_trials;
    }
  }
  return one;
}

const json& reference() {
  return test_support::reference_data("group_tests/trial_trends.json");
}

std::vector<DiscriminationAnswers> people_of(const json& c) {
  std::vector<DiscriminationAnswers> all;
  for (const json& person : c.at("people")) {
    all.push_back(answered("P" + std::to_string(10 + all.size()), reference().at("reference"),
                           person.at("levels"), person.at("answers")));
  }
  return all;
}

TEST(TrialTrends, SumsOfSquaresAndTheirPValuesAgreeWithAnotherBootstrap) {
  constexpr int kRedraws = 2000;
  for (const json& c : reference().at("cases")) {
    const TrendDispersions found = trend_dispersions(people_of(c), kRedraws, 7);
    for (const auto& [kind, one] :
         {std::pair{"drift", found.drift}, {"learning", found.learning}}) {
      const std::string where = c.at("name").get<std::string>() + ", " + kind;
      const json& expected = c.at("expected").at(kind);
      EXPECT_EQ(one.num_people, expected.at("num_people")) << where;
      const double sum = expected.at("sum_squares");
      EXPECT_NEAR(one.sum_squares, sum, 1e-9 * std::max(1.0, sum)) << where;
      // The tolerance is four standard errors of this number of redraws.
      const double p = expected.at("p_value");
      EXPECT_NEAR(one.p_value, p, 4.0 * std::sqrt(p * (1.0 - p) / kRedraws) + 1e-3) << where;
    }
  }
}

TEST(TrialTrends, WhatHalfDoesUpAndHalfDownTheMeanDoesNotShow) {
  const json& cases = reference().at("cases");
  const json& c = *std::ranges::find_if(
      cases, [](const json& one) { return one.at("name") == "half drift up, half down"; });
  ResultsSection section;
  add_trial_trends(section, people_of(c), {.block = "e", .procedure = "constant_stimuli"},
                   {.num_resamples = 999});
  ASSERT_EQ(section.comparisons.size(), 4U);
  const Comparison& mean = section.comparisons[0].comparison;
  const Comparison& dispersion = section.comparisons[1].comparison;
  EXPECT_EQ(mean.kind, Comparison::Kind::kOneSample);
  EXPECT_GT(*mean.p_value, 0.2);
  EXPECT_EQ(dispersion.kind, Comparison::Kind::kDispersion);
  EXPECT_EQ(dispersion.statistic_name, "sum of z^2");
  EXPECT_EQ(*dispersion.degrees_of_freedom, 13.0);
  EXPECT_GT(*dispersion.statistic, 26.0);
  EXPECT_LT(*dispersion.p_value, 0.01);
  EXPECT_NEAR(*dispersion.estimate, *dispersion.statistic / 13.0, 1e-12);
  for (const NamedComparison& named : section.comparisons) {
    EXPECT_EQ(named.family, kTrialTrendsFamily) << named.name;
  }
}

TEST(TrialTrends, SquaresAreThoseOfTheTrend) {
  const json& c = reference().at("cases").front();
  double drift = 0.0, learning = 0.0;
  for (const DiscriminationAnswers& one : people_of(c)) {
    const TrialTrend trend = trial_trend(one.in_order, one.reference);
    drift += trend.drift.value_or(0.0) * trend.drift.value_or(0.0);
    learning += trend.learning.value_or(0.0) * trend.learning.value_or(0.0);
  }
  const TrendDispersions found = trend_dispersions(people_of(c), 10, 1);
  EXPECT_NEAR(found.drift.sum_squares, drift, 1e-9);
  EXPECT_NEAR(found.learning.sum_squares, learning, 1e-9);
}

TEST(TrialTrends, WithoutAChangeFiveInAHundredAreFoundByTheReference) {
  for (const auto& [name, rates] :
       reference().at("rate_at_5_percent_without_a_change").items()) {
    for (const auto& [kind, rate] : rates.items()) {
      EXPECT_NEAR(rate.get<double>(), 0.05, 0.03) << name << ' ' << kind;
    }
  }
}

TEST(TrialTrends, OneAnswerALevelOrNobodyHasNone) {
  EXPECT_EQ(trend_dispersions({}, 10, 1).drift.num_people, 0);
  const std::vector<DiscriminationAnswers> once = {
      answered("P01", 10.0, {6.0, 8.0, 12.0, 14.0}, {0, 1, 0, 1})};
  ResultsSection section;
  add_trial_trends(section, once, {.block = "e", .procedure = "constant_stimuli"}, {});
  for (const NamedComparison& named : section.comparisons) {
    EXPECT_EQ(named.comparison.status, FitStatus::kDegenerate) << named.name;
    EXPECT_FALSE(named.comparison.p_value) << named.name;
    EXPECT_FALSE(named.comparison.reason.empty()) << named.name;
  }
  EXPECT_THROW((void)trend_dispersions({}, 0, 1), core::Error);
}

TEST(TrialTrends, WhereAnswersLeadToTheLevelsThereAreNoTestsAndWhyIsSaid) {
  for (const char* procedure : {"staircase", "quest_plus", "limits"}) {
    ResultsSection section;
    add_trial_trends(section, people_of(reference().at("cases").front()),
                     {.block = "e",
                      .procedure = procedure,
                      .rule = experiments::procedure_named(procedure).rule()},
                     {});
    EXPECT_TRUE(section.comparisons.empty()) << procedure;
    ASSERT_EQ(section.excluded.size(), 1U);
    EXPECT_NE(section.excluded.front().reason.find("the answers led to the levels"),
              std::string::npos);
  }
}

}  // namespace trial_trends_test
}  // namespace jnd::analysis
