#include "analysis/fits/interval_order_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace interval_order_fit_test {

/// Returns the answers of a person who favours the first interval.
std::vector<AnswerCount> biased_answers() {
  return {{4.0, 2, 10, kTestFirst},  {5.0, 5, 10, kTestFirst},  {7.0, 8, 10, kTestFirst},
          {9.0, 10, 10, kTestFirst}, {4.0, 0, 10, kTestSecond}, {5.0, 1, 10, kTestSecond},
          {7.0, 5, 10, kTestSecond}, {9.0, 8, 10, kTestSecond}};
}

/// Rewrites "the test is more, at x" with the test first as "the reference is more, at its
/// mirror image". An order effect q then is a pse of exp(q / 2) in ordinary answers.
std::vector<AnswerCount> mirrored(const std::vector<AnswerCount>& rows, double reference) {
  std::vector<AnswerCount> all;
  for (const AnswerCount& row : rows) {
    if (row.order == kTestSecond) {
      all.push_back({row.intensity, row.num_yes, row.num_trials});
    } else {
      all.push_back({reference * reference / row.intensity, row.num_trials - row.num_yes,
                     row.num_trials});
    }
  }
  return all;
}

TEST(IntervalOrderFit, IsTheFreePseOfMirroredAnswers) {
  const std::vector<AnswerCount> rows = biased_answers();
  const PsychometricFit found = fit_psychometric(rows, {.reference = 6.0, .by_order = true});
  const PsychometricFit other =
      fit_psychometric(mirrored(rows, 6.0), {.reference = 6.0, .free_pse = true});
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  EXPECT_NEAR(*found.weber_fraction, *other.weber_fraction, 1e-9);
  EXPECT_NEAR(*found.standard_error, *other.standard_error, 1e-6);
  EXPECT_NEAR(*found.weber_fraction_ci95.low, *other.weber_fraction_ci95.low, 1e-7);
  EXPECT_NEAR(*found.weber_fraction_ci95.high, *other.weber_fraction_ci95.high, 1e-7);
  EXPECT_NEAR(*found.order_effect_ln, 2.0 * std::log(*other.pse / 6.0), 1e-8);
  EXPECT_NEAR(*found.log_likelihood, *other.log_likelihood, 1e-9);
  EXPECT_DOUBLE_EQ(*found.pse, 6.0);
  EXPECT_FALSE(found.pse_ci95);
}

TEST(IntervalOrderFit, AnOrderWithEveryAnswerAlikeLeavesTheSlopeToTheOther) {
  const std::vector<AnswerCount> second = {{0.5, 1, 10, kTestSecond},
                                           {0.8, 3, 10, kTestSecond},
                                           {1.3, 7, 10, kTestSecond},
                                           {2.0, 9, 10, kTestSecond}};
  std::vector<AnswerCount> rows = second;
  rows.push_back({1.3, 1, 1, kTestFirst});
  const PsychometricFit fit =
      fit_psychometric(rows, {.reference = 1.0, .free_pse = true, .by_order = true});
  const PsychometricFit alone = fit_psychometric(second, {.reference = 1.0, .free_pse = true});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_DOUBLE_EQ(*fit.weber_fraction, *alone.weber_fraction);
  EXPECT_FALSE(fit.order_effect_ln);
  EXPECT_FALSE(fit.pse) << "that of one order alone";
  ASSERT_FALSE(fit.warnings.empty());
  EXPECT_NE(fit.warnings.back().find("with the test first every answer is the same"),
            std::string::npos);
  // At the reference, both orders together have one place on the axis, and the fit uses both.
  EXPECT_TRUE(fit_psychometric(rows, {.reference = 1.0, .by_order = true}).order_effect_ln);
  for (AnswerCount& row : rows) row.num_yes = row.num_trials;
  EXPECT_EQ(
      fit_psychometric(rows, {.reference = 1.0, .free_pse = true, .by_order = true}).status,
      FitStatus::kDegenerate);
}

TEST(IntervalOrderFit, AnOrderWithEveryAnswerAlikeIsFoundWhateverTheRounding) {
  // The levels of a staircase have all the digits with which they were drawn. Far from the
  // reference, the order's own part of the information is smaller than the rounding of the
  // rest.
  std::vector<AnswerCount> rows = {{12.24, 1, 3, kTestFirst},
                                   {13.612797239431485, 0, 1, kTestFirst},
                                   {13.708800000000002, 0, 1, kTestFirst},
                                   {15.246332908163263, 2, 6, kTestFirst},
                                   {15.3, 0, 1, kTestFirst},
                                   {15.353856000000004, 1, 2, kTestFirst},
                                   {17.075892857142858, 5, 7, kTestFirst},
                                   {17.28, 1, 1, kTestFirst},
                                   {19.125, 3, 3, kTestFirst},
                                   {21.6, 2, 2, kTestFirst}};
  for (const auto& [intensity, num] : {std::pair{12.24, 3},
                                       {13.612797239431485, 2},
                                       {13.708800000000002, 1},
                                       {13.824000000000003, 2},
                                       {15.246332908163263, 5},
                                       {17.075892857142858, 6},
                                       {17.28, 1},
                                       {19.125, 3}}) {
    rows.push_back({intensity, num, num, kTestSecond});
  }
  // The result must not depend on rounding, and so neither on the unit of the intensities nor
  // on the order of the rows.
  for (int turn = 0; turn < 200; ++turn) {
    const double unit = 1.0 + 0.01 * turn;
    std::vector<AnswerCount> scaled = rows;
    for (AnswerCount& row : scaled) row.intensity *= unit;
    const PsychometricFit fit = fit_psychometric(
        scaled,
        {.reference = 12.0 * unit, .free_pse = true, .by_order = true, .intervals = false});
    EXPECT_FALSE(fit.pse) << unit;
    EXPECT_FALSE(fit.order_effect_ln) << unit;
    ASSERT_FALSE(fit.warnings.empty()) << unit;
    EXPECT_NE(fit.warnings.back().find("with the test second every answer is the same"),
              std::string::npos);
  }
}

TEST(IntervalOrderFit, FewAnswersAreWarnedOfAsInOtherFits) {
  const auto has_warning = [](const PsychometricFit& fit) {
    return std::ranges::any_of(fit.warnings, [](const std::string& warning) {
      return warning.find("with a free pse and so few answers") != std::string::npos;
    });
  };
  std::vector<AnswerCount> rows = biased_answers();
  for (AnswerCount& row : rows) row.num_yes = std::min<std::int64_t>(row.num_yes, 5);
  for (AnswerCount& row : rows) row.num_trials = 7;
  EXPECT_TRUE(has_warning(
      fit_psychometric(rows, {.reference = 6.0, .free_pse = true, .by_order = true})));
}

TEST(IntervalOrderFit, WithoutAWeberFractionTheMeanOfBothOrdersIsTwoSteps) {
  // Each order has a step of one half, at exp(-0.3) and exp(0.3).
  EXPECT_EQ(mean_over_orders(1.0, 0.0, 0.6, 0.7), 0.0);
  EXPECT_EQ(mean_over_orders(1.0, 0.0, 0.6, 1.0), 0.5);
  EXPECT_EQ(mean_over_orders(1.0, 0.0, 0.6, 1.4), 1.0);
}

TEST(IntervalOrderFit, ABiasForAnIntervalLeavesTheWeberFractionAlone) {
  constexpr double kTrue = 0.25, kBias = 0.3;
  std::vector<AnswerCount> rows;
  for (const double order : {kTestFirst, kTestSecond}) {
    for (const double x : {0.5, 0.7, 0.85, 1.2, 1.5, 2.0}) {
      const double z = (std::log(x) - 2.0 * order * kBias) / std::log1p(kTrue);
      rows.push_back({x, std::llround(10000.0 * core::standard_normal_cdf(z)), 10000, order});
    }
  }
  const PsychometricFit apart =
      fit_psychometric(rows, {.reference = 1.0, .free_pse = true, .by_order = true});
  ASSERT_EQ(apart.status, FitStatus::kOk) << apart.reason;
  EXPECT_NEAR(*apart.weber_fraction, kTrue, 1e-3);
  EXPECT_NEAR(*apart.order_effect_ln, 2.0 * kBias, 1e-3);
  EXPECT_NEAR(*apart.pse, 1.0, 1e-3);
  // A fit that ignores the order finds a larger fraction.
  const PsychometricFit pooled = fit_psychometric(rows, {.reference = 1.0, .free_pse = true});
  EXPECT_GT(*pooled.weber_fraction, 1.4 * kTrue);
}

TEST(IntervalOrderFit, RowsOfOneOrderAreAnOrdinaryFit) {
  std::vector<AnswerCount> rows = biased_answers();
  rows.resize(4);
  const PsychometricFit apart =
      fit_psychometric(rows, {.reference = 6.0, .free_pse = true, .by_order = true});
  const PsychometricFit plain = fit_psychometric(rows, {.reference = 6.0, .free_pse = true});
  EXPECT_EQ(apart.weber_fraction, plain.weber_fraction);
  EXPECT_FALSE(apart.order_effect_ln);
}

TEST(IntervalOrderFit, AnswersOfTheCurveAreBorneAndOthersAreNot) {
  const PsychometricOptions options = {
      .reference = 6.0, .by_order = true, .diagnostics = true, .num_goodness = 200};
  const PsychometricFit good = fit_psychometric(biased_answers(), options);
  EXPECT_EQ(good.goodness.degrees_of_freedom, 6);
  EXPECT_GT(*good.goodness.p_value, 0.2);
  EXPECT_EQ(fit_psychometric(biased_answers(), options).goodness.p_value,
            good.goodness.p_value);
  std::vector<AnswerCount> strange = biased_answers();
  strange[3].num_yes = 0;
  const PsychometricFit bad = fit_psychometric(strange, options);
  ASSERT_EQ(bad.status, FitStatus::kOk);
  EXPECT_LT(*bad.goodness.p_value, 0.02);
}

TEST(IntervalOrderFit, WhatHasNoValueSaysWhy) {
  const auto reason = [](const std::vector<AnswerCount>& rows) {
    const PsychometricFit fit =
        fit_psychometric(rows, {.reference = 1.0, .free_pse = true, .by_order = true});
    EXPECT_EQ(fit.status, FitStatus::kDegenerate);
    EXPECT_FALSE(fit.weber_fraction);
    return fit.reason;
  };
  EXPECT_NE(reason({{0.5, 0, 5, kTestFirst},
                    {2.0, 5, 5, kTestFirst},
                    {0.5, 0, 5, kTestSecond},
                    {2.0, 5, 5, kTestSecond}})
                .find("separated"),
            std::string::npos);
  EXPECT_NE(reason({{0.5, 4, 5, kTestFirst},
                    {2.0, 1, 5, kTestFirst},
                    {0.5, 3, 5, kTestSecond},
                    {2.0, 2, 5, kTestSecond}})
                .find("inverted"),
            std::string::npos);
  EXPECT_NE(reason({{0.0, 1, 5, kTestFirst},
                    {2.0, 4, 5, kTestFirst},
                    {0.5, 1, 5, kTestSecond},
                    {2.0, 3, 5, kTestSecond}})
                .find("impossible"),
            std::string::npos);
}

TEST(IntervalOrderFit, TakesTheWeberCurveByMaximumLikelihoodAlone) {
  PsychometricOptions options = {.reference = 6.0, .by_order = true};
  options.method = PsychometricMethod::kLeastSquares;
  EXPECT_THROW((void)fit_psychometric(biased_answers(), options), core::Error);
  options.method = PsychometricMethod::kMaximumLikelihood;
  options.free_lapse = true;
  EXPECT_THROW((void)fit_psychometric(biased_answers(), options), core::Error);
}

}  // namespace interval_order_fit_test
}  // namespace jnd::analysis
