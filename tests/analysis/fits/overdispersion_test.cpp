#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/fits/psychometric_fit.h"
#include "analysis/reference_values.h"
#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace overdispersion_test {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Computed by SciPy; see the script beside the file.
const json& reference() {
  return test_support::reference_data("overdispersion/overdispersion.json");
}

TEST(Overdispersion, AgreesWithSciPy) {
  for (const json& one : reference().at("cases")) {
    const bool scaled = one.at("model") == "scaled";
    const std::string name =
        one.at("name").get<std::string>() + ", " + one.at("model").get<std::string>();
    const PsychometricFit fit = fit_psychometric(
        reference_answers(one.at("data")),
        {.reference = 1.0,
         .free_pse = true,
         .guess_rate = one.at("guess_rate"),
         .overdispersion = scaled ? Overdispersion::kScaled : Overdispersion::kBetaBinomial});
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << fit.reason;
    const json& expected = one.at("expected");
    expect_reference(fit.weber_fraction, expected.at("weber_fraction"), 2e-6, name + " w");
    expect_reference(fit.pse, expected.at("pse"), 2e-6, name + " pse");
    expect_reference(fit.weber_fraction_ci95.low, expected.at("weber_fraction_ci95")[0], 1e-5,
                     name);
    expect_reference(fit.weber_fraction_ci95.high, expected.at("weber_fraction_ci95")[1], 1e-5,
                     name);
    expect_reference(fit.pse_ci95->low, expected.at("pse_ci95")[0], 1e-5, name);
    expect_reference(fit.pse_ci95->high, expected.at("pse_ci95")[1], 1e-5, name);
    if (scaled) {
      expect_reference(fit.overdispersion.factor, expected.at("factor"), 1e-6, name);
    } else {
      EXPECT_NEAR(*fit.overdispersion.correlation, expected.at("correlation").get<double>(),
                  1e-6)
          << name;
      expect_reference(fit.overdispersion.log_likelihood, expected.at("log_likelihood"), 1e-9,
                       name);
    }
  }
}

TEST(Overdispersion, ScaledErrorsGrowByTheRootOfTheFactor) {
  const std::vector<AnswerCount> rows =
      reference_answers(reference().at("cases")[1].at("data"));
  const PsychometricFit plain = fit_psychometric(rows, {.reference = 1.0, .free_pse = true});
  const PsychometricFit scaled = fit_psychometric(
      rows, {.reference = 1.0, .free_pse = true, .overdispersion = Overdispersion::kScaled});
  EXPECT_GT(*scaled.overdispersion.factor, 2.0);
  EXPECT_NEAR(*scaled.standard_error / *plain.standard_error,
              std::sqrt(*scaled.overdispersion.factor), 1e-9);
  EXPECT_EQ(*scaled.weber_fraction, *plain.weber_fraction);
}

/// Draws answers whose probability varies about the curve by `noise` in z, by the same amount
/// for all answers of a level.
std::vector<AnswerCount> scattered(core::RandomStream& random, double noise) {
  std::vector<AnswerCount> rows;
  for (const double x : {0.5, 0.62, 0.75, 0.88, 1.0, 1.15, 1.35, 1.6, 2.0}) {
    const double shift = noise * core::standard_normal_quantile(random.uniform());
    AnswerCount row = {x, 0, 40};
    const double p = core::standard_normal_cdf(std::log(x) / std::log1p(0.4) + shift);
    for (int trial = 0; trial < 40; ++trial) row.num_yes += random.with_probability(p) ? 1 : 0;
    rows.push_back(row);
  }
  return rows;
}

TEST(Overdispersion, IntervalsHoldTheTruthThatBinomialOnesMiss) {
  core::RandomStream random(4, "overdispersion test");
  constexpr int kSets = 150;
  int num[3] = {};
  for (int set = 0; set < kSets; ++set) {
    const std::vector<AnswerCount> rows = scattered(random, 0.4);
    int place = 0;
    for (const auto how :
         {Overdispersion::kNone, Overdispersion::kScaled, Overdispersion::kBetaBinomial}) {
      const PsychometricFit fit =
          fit_psychometric(rows, {.reference = 1.0, .free_pse = true, .overdispersion = how});
      ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
      // The noise flattens the curve by a known factor, z / sqrt(1 + noise^2).
      const double truth = std::expm1(std::log1p(0.4) * std::sqrt(1.0 + 0.4 * 0.4));
      const Interval& ends = fit.weber_fraction_ci95;
      num[place++] += ends.low.value_or(0.0) <= truth && truth <= ends.high.value_or(1e9);
    }
  }
  EXPECT_LT(num[0], 0.86 * kSets);
  EXPECT_GT(num[1], 0.90 * kSets);
  EXPECT_GT(num[2], 0.88 * kSets);
}

TEST(Overdispersion, WhereNoDegreeIsLeftThereIsNoScaledInterval) {
  const PsychometricFit fit = fit_psychometric(
      {{0.5, 3, 20}, {2.0, 18, 20}},
      {.reference = 1.0, .free_pse = true, .overdispersion = Overdispersion::kScaled});
  ASSERT_EQ(fit.status, FitStatus::kOk);
  EXPECT_FALSE(fit.weber_fraction_ci95.low || fit.weber_fraction_ci95.high);
  EXPECT_FALSE(fit.standard_error);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("no degree of freedom")));
}

/// The sums of a level lie on the curve, but the rows do not. R's quasibinomial probit through
/// the origin has the dispersion 9.2252 with 11 degrees of freedom.
TEST(Overdispersion, RowsOfOneLevelScatterWhateverTheirSumDoes) {
  const std::vector<AnswerCount> rows = {
      {0.5, 0, 20},   {0.5, 2, 20},   {0.5, 8, 20},  {0.8, 0, 20}, {0.8, 4, 20}, {0.8, 18, 20},
      {1.25, 20, 20}, {1.25, 16, 20}, {1.25, 2, 20}, {2, 20, 20},  {2, 18, 20},  {2, 12, 20}};
  const auto fit = [&](Overdispersion overdispersion) {
    return fit_psychometric(
        rows, {.reference = 1.0, .overdispersion = overdispersion, .advice = true});
  };
  const PsychometricFit plain = fit(Overdispersion::kNone);
  EXPECT_THAT(plain.warnings, Contains(HasSubstr("rows of the same level scatter")));
  const PsychometricFit scaled = fit(Overdispersion::kScaled);
  EXPECT_NEAR(*scaled.overdispersion.factor, 9.22524, 1e-4);
  const PsychometricFit beta = fit(Overdispersion::kBetaBinomial);
  EXPECT_GT(*beta.overdispersion.correlation, 0.3);
  for (const PsychometricFit* wider : {&scaled, &beta}) {
    EXPECT_LT(*wider->weber_fraction_ci95.low, 0.8 * *plain.weber_fraction_ci95.low);
    EXPECT_THAT(wider->warnings, Contains(HasSubstr("the Weber fraction itself is too large")));
    EXPECT_THAT(wider->warnings, Not(Contains(HasSubstr("intervals are too narrow"))));
  }
}

/// In a table of single answers, only the levels can show scatter.
TEST(Overdispersion, SingleAnswersCountByTheirLevels) {
  std::vector<AnswerCount> counts = reference_answers(reference().at("cases")[1].at("data")),
                           single;
  for (const AnswerCount& row : counts) {
    for (int i = 0; i < row.num_trials; ++i)
      single.push_back({row.intensity, i < row.num_yes, 1});
  }
  for (const auto how : {Overdispersion::kScaled, Overdispersion::kBetaBinomial}) {
    const PsychometricOptions options = {
        .reference = 1.0, .free_pse = true, .overdispersion = how, .advice = true};
    const PsychometricFit by_count = fit_psychometric(counts, options);
    const PsychometricFit by_answer = fit_psychometric(single, options);
    EXPECT_EQ(by_answer.weber_fraction_ci95.high, by_count.weber_fraction_ci95.high);
    EXPECT_EQ(by_answer.overdispersion.factor, by_count.overdispersion.factor);
    EXPECT_THAT(by_answer.warnings, Not(Contains(HasSubstr("rows of the same level"))));
  }
}

std::vector<std::string> advice_of(const std::vector<AnswerCount>& rows, double guess = 0.0,
                                   bool free_lapse = false) {
  return fit_psychometric(rows, {.reference = 1.0,
                                 .free_pse = true,
                                 .free_lapse = free_lapse,
                                 .guess_rate = guess,
                                 .symmetric_lapse = guess == 0.0,
                                 .diagnostics = true,
                                 .advice = true})
      .warnings;
}

TEST(Overdispersion, TheNoteOffersTheIntervalsByName) {
  const std::vector<AnswerCount> rows =
      reference_answers(reference().at("cases")[1].at("data"));
  EXPECT_THAT(advice_of(rows), Contains(HasSubstr("--overdispersion scaled")));
  EXPECT_THAT(advice_of(rows), Contains(HasSubstr("--overdispersion beta-binomial")));
  EXPECT_THAT(advice_of(rows), Not(Contains(HasSubstr("--free lapse"))));
}

TEST(Overdispersion, WhereOneLapseExplainsTheScatterTheNoteSaysSo) {
  // There is one "no" at a level that is otherwise far above.
  const std::vector<AnswerCount> rows = {{0.80, 0, 40},  {0.90, 4, 40},  {0.96, 14, 40},
                                         {1.05, 27, 40}, {1.12, 37, 40}, {2.00, 39, 40}};
  EXPECT_THAT(advice_of(rows), Contains(HasSubstr("--free lapse")));
  EXPECT_THAT(advice_of(rows), Not(Contains(HasSubstr("--overdispersion"))));
  EXPECT_THAT(advice_of(rows, 0.0, true), Not(Contains(HasSubstr("farther from the curve"))));
  const std::vector<AnswerCount> forced = {{0.80, 40, 80}, {0.90, 43, 80}, {0.96, 53, 80},
                                           {1.05, 68, 80}, {1.12, 78, 80}, {2.00, 77, 80}};
  EXPECT_THAT(advice_of(forced, 0.5), Contains(HasSubstr("--lapse free")));
}

TEST(Overdispersion, WhatDrawsIndependentAnswersIsRefused) {
  PsychometricOptions options = {
      .reference = 1.0, .overdispersion = Overdispersion::kScaled, .num_bootstrap = 10};
  EXPECT_THROW((void)fit_psychometric({{2.0, 8, 10}}, options), core::Error);
  options.num_bootstrap = 0;
  options.method = PsychometricMethod::kLeastSquares;
  EXPECT_THROW((void)fit_psychometric({{2.0, 8, 10}}, options), core::Error);
}

TEST(Overdispersion, EndsOfThePriorAreOpenWhereMoreThanTheTailLiesBeyond) {
  for (const json& one : reference().at("posteriors")) {
    const std::string name = one.at("name");
    const PsychometricPosterior found =
        fit_psychometric(reference_answers(one.at("data")), {.reference = 1.0,
                                                             .free_pse = true,
                                                             .guess_rate = one.at("guess_rate"),
                                                             .posterior = true})
            .posterior;
    ASSERT_EQ(found.status, FitStatus::kOk) << name;
    const auto opens = [&](const char* what) {
      for (const json& other : one.at("opens")) {
        if (other == what) return true;
      }
      return false;
    };
    EXPECT_EQ(opens("weber_fraction"),
              !found.weber_fraction_ci95.low || !found.weber_fraction_ci95.high)
        << name;
    EXPECT_EQ(opens("pse"), !found.pse_ci95->low || !found.pse_ci95->high) << name;
    EXPECT_EQ(one.at("opens").empty(), found.note.empty()) << name;
    EXPECT_NEAR(*found.weber_fraction, one.at("weber_fraction")[1].get<double>(),
                2e-3 * *found.weber_fraction)
        << name;
    EXPECT_NEAR(*found.pse, one.at("pse")[1].get<double>(), 2e-3 * *found.pse) << name;
  }
}

}  // namespace overdispersion_test
}  // namespace jnd::analysis
