#include "analysis/fits/psychometric_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace psychometric_fit_test {

using testing::HasSubstr;
using testing::StartsWith;

constexpr auto kLikelihood = PsychometricMethod::kMaximumLikelihood;
constexpr auto kLeastSquares = PsychometricMethod::kLeastSquares;

const std::vector<double> kGroupD = {1.093, 1.237, 1.646, 1.7495, 1.853,
                                     2.203, 2.553, 3.185, 3.883};

std::vector<AnswerCount> simulated(const core::PsychometricFunction& truth,
                                   std::int64_t num_trials, std::uint64_t seed) {
  core::RandomStream random(seed, "fit test");
  std::vector<AnswerCount> data;
  for (const double intensity : kGroupD) {
    AnswerCount row = {intensity, 0, num_trials};
    for (std::int64_t trial = 0; trial < num_trials; ++trial) {
      row.num_yes += random.with_probability(truth.probability(intensity)) ? 1 : 0;
    }
    data.push_back(row);
  }
  return data;
}

PsychometricFit fit(const std::vector<AnswerCount>& data, double reference,
                    PsychometricMethod method = kLikelihood, bool free_pse = false,
                    bool free_lapse = false) {
  return fit_psychometric(data, {.reference = reference,
                                 .method = method,
                                 .free_pse = free_pse,
                                 .free_lapse = free_lapse});
}

TEST(PsychometricFit, OneLevelIsSolvedByHand) {
  // 8 of 10 at twice the reference: Phi(ln 2 / ln(1+w)) = 0.8, so ln(1+w) = ln 2 / 0.8416212.
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    const PsychometricFit found = fit({{2.0, 8, 10}}, 1.0, method);
    ASSERT_EQ(found.status, FitStatus::kOk);
    EXPECT_NEAR(*found.weber_fraction, std::exp(std::log(2.0) / 0.8416212335729143) - 1.0,
                1e-12);
    EXPECT_NEAR(*found.log_likelihood, 8.0 * std::log(0.8) + 2.0 * std::log(0.2), 1e-12);
    EXPECT_NEAR(*found.deviance, 0.0, 1e-12);
  }
}

TEST(PsychometricFit, TwoLevelsWithTheirPseAreSolvedByHand) {
  // Phi = 0.25 at 1 and 0.75 at 4, so the pse is 2 and z = ln 2 / ln(1+w) = 0.6744898.
  const PsychometricFit found = fit({{1.0, 2, 8}, {4.0, 6, 8}}, 1.0, kLikelihood, true);
  ASSERT_EQ(found.status, FitStatus::kOk);
  EXPECT_NEAR(*found.pse, 2.0, 1e-12);
  EXPECT_NEAR(*found.weber_fraction, std::exp(std::log(2.0) / 0.6744897501960817) - 1.0, 1e-11);
}

TEST(PsychometricFit, LikelihoodRatioIntervalOfOneLevelIsThatOfItsProportion) {
  // With one level, the interval of the curve is the interval of p, transformed.
  const PsychometricFit found = fit({{2.0, 8, 10}}, 1.0);
  const auto likelihood_at = [](double w) {
    const double p = core::standard_normal_cdf(std::log(2.0) / std::log1p(w));
    return 8.0 * std::log(p) + 2.0 * std::log(1.0 - p);
  };
  EXPECT_NEAR(*found.log_likelihood - likelihood_at(*found.weber_fraction_ci95.low),
              1.920729410347062, 1e-9);
  // p = 0.5, where w has no bound, is only 1.93 lower, which is just outside the interval.
  EXPECT_NEAR(*found.log_likelihood - 10.0 * std::log(0.5), 1.9274, 1e-4);
  ASSERT_TRUE(found.weber_fraction_ci95.high.has_value());
  EXPECT_NEAR(*found.log_likelihood - likelihood_at(*found.weber_fraction_ci95.high),
              1.920729410347062, 1e-9);
}

TEST(PsychometricFit, AnEndIsOpenWhereTheDataDoNotBoundTheWeberFraction) {
  const PsychometricFit found = fit({{2.0, 7, 10}}, 1.0);
  ASSERT_EQ(found.status, FitStatus::kOk);
  EXPECT_TRUE(found.weber_fraction_ci95.low.has_value());
  EXPECT_FALSE(found.weber_fraction_ci95.high.has_value());
}

TEST(PsychometricFit, RecoversTheTruthFromManyTrials) {
  const core::PsychometricFunction truth = {
      .pse = 2.1, .weber_fraction = 0.4, .lapse_rate = 0.03};
  const std::vector<AnswerCount> data = simulated(truth, 200'000, 3);
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    const PsychometricFit found = fit(data, 1.853, method, true, true);
    ASSERT_EQ(found.status, FitStatus::kOk);
    EXPECT_NEAR(*found.weber_fraction, 0.4, 0.02);
    EXPECT_NEAR(*found.pse, 2.1, 0.02);
    EXPECT_NEAR(*found.lapse_rate, 0.03, 0.01);
  }
}

TEST(PsychometricFit, DoesNotKnowTheUnitOfTheIntensities) {
  const std::vector<AnswerCount> data = simulated({1.9, 0.5, 0.0}, 8, 5);
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    for (const bool free_pse : {false, true}) {
      const PsychometricFit plain = fit(data, 1.853, method, free_pse);
      ASSERT_EQ(plain.status, FitStatus::kOk);
      for (const double factor : {1e-200, 1e-3, 7.0, 1e200}) {
        std::vector<AnswerCount> scaled = data;
        for (AnswerCount& row : scaled) row.intensity *= factor;
        const PsychometricFit found = fit(scaled, 1.853 * factor, method, free_pse);
        ASSERT_EQ(found.status, FitStatus::kOk) << factor;
        EXPECT_NEAR(*found.weber_fraction / *plain.weber_fraction, 1.0, 1e-9) << factor;
        EXPECT_NEAR(*found.pse / factor / *plain.pse, 1.0, 1e-9) << factor;
        EXPECT_NEAR(*found.weber_fraction_ci95.low / *plain.weber_fraction_ci95.low, 1.0, 1e-9);
      }
    }
  }
}

TEST(PsychometricFit, FindsAWeberFractionOfAMillionthAsWell) {
  std::vector<AnswerCount> data;
  for (const double step : {-2.0, -1.0, 1.0, 2.0}) {
    data.push_back({1.0 + step * 1e-6,
                    step < -1.5  ? 1
                    : step < 0   ? 3
                    : step < 1.5 ? 16
                                 : 19,
                    20});
  }
  const PsychometricFit found = fit(data, 1.0);
  ASSERT_EQ(found.status, FitStatus::kOk);
  EXPECT_NEAR(*found.weber_fraction, 1.15e-6, 0.2e-6);
}

TEST(PsychometricFit, SmallDifferencesKeepTheirAccuracyAtAnyReference) {
  // The intensities are exact in binary, so that only the fit's own rounding is tested.
  const auto at = [](double reference) {
    std::vector<AnswerCount> data;
    for (const int step : {-2, -1, 1, 3}) {
      data.push_back({reference * (1.0 + step * 0x1.0p-30), 2 + step + (step > 0 ? 1 : 0), 6});
    }
    return *fit(data, reference).weber_fraction;
  };
  EXPECT_NEAR(at(3.0) / at(1.0), 1.0, 1e-12);
  EXPECT_NEAR(at(17.0 * 1024.0) / at(1.0), 1.0, 1e-12);
}

TEST(PsychometricFit, EveryIntervalHoldsItsEstimate) {
  int num_fits = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<AnswerCount> data = simulated({1.853, 0.6, 0.02}, 5, 100 + seed);
    for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
      for (const bool free_pse : {false, true}) {
        for (const bool free_lapse : {false, true}) {
          const PsychometricFit found =
              fit_psychometric(data, {.reference = 1.853,
                                      .method = method,
                                      .free_pse = free_pse,
                                      .free_lapse = free_lapse,
                                      .num_bootstrap = free_pse && free_lapse ? 0 : 60});
          if (found.status != FitStatus::kOk) continue;
          ++num_fits;
          const double w = *found.weber_fraction;
          EXPECT_LE(found.weber_fraction_ci95.low.value_or(0.0), w);
          EXPECT_GE(found.weber_fraction_ci95.high.value_or(HUGE_VAL), w);
          EXPECT_LE(found.bootstrap.ci95.low.value_or(0.0), w);
          EXPECT_GE(found.bootstrap.ci95.high.value_or(HUGE_VAL), w);
          if (!free_pse) continue;
          EXPECT_LE(found.pse_ci95->low.value_or(0.0), *found.pse);
          EXPECT_GE(found.pse_ci95->high.value_or(HUGE_VAL), *found.pse);
        }
      }
    }
  }
  EXPECT_GT(num_fits, 350);
}

TEST(PsychometricFit, LikelihoodRatioIntervalsCoverTheTruthAsOftenAsTheySay) {
  int num_fits = 0, num_covered = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const PsychometricFit found = fit(simulated({1.853, 0.7, 0.0}, 5, 1000 + seed), 1.853);
    if (found.status != FitStatus::kOk) continue;
    ++num_fits;
    num_covered += found.weber_fraction_ci95.low.value_or(0.0) <= 0.7 &&
                   found.weber_fraction_ci95.high.value_or(HUGE_VAL) >= 0.7;
  }
  EXPECT_GT(num_fits, 1950);
  EXPECT_NEAR(static_cast<double>(num_covered) / num_fits, 0.95, 0.015);
}

TEST(PsychometricFit, RowsOfOneIntensityAreOneLevel) {
  const std::vector<AnswerCount> apart = {{1.2, 1, 3}, {0.8, 1, 4}, {1.2, 3, 4}, {1.5, 6, 7}};
  const std::vector<AnswerCount> pooled = {{0.8, 1, 4}, {1.2, 4, 7}, {1.5, 6, 7}, {9.0, 0, 0}};
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    const PsychometricFit one = fit(apart, 1.0, method), other = fit(pooled, 1.0, method);
    EXPECT_DOUBLE_EQ(*one.weber_fraction, *other.weber_fraction);
    EXPECT_DOUBLE_EQ(*one.deviance, *other.deviance);
    EXPECT_EQ(one.num_levels, 3);
  }
}

TEST(PsychometricFit, TheBoundLapseZeroIsAnOptimum) {
  const std::vector<AnswerCount> data = {{0.5, 0, 9}, {0.8, 3, 9}, {1.2, 6, 9}, {2.0, 9, 9}};
  const PsychometricFit bounded = fit(data, 1.0, kLikelihood, false, true);
  const PsychometricFit fixed = fit(data, 1.0);
  ASSERT_EQ(bounded.status, FitStatus::kOk);
  EXPECT_EQ(*bounded.lapse_rate, 0.0);
  EXPECT_DOUBLE_EQ(*bounded.weber_fraction, *fixed.weber_fraction);
  EXPECT_NEAR(*bounded.standard_error, *fixed.standard_error, 1e-12);
}

TEST(PsychometricFit, AllYesHasAnOptimumWhereTheLevelsReachBelowTheReference) {
  EXPECT_EQ(fit({{0.8, 5, 5}, {1.5, 5, 5}, {2, 5, 5}}, 1.0).status, FitStatus::kOk);
}

TEST(PsychometricFit, SaysWhichWayTheDataHaveNoOptimum) {
  const auto reason = [](const std::vector<AnswerCount>& data, bool free_pse = false,
                         bool free_lapse = false, PsychometricMethod method = kLikelihood) {
    const PsychometricFit found = fit(data, 1.0, method, free_pse, free_lapse);
    EXPECT_EQ(found.status, FitStatus::kDegenerate);
    EXPECT_FALSE(found.weber_fraction.has_value());
    EXPECT_FALSE(found.standard_error.has_value());
    return found.reason;
  };
  EXPECT_THAT(reason({}), StartsWith("too few rows"));
  EXPECT_THAT(reason({{2.0, 0, 0}}), StartsWith("too few rows"));
  EXPECT_THAT(reason({{1.0, 3, 5}}), StartsWith("one intensity"));
  EXPECT_THAT(reason({{0.5, 0, 5}, {2, 5, 5}}), StartsWith("separated"));
  EXPECT_TRUE(fit({{0.5, 0, 5}, {2, 5, 5}}, 1.0).is_separated);
  EXPECT_FALSE(fit({{0.5, 3, 6}, {2, 3, 6}}, 1.0).is_separated);
  EXPECT_THAT(reason({{0.5, 0, 5}, {1, 3, 5}, {2, 5, 5}}), StartsWith("separated"));
  EXPECT_THAT(reason({{0.5, 3, 6}, {2, 3, 6}}), StartsWith("flat"));
  EXPECT_THAT(reason({{0.5, 4, 6}, {2, 2, 6}}), StartsWith("inverted"));
  EXPECT_THAT(reason({{0, 1, 6}, {2, 5, 6}}), StartsWith("impossible"));
  EXPECT_THAT(reason({{0, 0, 5}, {1, 3, 5}}), StartsWith("one intensity"));
  EXPECT_THAT(reason({{0, 0, 5}, {2, 3, 5}}, true), StartsWith("one intensity"));
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    EXPECT_THAT(reason({{2, 5, 5}, {3, 5, 5}}, true, false, method), StartsWith("all alike"));
    EXPECT_THAT(reason({{2, 0, 5}, {3, 0, 5}}, true, false, method), StartsWith("all alike"));
    EXPECT_THAT(reason({{2, 5, 5}, {3, 5, 5}, {4, 5, 5}}, true, true, method),
                StartsWith("all alike"));
  }
  EXPECT_THAT(reason({{2, 3, 5}}, true), StartsWith("one intensity"));
  EXPECT_THAT(reason({{2, 0, 5}, {3, 2, 5}, {4, 5, 5}}, true), StartsWith("separated"));
  EXPECT_THAT(reason({{0.5, 1, 5}, {2, 4, 5}}, false, true), StartsWith("too few rows"));
  EXPECT_THAT(reason({{0.5, 1, 5}, {2, 4, 5}}, true, true), StartsWith("too few rows"));
  EXPECT_THAT(reason({{0.5, 0, 5}, {2, 5, 5}}, false, false, kLeastSquares),
              StartsWith("separated"));
  EXPECT_THAT(reason({{0.5, 4, 6}, {2, 2, 6}}, true, false, kLeastSquares),
              StartsWith("inverted"));
}

TEST(PsychometricFit, WhatOnlyEqualsItsLimitIsNoOptimum) {
  // The person inverts the question. With a lapse near 0.5, every step fits as well as any
  // slope, to the last digit.
  const PsychometricFit found =
      fit({{1.1, 17, 30}, {1.5, 10, 18}}, 1.0, kLeastSquares, false, true);
  EXPECT_EQ(found.status, FitStatus::kDegenerate) << *found.lapse_rate;
}

TEST(PsychometricFit, AShallowOptimumIsFoundAmongManySteps) {
  // The optimum is 1.1e-5 below the limits, into which every start on the steps between the
  // levels leads.
  const PsychometricFit found =
      fit({{0.8, 0, 1}, {1.1, 2, 3}, {1.5, 0, 1}}, 1.0, kLeastSquares, true, true);
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  EXPECT_GT(*found.weber_fraction, 100.0);
}

TEST(PsychometricFit, ProportionsAllAlikeHaveNoRSquared) {
  // Rounding makes the mean differ from the proportion itself.
  const PsychometricFit found =
      fit({{1.5, 7, 10}, {2.0, 7, 10}, {3.0, 7, 10}}, 1.0, kLeastSquares);
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  EXPECT_FALSE(found.r_squared.has_value()) << *found.r_squared;
}

TEST(PsychometricFit, AnAnswerRateThatHardlyRisesIsNotGivenAnInfiniteNumber) {
  const PsychometricFit found = fit({{0.5, 49'999, 100'000}, {2, 50'001, 100'000}}, 1.0);
  EXPECT_EQ(found.status, FitStatus::kDegenerate);
  EXPECT_THAT(found.reason, HasSubstr("range of numbers"));
}

TEST(PsychometricFit, LeastSquaresTakesTheLowerOfTwoMinima) {
  // Near levels have fine answers and far levels coarse ones, so sse has a steep and a shallow
  // minimum.
  const std::vector<AnswerCount> data = {
      {1.01, 19, 20}, {1.02, 20, 20}, {3.0, 13, 20}, {6.0, 14, 20}, {12.0, 15, 20}};
  const PsychometricFit found = fit(data, 1.0, kLeastSquares);
  ASSERT_EQ(found.status, FitStatus::kOk);
  const auto sse = [&](double w) {
    double sum = 0.0;
    for (const AnswerCount& row : data) {
      const double p = core::standard_normal_cdf(std::log(row.intensity) / std::log1p(w));
      const double residual = p - static_cast<double>(row.num_yes) / 20.0;
      sum += residual * residual;
    }
    return sum;
  };
  int num_minima = 0;
  double lowest = HUGE_VAL;
  for (double log_w = -9.0; log_w < 6.0; log_w += 0.01) {
    const double here = sse(std::exp(log_w));
    lowest = std::min(lowest, here);
    num_minima += here < sse(std::exp(log_w - 0.01)) && here < sse(std::exp(log_w + 0.01));
  }
  EXPECT_EQ(num_minima, 2);
  EXPECT_LE(sse(*found.weber_fraction), lowest);
}

TEST(PsychometricFit, RefusesDataThatAreNoCounts) {
  EXPECT_THROW((void)fit({{1.0, 2, 1}}, 1.0), core::Error);
  EXPECT_THROW((void)fit({{1.0, -1, 1}}, 1.0), core::Error);
  EXPECT_THROW((void)fit({{-1.0, 0, 1}}, 1.0), core::Error);
  EXPECT_THROW((void)fit({{std::nan(""), 0, 1}}, 1.0), core::Error);
  EXPECT_THROW((void)fit({{1.0, 0, 1}}, 0.0), core::Error);
  EXPECT_THROW((void)fit({{1.0, 0, 1}}, std::nan("")), core::Error);
}

TEST(PsychometricFit, OfEveryFamilyTheWeberFractionIsTheStepFromThePseOverThePse) {
  const std::vector<AnswerCount> data = {
      {2, 1, 20}, {3, 5, 20}, {4, 11, 20}, {5, 15, 20}, {6, 19, 20}};
  for (const PsychometricFamily family :
       {PsychometricFamily::kWeber, PsychometricFamily::kGauss, PsychometricFamily::kWeibull}) {
    // The reference is not the pse, and the fraction does not depend on it.
    for (const double reference : {2.5, 9.0}) {
      const PsychometricFit found =
          fit_psychometric(data, {.reference = reference, .family = family, .free_pse = true});
      ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
      const double x84 = *found.pse * (1.0 + *found.weber_fraction);
      double f = core::standard_normal_cdf(std::log(x84 / *found.pse) /
                                           std::log1p(*found.weber_fraction));
      if (family == PsychometricFamily::kGauss) {
        f = core::standard_normal_cdf((x84 - found.parameters[0].value) /
                                      found.parameters[1].value);
      } else if (family == PsychometricFamily::kWeibull) {
        f = -std::expm1(-std::pow(x84 / found.parameters[0].value, found.parameters[1].value));
      }
      EXPECT_NEAR(f, core::standard_normal_cdf(1.0), 1e-9) << traits_of(family).name;
    }
  }
}

TEST(PsychometricFit, AGaussianWhosePseIsNotAboveZeroHasNoWeberFraction) {
  const PsychometricFit found =
      fit_psychometric({{1, 12, 20}, {2, 14, 20}, {3, 15, 20}},
                       {.reference = 2.0, .family = PsychometricFamily::kGauss});
  // With 60, 70 and 75 %, the mean lies below the levels, and below 0.
  ASSERT_EQ(found.status, FitStatus::kOk);
  EXPECT_THAT(found.reason, HasSubstr("not above 0"));
  EXPECT_FALSE(found.weber_fraction || found.standard_error);
  EXPECT_FALSE(found.weber_fraction_ci95.low || found.weber_fraction_ci95.high);
  // The curve itself exists, wherever the unit has its zero.
  const PsychometricFit moved =
      fit_psychometric({{101, 12, 20}, {102, 14, 20}, {103, 15, 20}},
                       {.reference = 2.0, .family = PsychometricFamily::kGauss});
  EXPECT_LT(*found.pse, 0.0);
  EXPECT_NEAR(*found.pse, *moved.pse - 100.0, 1e-9);
  EXPECT_NEAR(found.parameters[0].value, *found.pse, 0.0);
  EXPECT_NEAR(found.parameters[1].value, moved.parameters[1].value, 1e-9);
  ASSERT_TRUE(found.pse_ci95 && moved.pse_ci95);
  EXPECT_EQ(found.pse_ci95->low.has_value(), moved.pse_ci95->low.has_value());
  ASSERT_TRUE(found.pse_ci95->high && moved.pse_ci95->high);
  EXPECT_NEAR(*found.pse_ci95->high, *moved.pse_ci95->high - 100.0, 1e-7);
}

TEST(PsychometricFit, AnswersAllAlikeAreNotCalledInverted) {
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    const PsychometricFit no = fit({{1, 0, 5}, {2, 0, 5}, {3, 0, 5}, {4, 0, 5}}, 2.0, method);
    EXPECT_EQ(no.status, FitStatus::kDegenerate);
    EXPECT_THAT(no.reason, StartsWith("all alike"));
  }
}

TEST(PsychometricFit, DoubtfulValuesCarryANote) {
  const auto notes = [](const std::vector<AnswerCount>& data) {
    const PsychometricFit found = fit(data, 2.0);
    EXPECT_EQ(found.status, FitStatus::kOk) << found.reason;
    std::string all;
    for (const std::string& warning : found.warnings) all += warning + "\n";
    return all;
  };
  const std::string yes = notes({{1, 5, 5}, {2, 5, 5}, {3, 5, 5}, {4, 5, 5}});
  EXPECT_THAT(yes, HasSubstr("every answer is the same"));
  EXPECT_THAT(yes, HasSubstr("beyond the stimuli"));
  // The deviance is 27 on 3 degrees of freedom.
  EXPECT_THAT(yes, HasSubstr("farther from the curve"));
  const std::string jumps = notes({{1, 0, 5}, {2, 5, 5}, {3, 0, 5}, {4, 5, 5}});
  EXPECT_THAT(jumps, HasSubstr("beyond the stimuli"));
  EXPECT_THAT(jumps, HasSubstr("farther from the curve"));
  EXPECT_EQ(notes({{1, 2, 20}, {2, 10, 20}, {3, 15, 20}, {4, 19, 20}}), "");
}

TEST(PsychometricFit, AFreePseWithFewAnswersALevelIsSaidToCoverLess) {
  const auto says_so = [](std::int64_t times, bool free_pse, bool intervals) {
    const PsychometricFit found = fit_psychometric(
        {{1, 1 * times, 5 * times}, {2, 2 * times, 5 * times}, {4, 4 * times, 5 * times}},
        {.reference = 2.0, .free_pse = free_pse, .intervals = intervals});
    return std::ranges::any_of(found.warnings, [](const std::string& warning) {
      return warning.find("93 % at five answers a level") != std::string::npos;
    });
  };
  EXPECT_TRUE(says_so(1, true, true));
  EXPECT_FALSE(says_so(1, false, true)) << "94 % and more there";
  EXPECT_FALSE(says_so(13, true, true));
  EXPECT_FALSE(says_so(1, true, false)) << "there is no interval to doubt";
}

TEST(PsychometricFit, WithAFixedPseTooFewLevelsAreToldOfSlopeAndLapseAlone) {
  const PsychometricFit found = fit({{2.0, 8, 10}}, 1.0, kLikelihood, false, true);
  EXPECT_EQ(found.reason,
            "too few rows: slope and lapse rate cannot be told apart with so few levels");
}

}  // namespace psychometric_fit_test
}  // namespace jnd::analysis
