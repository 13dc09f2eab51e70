#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/hierarchical/hierarchical_fit.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace hierarchical_reference_test {

using nlohmann::json;

/// The reference was computed by lme4's glmer, and by integration on a grid in R, with the
/// script beside it.
const json& reference() {
  return test_support::reference_data("hierarchical/hierarchical_reference.json");
}

std::vector<ParticipantAnswers> answers_of(const json& one) {
  std::vector<ParticipantAnswers> all;
  for (const json& row : one.at("rows")) {
    const std::string participant = row[0], condition = row[1];
    if (all.empty() || all.back().participant != participant ||
        all.back().condition != condition) {
      all.push_back({participant, condition, reference().at("reference").at(condition), {}});
    }
    all.back().rows.push_back({row[2], row[3], row[4]});
  }
  return all;
}

/// Reads rows [participant, intensity, num_yes, num_trials] of one condition.
std::vector<ParticipantAnswers> answers_to_one_reference(const json& one) {
  std::vector<ParticipantAnswers> all;
  for (const json& row : one.at("rows")) {
    if (all.empty() || all.back().participant != row[0]) {
      all.push_back({row[0], "", one.at("reference"), {}});
    }
    all.back().rows.push_back({row[1], row[2], row[3]});
  }
  return all;
}

HierarchicalOptions options_of(const json& one, int num_nodes) {
  const std::string pse = one.at("options").at("pse"), slopes = one.at("options").at("slopes");
  return {.link = one.at("link") == "linear" ? HierarchicalLink::kLinear
                                             : HierarchicalLink::kLogSlope,
          .pse = pse == "reference" ? HierarchicalPse::kReference
                 : pse == "common"  ? HierarchicalPse::kCommon
                                    : HierarchicalPse::kPersonal,
          .slopes = slopes == "shared" ? HierarchicalSlopes::kShared
                                       : HierarchicalSlopes::kCorrelated,
          .lapses = HierarchicalLapses::kNone,
          .num_nodes = num_nodes};
}

double at(const json& value, std::size_t condition) {
  return value.is_array() ? value.at(condition).get<double>() : value.get<double>();
}

void expect_fit(const json& one, int num_nodes, double tolerance) {
  SCOPED_TRACE(one.at("name").get<std::string>());
  const HierarchicalFit fit = fit_hierarchical(answers_of(one), options_of(one, num_nodes));
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const json& expected = one.at("expected");
  // The inner iterations of glmer round its Laplace deviance, which becomes visible in second
  // differences.
  const double error_tolerance = fit.num_nodes == 1 ? 1e-4 : tolerance;
  const auto near = [&](double found, const char* key, std::size_t condition, double relative) {
    if (!expected.contains(key)) return;
    const double wanted = at(expected.at(key), condition);
    EXPECT_NEAR(found, wanted, relative * std::max(std::fabs(wanted), 0.1)) << key;
  };
  for (std::size_t i = 0; i < fit.conditions.size(); ++i) {
    const HierarchicalCondition& condition = fit.conditions[i];
    near(condition.slope_number, "slope", i, tolerance);
    near(*condition.slope_standard_error, "slope_standard_error", i, error_tolerance);
    near(condition.slope_sd, "slope_sd", i, tolerance);
    near(condition.place_number, "place", i, tolerance);
    near(condition.place_standard_error.value_or(0.0), "place_standard_error", i,
         error_tolerance);
    near(condition.place_sd, "place_sd", i, tolerance);
  }
  near(fit.correlation.value_or(0.0), "correlation", 0, tolerance);
  near(*fit.log_likelihood, "log_likelihood", 0, tolerance);
}

TEST(HierarchicalReference, LinearFitsAgreeWithGlmerNodeByNode) {
  int num_fits = 0;
  for (const json& one : reference().at("cases")) {
    if (one.at("link") != "linear") continue;
    ++num_fits;
    expect_fit(one, one.at("nodes"), 2e-6);
  }
  EXPECT_EQ(num_fits, 9);
}

TEST(HierarchicalReference, LogSlopeFitsAgreeWithTheIntegralOnAFineGrid) {
  for (const json& one : reference().at("cases")) {
    if (one.at("link") == "linear") continue;
    const bool one_dimension =
        one.at("options").at("slopes") == "shared" && one.at("options").at("pse") != "personal";
    expect_fit(one, one_dimension ? 31 : 35, 2e-6);
  }
}

TEST(HierarchicalReference, AFitWithLapsesAgreesWithTheIntegralOnAFineGrid) {
  const json& one = test_support::reference_data("hierarchical/hierarchical_lapses.json");
  const HierarchicalFit fit =
      fit_hierarchical(answers_to_one_reference(one), {.pse = HierarchicalPse::kCommon,
                                                       .lapses = HierarchicalLapses::kCommon,
                                                       .num_nodes = 41});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const json& expected = one.at("expected");
  const auto near = [&](double found, const char* key) {
    const double wanted = expected.at(key);
    EXPECT_NEAR(found, wanted, 2e-6 * std::max(std::fabs(wanted), 0.1)) << key;
  };
  near(fit.conditions[0].slope_number, "slope");
  near(*fit.conditions[0].slope_standard_error, "slope_standard_error");
  near(fit.conditions[0].place_number, "place");
  near(*fit.conditions[0].place_standard_error, "place_standard_error");
  near(fit.conditions[0].slope_sd, "slope_sd");
  near(*fit.lapse_rate, "lapse_rate");
  near(*fit.log_likelihood, "log_likelihood");
}

TEST(HierarchicalReference, WhatIsLeftOfTheLapseRateAgreesWithProfilesOnAFineGrid) {
  const json& document =
      test_support::reference_data("hierarchical/hierarchical_lapse_profile.json");
  for (const json& one : document.at("cases")) {
    SCOPED_TRACE(one.at("name").get<std::string>());
    const HierarchicalFit fit = fit_hierarchical(
        answers_to_one_reference(one),
        {.pse = HierarchicalPse::kCommon, .guess_rate = one.at("guess_rate"), .num_nodes = 41});
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    const json& expected = one.at("expected");
    const auto near = [&](const std::optional<double>& found, const json& wanted,
                          const char* key) {
      ASSERT_TRUE(found.has_value()) << key;
      EXPECT_NEAR(*found, wanted.get<double>(), 1e-5 * std::max(1.0, wanted.get<double>()))
          << key;
    };
    const HierarchicalCondition& condition = fit.conditions[0];
    near(fit.lapse_rate, expected.at("lapse_rate"), "lapse_rate");
    near(condition.weber_fraction, expected.at("weber_fraction"), "weber_fraction");
    near(fit.lapse_rate_without_prior, expected.at("lapse_rate_without_prior"),
         "lapse_rate_without_prior");
    near(condition.weber_fraction_without_prior, expected.at("weber_fraction_without_prior"),
         "weber_fraction_without_prior");
    const auto near_interval = [&](const Interval& found, const char* key) {
      near(found.low, expected.at(key)[0], key);
      near(found.high, expected.at(key)[1], key);
    };
    near_interval(fit.lapse_rate_ci95, "lapse_rate_ci95");
    near_interval(fit.lapse_rate_with_prior_ci95, "lapse_rate_with_prior_ci95");
    near_interval(condition.weber_fraction_ci95, "weber_fraction_ci95");
  }
}

TEST(HierarchicalReference, ADifferencesErrorAgreesWithTheSandwichOnAFineGrid) {
  const json& one = test_support::reference_data("hierarchical/hierarchical_difference.json");
  std::vector<ParticipantAnswers> answers;
  for (const json& row : one.at("rows")) {
    const std::string participant = row[0], condition = row[1];
    if (answers.empty() || answers.back().condition != condition) {
      answers.push_back({participant, condition, one.at("references").at(condition), {}});
    }
    answers.back().rows.push_back({row[2], row[3], row[4]});
  }
  const HierarchicalFit fit = fit_hierarchical(answers, {.pse = HierarchicalPse::kCommon,
                                                         .lapses = HierarchicalLapses::kCommon,
                                                         .num_nodes = 35});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const json& expected = one.at("expected");
  const auto near = [](double found, double wanted, const char* what) {
    EXPECT_NEAR(found, wanted, 2e-6 * std::max(std::fabs(wanted), 0.1)) << what;
  };
  for (std::size_t i = 0; i < 2; ++i) {
    near(fit.conditions[i].slope_number, expected.at("slopes")[i], "slope");
    near(fit.conditions[i].place_number, expected.at("places")[i], "place");
    near(fit.conditions[i].slope_sd, expected.at("slope_sds")[i], "slope sd");
    near(*fit.conditions[i].slope_standard_error, expected.at("slope_standard_errors")[i],
         "standard error");
  }
  near(*fit.lapse_rate, expected.at("lapse_rate"), "lapse rate");
  near(fit.differences[0].estimate, expected.at("difference"), "difference");
  near(*fit.differences[0].standard_error, expected.at("difference_standard_error"),
       "standard error of the difference");
}

TEST(HierarchicalReference, TheUsualNumberOfNodesIsNearTheIntegral) {
  for (const json& one : reference().at("cases")) {
    if (one.at("link") != "linear") expect_fit(one, 0, 3e-3);
  }
}

}  // namespace hierarchical_reference_test
}  // namespace jnd::analysis
