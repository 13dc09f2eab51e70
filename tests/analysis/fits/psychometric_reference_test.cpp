#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/fits/psychometric_effects.h"
#include "analysis/fits/psychometric_json.h"
#include "analysis/reference_values.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace psychometric_reference_test {

using nlohmann::json;

/// The reference was computed by R with the script beside it.
const json& reference() {
  return test_support::reference_data("psychometric_families/psychometric_reference.json");
}

void expect_near(double found, double expected, double tolerance, const std::string& where) {
  EXPECT_NEAR(found, expected, tolerance * std::max(std::fabs(expected), 1e-2)) << where;
}

PsychometricFit family_fit(const json& one, Solver solver) {
  return fit_psychometric(
      reference_answers(one.at("data")),
      {.reference = one.at("reference"),
       .family = psychometric_family_named(one.at("family").get<std::string>()).value(),
       .diagnostics = true,
       .solver = solver});
}

TEST(PsychometricReference, OtherFamiliesAgreeWithGlm) {
  for (const json& one : reference().at("families")) {
    const std::string name = one.at("name");
    const PsychometricFit fit = family_fit(one, Solver::kCeres);
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << ": " << fit.reason;
    const json& expected = one.at("expected");
    expect_near(*fit.weber_fraction, expected.at("weber_fraction"), 1e-6, name);
    expect_near(*fit.pse, expected.at("pse"), 1e-6, name);
    expect_near(*fit.weber_fraction_ci95.low, expected.at("weber_fraction_ci95")[0], 1e-6,
                name);
    expect_near(*fit.weber_fraction_ci95.high, expected.at("weber_fraction_ci95")[1], 1e-6,
                name);
    expect_near(*fit.pse_ci95->low, expected.at("pse_ci95")[0], 1e-6, name);
    expect_near(*fit.pse_ci95->high, expected.at("pse_ci95")[1], 1e-6, name);
    expect_near(*fit.standard_error, expected.at("standard_error"), 1e-6, name);
    expect_near(*fit.log_likelihood, expected.at("log_likelihood"), 1e-6, name);
    expect_near(*fit.deviance, expected.at("deviance"), 1e-6, name);
    expect_near(*fit.goodness.overdispersion, expected.at("overdispersion"), 1e-6, name);
    for (const PsychometricFit::Parameter& parameter : fit.parameters) {
      expect_near(parameter.value, one.at("parameters").at(std::string(parameter.name)), 1e-6,
                  name);
    }
    ASSERT_EQ(fit.goodness.residuals.size(), one.at("residuals").size());
    for (std::size_t level = 0; level < fit.goodness.residuals.size(); ++level) {
      expect_near(fit.goodness.residuals[level].deviance_residual, one.at("residuals")[level],
                  1e-6, name);
    }
  }
}

TEST(PsychometricReference, BothSolversFindTheSameCurveInEveryFamily) {
  for (const json& one : reference().at("families")) {
    expect_near(*family_fit(one, Solver::kNewton).weber_fraction,
                *family_fit(one, Solver::kCeres).weber_fraction, 1e-9, one.at("name"));
  }
}

TEST(PsychometricReference, EffectsAgreeWithGlm) {
  std::vector<OrderedAnswers> answers;
  for (const json& row : reference().at("effects").at("rows")) {
    answers.push_back({.intensity = row[1],
                       .num_yes = row[3],
                       .trial = row[0].get<double>(),
                       .test_first = row[2] == 1});
  }
  const std::vector<PsychometricEffect> found = psychometric_effects(answers, 1.0).effects;
  const json& expected = reference().at("effects").at("expected");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t place = 0; place < found.size(); ++place) {
    const PsychometricEffect& one = found[place];
    EXPECT_EQ(one.name, reference().at("effects").at("names")[place]);
    ASSERT_EQ(one.status, FitStatus::kOk) << one.reason;
    expect_near(*one.estimate, expected[place].at("estimate"), 1e-6, one.name);
    expect_near(*one.ci95.low, expected[place].at("low"), 1e-6, one.name);
    expect_near(*one.ci95.high, expected[place].at("high"), 1e-6, one.name);
    expect_near(*one.statistic, expected[place].at("statistic"), 1e-6, one.name);
    expect_near(*one.p_value, expected[place].at("p_value"), 1e-6, one.name);
  }
}

TEST(PsychometricReference, TheAccelerationIsThatOfLeavingOutEachAnswer) {
  const PsychometricFit fit =
      fit_psychometric(reference_answers(reference().at("weber_data")),
                       {.reference = 1.0,
                        .num_bootstrap = 200,
                        .bootstrap_kind = BootstrapKind::kNonparametric});
  expect_near(fit.bootstrap.acceleration.value(), reference().at("acceleration"), 1e-6, "");
}

TEST(PsychometricReference, ThePosteriorAgreesWithIntegration) {
  const json& expected = reference().at("posterior");
  const auto posterior = [&](bool free_pse) {
    return fit_psychometric(reference_answers(reference().at("weber_data")),
                            {.reference = 1.0, .free_pse = free_pse, .posterior = true})
        .posterior;
  };
  const PsychometricPosterior fixed = posterior(false), free = posterior(true);
  ASSERT_EQ(fixed.status, FitStatus::kOk);
  const auto expect_quantiles = [](const Interval& ci95, double median, const json& wanted) {
    expect_near(*ci95.low, wanted[0], 2e-6, "low");
    expect_near(median, wanted[1], 2e-6, "median");
    expect_near(*ci95.high, wanted[2], 2e-6, "high");
  };
  expect_quantiles(fixed.weber_fraction_ci95, *fixed.weber_fraction,
                   expected.at("fixed_weber_fraction"));
  expect_quantiles(free.weber_fraction_ci95, *free.weber_fraction,
                   expected.at("free_weber_fraction"));
  expect_quantiles(*free.pse_ci95, *free.pse, expected.at("free_pse"));
}

TEST(PsychometricReference, TheGaussianPosteriorOfTheWeberFractionIsThatOfSpreadOverPse) {
  const json& one = reference().at("families")[0];
  const std::vector<AnswerCount> rows = reference_answers(one.at("data"));
  const PsychometricPosterior found =
      fit_psychometric(
          rows, {.reference = 3.0, .family = PsychometricFamily::kGauss, .posterior = true})
          .posterior;
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  // The expected values come from sums over a fine grid of ln spread and pse, within priors
  // that are far wider.
  constexpr int kSteps = 600;
  std::vector<std::pair<double, double>> fraction_and_weight;
  double all = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double spread = std::exp(std::log(0.5) + (i + 0.5) / kSteps * std::log(6.0));
    for (int j = 0; j < kSteps; ++j) {
      const double pse = 2.0 + (j + 0.5) / kSteps * 2.2;
      double log_likelihood = 43.2;
      for (const AnswerCount& row : rows) {
        const double z = (row.intensity - pse) / spread / std::sqrt(2.0);
        const auto yes = static_cast<double>(row.num_yes);
        const double no = static_cast<double>(row.num_trials) - yes;
        if (yes > 0.0) log_likelihood += yes * std::log(0.5 * std::erfc(-z));
        if (no > 0.0) log_likelihood += no * std::log(0.5 * std::erfc(z));
      }
      fraction_and_weight.emplace_back(spread / pse, std::exp(log_likelihood));
      all += fraction_and_weight.back().second;
    }
  }
  std::sort(fraction_and_weight.begin(), fraction_and_weight.end());
  const auto quantile = [&](double probability) {
    double sum = 0.0;
    for (const auto& [fraction, weight] : fraction_and_weight) {
      sum += weight;
      if (sum >= probability * all) return fraction;
    }
    return 0.0;
  };
  EXPECT_NEAR(*found.weber_fraction, quantile(0.5), 2e-3 * quantile(0.5));
  EXPECT_NEAR(*found.weber_fraction_ci95.low, quantile(0.025), 2e-3 * quantile(0.025));
  EXPECT_NEAR(*found.weber_fraction_ci95.high, quantile(0.975), 2e-3 * quantile(0.975));
}

}  // namespace psychometric_reference_test
}  // namespace jnd::analysis
