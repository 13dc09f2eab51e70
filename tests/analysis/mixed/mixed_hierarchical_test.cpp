#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_effects.h"
#include "analysis/hierarchical/hierarchical_fit.h"
#include "analysis/mixed/mixed_table.h"

// Tests models of other commands as formulas of `jnd fit glmm`. docs/methods/mixed_models.md
// lists them. Both maximise one likelihood by separate code, so they agree to 1e-5 of an
// estimate, or of 0.1 if that is more.

namespace jnd::analysis {
namespace mixed_hierarchical_test {

constexpr double kTolerance = 1e-5;

void expect_alike(double one, double other, const std::string& what) {
  EXPECT_NEAR(one, other, kTolerance * std::max(std::fabs(other), 0.1)) << what;
}

/// Returns eleven people at seven levels of two conditions, about the reference 10, without
/// lapses.
std::vector<ParticipantAnswers> made_up(int num_conditions) {
  std::mt19937_64 random(23);
  std::normal_distribution<double> normal;
  std::vector<ParticipantAnswers> all;
  for (int person = 0; person < 11; ++person) {
    const double slope = 4.0 + 0.9 * normal(random), place = 0.2 + 0.4 * normal(random);
    for (int condition = 0; condition < num_conditions; ++condition) {
      ParticipantAnswers& one =
          all.emplace_back(ParticipantAnswers{"P" + std::to_string(10 + person),
                                              num_conditions == 1 ? ""
                                              : condition == 0    ? "A"
                                                                  : "B",
                                              10.0,
                                              {}});
      for (const double x : {6.0, 7.5, 9.0, 10.0, 11.0, 13.0, 16.0}) {
        const double z = (slope + condition) * std::log(x / 10.0) + place;
        std::binomial_distribution<int> yes(20, 0.5 * std::erfc(-z / std::sqrt(2.0)));
        one.rows.push_back({x, yes(random), 20});
      }
    }
  }
  return all;
}

MixedFit fit_formula(const std::vector<ParticipantAnswers>& answers, const char* fixed,
                     const char* random, int num_nodes) {
  std::string text = "participant,condition,u,num_yes,num_trials\n";
  for (const ParticipantAnswers& one : answers) {
    for (const AnswerCount& row : one.rows) {
      char u[40];
      std::snprintf(u, sizeof u, "%.17g", std::log(row.intensity / one.reference));
      text += one.participant + "," + (one.condition.empty() ? "all" : one.condition) + "," +
              u + "," + std::to_string(row.num_yes) + "," + std::to_string(row.num_trials) +
              "\n";
    }
  }
  const MixedFormulas formulas{parse_formula(fixed), parse_random_terms(random)};
  const TrialTable table =
      parse_trial_table(text, "made up",
                        {.answers = {.yes = "num_yes", .yes_value = {}, .trials = "num_trials"},
                         .variables = columns_of(formulas),
                         .where = {}});
  return fit_mixed(mixed_data(formulas, Design(formulas.fixed, table, Contrasts::kTreatment),
                              table, Contrasts::kTreatment),
                   {.curve = {}, .num_nodes = num_nodes});
}

double effect(const MixedFit& fit, const std::string& name) {
  const auto found = std::ranges::find(fit.fixed, name, &FixedEffect::name);
  return found == fit.fixed.end() ? std::nan("") : found->estimate;
}

double spread(const MixedFit& fit, const std::string& name) {
  const auto found = std::ranges::find(fit.random, name, &RandomEffect::name);
  return found == fit.random.end() ? std::nan("") : found->sd;
}

struct Said {
  HierarchicalPse pse;
  const char* fixed;
  const char* random;
  int num_nodes;
};

TEST(MixedAsHierarchical, EveryPseOfOneConditionIsAFormula) {
  const std::vector<ParticipantAnswers> answers = made_up(1);
  for (const Said& said :
       {Said{HierarchicalPse::kPersonal, "u", "1 + u || participant", 1},
        Said{HierarchicalPse::kPersonal, "u", "1 + u || participant", 9},
        Said{HierarchicalPse::kCommon, "u", "0 + u | participant", 15},
        Said{HierarchicalPse::kReference, "0 + u", "0 + u | participant", 15}}) {
    const std::string what = std::string(said.fixed) + ", " + said.random;
    const HierarchicalFit ours = fit_hierarchical(answers, {.link = HierarchicalLink::kLinear,
                                                            .pse = said.pse,
                                                            .lapses = HierarchicalLapses::kNone,
                                                            .num_nodes = said.num_nodes});
    const MixedFit mixed = fit_formula(answers, said.fixed, said.random, said.num_nodes);
    ASSERT_EQ(ours.status, FitStatus::kOk) << what << ours.reason;
    ASSERT_EQ(mixed.status, FitStatus::kOk) << what << mixed.reason;
    const HierarchicalCondition& condition = ours.conditions.front();
    expect_alike(effect(mixed, "u"), condition.slope_number, what + " slope");
    expect_alike(spread(mixed, "u"), condition.slope_sd, what + " spread of slopes");
    EXPECT_GT(condition.slope_sd, 0.3);
    if (said.pse != HierarchicalPse::kReference) {
      expect_alike(effect(mixed, "(Intercept)"), condition.place_number, what + " place");
    }
    if (said.pse == HierarchicalPse::kPersonal) {
      expect_alike(spread(mixed, "(Intercept)"), condition.place_sd,
                   what + " spread of places");
    }
  }
}

TEST(MixedAsHierarchical, TwoConditionsAreColumnsOfAFactor) {
  const std::vector<ParticipantAnswers> answers = made_up(2);
  const HierarchicalFit ours =
      fit_hierarchical(answers, {.link = HierarchicalLink::kLinear,
                                 .pse = HierarchicalPse::kCommon,
                                 .slopes = HierarchicalSlopes::kCorrelated,
                                 .lapses = HierarchicalLapses::kNone,
                                 .num_nodes = 9});
  const MixedFit mixed =
      fit_formula(answers, "0 + condition + condition:u", "0 + condition:u | participant", 9);
  ASSERT_EQ(ours.status, FitStatus::kOk) << ours.reason;
  ASSERT_EQ(mixed.status, FitStatus::kOk) << mixed.reason;
  ASSERT_EQ(mixed.random.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "conditionA" : "conditionB";
    const HierarchicalCondition& condition = ours.conditions[static_cast<std::size_t>(i)];
    expect_alike(effect(mixed, name), condition.place_number, name + " place");
    expect_alike(effect(mixed, name + ":u"), condition.slope_number, name + " slope");
    expect_alike(spread(mixed, name + ":u"), condition.slope_sd, name + " spread");
  }
  ASSERT_EQ(mixed.random[1].correlations.size(), 1U);
  EXPECT_NEAR(mixed.random[1].correlations[0], ours.correlation.value(), 1e-4);
}

TEST(MixedAsEffects, ARegressionOnTheTrialIsAFormula) {
  // Two people answered alike, so nothing differs between them, and the mixed model is the
  // regression.
  std::vector<OrderedAnswers> answers;
  std::string text = "participant,u,t,o,y\n";
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 240;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double x = 10.0 * std::exp(0.1 * ((trial * 7) % 9 - 4));
    const bool test_first = (trial * 11) % 13 < 6;
    const double u = std::log(x / 10.0), t = trial / (kTrials - 1.0) - 0.5;
    const double z = (4.0 + t) * u + 0.3 - 0.5 * t + (test_first ? 0.2 : -0.2);
    const bool yes = normal(random) < z;
    for (const char* person : {"a", "b"}) {
      answers.push_back({.intensity = x,
                         .num_yes = yes ? 1.0 : 0.0,
                         .num_trials = 1.0,
                         .trial = trial,
                         .test_first = test_first});
      char row[160];
      std::snprintf(row, sizeof row, "%s,%.17g,%.17g,%g,%d\n", person, u, t,
                    test_first ? 0.5 : -0.5, yes ? 1 : 0);
      text += row;
    }
  }
  const PsychometricEffects ours = psychometric_effects(answers, 10.0);
  const MixedFormulas formulas{parse_formula("u * t + o"),
                               parse_random_terms("1 | participant")};
  const TrialTable table =
      parse_trial_table(text, "made up",
                        {.answers = {.yes = "y", .yes_value = {}, .trials = {}},
                         .variables = columns_of(formulas),
                         .where = {}});
  const MixedFit mixed =
      fit_mixed(mixed_data(formulas, Design(formulas.fixed, table, Contrasts::kTreatment),
                           table, Contrasts::kTreatment));
  ASSERT_EQ(mixed.status, FitStatus::kOk) << mixed.reason;
  EXPECT_LT(spread(mixed, "(Intercept)"), 1e-3);
  expect_alike(effect(mixed, "u"), ours.slope.value(), "slope");
  const auto found = [&](const char* name) {
    const auto one = std::ranges::find(ours.effects, name, &PsychometricEffect::name);
    return one == ours.effects.end() ? std::nan("") : one->estimate.value();
  };
  expect_alike(effect(mixed, "(Intercept)"), found("response_bias"), "response_bias");
  expect_alike(effect(mixed, "o"), found("interval_order"), "interval_order");
  expect_alike(effect(mixed, "t"), found("drift"), "drift");
  expect_alike(effect(mixed, "u:t") / effect(mixed, "u"), found("learning"), "learning");
}

}  // namespace mixed_hierarchical_test
}  // namespace jnd::analysis
