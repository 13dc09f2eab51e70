#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/fits/fit_json.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/psychometric_model.h"
#include "analysis/reference_values.h"
#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "support/reference_data.h"

// Tests curves between other ends than 0 and 1: guesses of forced choices, known lapses, and
// lapses of the upper end alone.

namespace jnd::analysis {
namespace forced_choice_test {

using nlohmann::json;
using testing::HasSubstr;

constexpr auto kLikelihood = PsychometricMethod::kMaximumLikelihood;
constexpr auto kLeastSquares = PsychometricMethod::kLeastSquares;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The reference was computed by SciPy with the script beside it.
const json& reference() {
  return test_support::reference_data("forced_choice/forced_choice.json");
}

PsychometricFit fit_of(const json& one, Solver solver = Solver::kCeres) {
  return fit_psychometric(
      reference_answers(one.at("data")),
      {.reference = one.at("reference"),
       .family = psychometric_family_named(one.at("family").get<std::string>()).value(),
       .free_pse = one.at("free_pse"),
       .free_lapse = one.at("free_lapse"),
       .guess_rate = one.at("guess_rate"),
       .lapse_rate = one.at("lapse_rate"),
       .symmetric_lapse = one.at("symmetric_lapse"),
       .solver = solver});
}

TEST(ForcedChoice, AgreesWithSciPy) {
  for (const json& one : reference().at("cases")) {
    const std::string name = one.at("name");
    const PsychometricFit fit = fit_of(one);
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << ": " << fit.reason;
    const json& expected = one.at("expected");
    expect_reference(fit.weber_fraction, expected.at("weber_fraction"), 1e-6, name + " w");
    expect_reference(fit.pse, expected.at("pse"), 1e-6, name + " pse");
    expect_reference(*fit.lapse_rate + 1.0, expected.at("lapse_rate").get<double>() + 1.0, 1e-7,
                     name + " lapse");
    expect_reference(fit.log_likelihood, expected.at("log_likelihood"), 1e-10, name + " ll");
    expect_reference(fit.deviance, expected.at("deviance"), 1e-8, name + " deviance");
    expect_reference(fit.standard_error, expected.at("standard_error"), 2e-5, name + " error");
    const json& ends = expected.at("weber_fraction_ci95");
    // SciPy searches no lower than w e^-4.
    if (!ends[0].is_null()) expect_reference(fit.weber_fraction_ci95.low, ends[0], 1e-5, name);
    expect_reference(fit.weber_fraction_ci95.high, ends[1], 1e-5, name + " high");
    ASSERT_EQ(fit.pse_ci95.has_value(), !expected.at("pse_ci95").is_null()) << name;
    if (!fit.pse_ci95) continue;
    expect_reference(fit.pse_ci95->low, expected.at("pse_ci95")[0], 1e-5, name + " pse low");
    expect_reference(fit.pse_ci95->high, expected.at("pse_ci95")[1], 1e-5, name + " pse high");
  }
}

TEST(ForcedChoice, BothSolversFindTheSameCurve) {
  for (const json& one : reference().at("cases")) {
    EXPECT_NEAR(*fit_of(one, Solver::kNewton).weber_fraction, *fit_of(one).weber_fraction, 1e-8)
        << one.at("name");
  }
}

TEST(ForcedChoice, TwoLevelsAreSolvedByHand) {
  // f = 0.5 + 0.5 F is 0.625 at 1 and 0.875 at 4, so F is 0.25 and 0.75, and the pse is 2.
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    const PsychometricFit found = fit_psychometric(
        {{1.0, 5, 8}, {4.0, 7, 8}},
        {.reference = 1.0, .method = method, .free_pse = true, .guess_rate = 0.5});
    ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
    EXPECT_NEAR(*found.pse, 2.0, 1e-9);
    EXPECT_NEAR(*found.weber_fraction, std::expm1(std::log(2.0) / 0.6744897501960817), 1e-8);
    EXPECT_NEAR(*found.deviance, 0.0, 1e-10);
  }
}

TEST(ForcedChoice, KnownLapsesOfOneLevelAreSolvedByHand) {
  // 0.02 + 0.96 F = 0.788 at twice the reference, so F = 0.8. With lapses of the upper end
  // alone, 0.95 F = 0.76.
  const PsychometricFit both = fit_psychometric(
      {{2.0, 788, 1000}}, {.reference = 1.0, .lapse_rate = 0.02, .symmetric_lapse = true});
  const PsychometricFit upper = fit_psychometric(
      {{2.0, 76, 100}}, {.reference = 1.0, .lapse_rate = 0.05, .symmetric_lapse = false});
  const double w = std::expm1(std::log(2.0) / 0.8416212335729143);
  EXPECT_NEAR(*both.weber_fraction, w, 1e-9);
  EXPECT_NEAR(*upper.weber_fraction, w, 1e-9);
  EXPECT_EQ(*both.lapse_rate, 0.02);
  EXPECT_EQ(*upper.lapse_rate, 0.05);
}

TEST(ForcedChoice, DerivativesAreThoseOfDifferences) {
  const std::vector<AnswerCount> data = {
      {0.0, 7, 20}, {0.5, 9, 20}, {0.9, 12, 20}, {1.4, 17, 20}, {3.0, 19, 20}};
  for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
    for (const bool symmetric : {false, true}) {
      for (const double guess : {0.0, 1.0 / 3.0}) {
        SCOPED_TRACE(testing::Message() << to_string(method) << symmetric << guess);
        std::vector<AnswerCount> rows = data;
        if (guess == 0.0 && !symmetric) rows.erase(rows.begin());
        const PsychometricLevels levels =
            pooled_levels(rows, 1.0, true, PsychometricFamily::kWeber, {guess, symmetric, 0.0});
        const PsychometricCurve at = {1.3, 0.2, 0.04};
        const PsychometricCost cost = psychometric_cost(levels, method, at);
        for (int parameter = 0; parameter < 3; ++parameter) {
          constexpr double kStep = 1e-6;
          const auto moved = [&](double step) {
            PsychometricCurve curve = at;
            (parameter == 0   ? curve.slope
             : parameter == 1 ? curve.offset
                              : curve.lapse) += step;
            return psychometric_cost(levels, method, curve);
          };
          const PsychometricCost above = moved(kStep), below = moved(-kStep);
          EXPECT_NEAR((above.value - below.value) / (2.0 * kStep), cost.gradient(parameter),
                      1e-6 * (1.0 + std::fabs(cost.gradient(parameter))));
          for (int other = 0; other < 3; ++other) {
            EXPECT_NEAR((above.gradient(other) - below.gradient(other)) / (2.0 * kStep),
                        cost.hessian(other, parameter),
                        1e-5 * (1.0 + std::fabs(cost.hessian(other, parameter))))
                << parameter << other;
          }
        }
      }
    }
  }
}

struct Ends {
  double guess;
  bool symmetric, free_lapse;
  double lapse;
};

/// Returns the misfit of a curve of the Weber family, with probabilities that this test
/// computes itself.
double misfit(const std::vector<AnswerCount>& data, const Ends& ends, PsychometricMethod method,
              double slope, double offset, double lapse) {
  double sum = 0.0;
  for (const AnswerCount& row : data) {
    const double cdf =
        0.5 * std::erfc(-(slope * std::log(row.intensity) + offset) / std::sqrt(2.0));
    const double low = ends.symmetric ? ends.guess + lapse : ends.guess;
    const double f = low + (1.0 - lapse - low) * cdf;
    const auto yes = static_cast<double>(row.num_yes);
    const auto no = static_cast<double>(row.num_trials) - yes;
    if (method == kLeastSquares) {
      sum += (f - yes / (yes + no)) * (f - yes / (yes + no));
      continue;
    }
    if (yes > 0.0) sum -= yes * std::log(f);
    if (no > 0.0) sum -= no * std::log1p(-f);
  }
  return sum;
}

/// Returns the lowest misfit over these slopes, with each level anywhere on the curve.
double lowest_at(const std::vector<double>& slopes, double z_step,
                 const std::vector<AnswerCount>& data, const Ends& ends,
                 PsychometricMethod method, bool free_pse) {
  double lowest = kInfinity;
  const double limit = ends.symmetric ? 0.5 * (1.0 - ends.guess) : 1.0 - ends.guess;
  for (const double slope : slopes) {
    std::vector<double> offsets = {0.0};
    for (std::size_t row = 0; free_pse && row < data.size(); ++row) {
      for (double z = -6.0; z <= 6.0; z += z_step) {
        offsets.push_back(z - slope * std::log(data[row].intensity));
      }
    }
    for (const double offset : offsets) {
      for (double lapse = ends.lapse; lapse < limit; lapse += 0.04 * limit) {
        lowest = std::min(lowest, misfit(data, ends, method, slope, offset, lapse));
        if (!ends.free_lapse) break;
      }
    }
  }
  return lowest;
}

std::vector<double> slopes_between(double first, double last) {
  std::vector<double> slopes;
  for (double slope = first; slope < last; slope *= 1.3) slopes.push_back(slope);
  return slopes;
}

TEST(ForcedChoice, NoCurveOfAFineScanIsBetterThanTheFitOrThanTheLimitWhereThereIsNone) {
  core::RandomStream random(8, "forced choice test");
  const std::vector<Ends> all = {{0.5, false, false, 0.0},      {0.5, false, false, 0.03},
                                 {1.0 / 3.0, false, true, 0.0}, {0.25, true, true, 0.0},
                                 {0.0, false, true, 0.0},       {0.0, true, false, 0.05}};
  const double intensities[] = {0.5, 0.8, 1.0, 1.3, 2.0, 3.0};
  int num_ok = 0, num_degenerate = 0;
  for (int set = 0; set < 16; ++set) {
    std::vector<AnswerCount> data;
    for (const double intensity : intensities) {
      if (!random.with_probability(0.75)) continue;
      AnswerCount row = {intensity, 0, static_cast<std::int64_t>(2 + random.below(8))};
      for (std::int64_t trial = 0; trial < row.num_trials; ++trial) {
        const double f = 0.4 + 0.6 * intensity / (1.0 + intensity);
        row.num_yes += random.with_probability(f) ? 1 : 0;
      }
      data.push_back(row);
    }
    if (data.size() < 2) continue;
    for (const Ends& ends : all) {
      for (const PsychometricMethod method : {kLikelihood, kLeastSquares}) {
        for (const bool free_pse : {false, true}) {
          SCOPED_TRACE(testing::Message() << "set " << set << " guess " << ends.guess << ' '
                                          << to_string(method) << free_pse);
          const PsychometricFit fit = fit_psychometric(data, {.reference = 1.0,
                                                              .method = method,
                                                              .free_pse = free_pse,
                                                              .free_lapse = ends.free_lapse,
                                                              .guess_rate = ends.guess,
                                                              .lapse_rate = ends.lapse,
                                                              .symmetric_lapse = ends.symmetric,
                                                              .intervals = false});
          ASSERT_NE(fit.status, FitStatus::kNotConverged);
          if (fit.reason.starts_with("too few") || fit.reason.starts_with("not identified") ||
              fit.reason.starts_with("one intensity")) {
            continue;
          }
          const double on_scan =
              lowest_at(slopes_between(0.02, 100.0), 0.4, data, ends, method, free_pse);
          if (fit.status == FitStatus::kOk) {
            ++num_ok;
            const double slope = 1.0 / std::log1p(*fit.weber_fraction);
            const double here =
                misfit(data, ends, method, slope, -slope * std::log(*fit.pse), *fit.lapse_rate);
            EXPECT_LE(here, on_scan + 1e-9);
          } else {
            ++num_degenerate;
            EXPECT_NE(fit.reason, "");
            const double far_off = lowest_at({1e-4, 1500.0}, 0.1, data, ends, method, free_pse);
            EXPECT_LE(far_off, on_scan + 0.02) << fit.reason;
          }
        }
      }
    }
  }
  EXPECT_GT(num_ok, 60);
  EXPECT_GT(num_degenerate, 40);
}

TEST(ForcedChoice, AnswersAtChanceHaveNoWeberFraction) {
  const PsychometricFit flat =
      fit_psychometric({{1.0, 9, 20}, {2.0, 10, 20}, {3.0, 9, 20}},
                       {.reference = 1.0, .free_pse = true, .guess_rate = 0.5});
  EXPECT_EQ(flat.status, FitStatus::kDegenerate);
  EXPECT_THAT(flat.reason, HasSubstr("flat"));
  const PsychometricFit step =
      fit_psychometric({{1.0, 10, 20}, {2.0, 10, 20}, {3.0, 20, 20}},
                       {.reference = 1.0, .free_pse = true, .guess_rate = 0.5});
  EXPECT_EQ(step.status, FitStatus::kDegenerate);
  EXPECT_THAT(step.reason, HasSubstr("separated"));
}

TEST(ForcedChoice, AYesAtIntensityZeroIsAGuess) {
  const std::vector<AnswerCount> data = {{0, 10, 20}, {1, 12, 20}, {2, 15, 20}, {4, 19, 20}};
  EXPECT_EQ(fit_psychometric(data, {.reference = 2.0, .guess_rate = 0.5}).status,
            FitStatus::kOk);
  const PsychometricFit without =
      fit_psychometric(data, {.reference = 2.0, .free_lapse = true, .symmetric_lapse = false});
  EXPECT_THAT(without.reason, HasSubstr("impossible"));
}

TEST(ForcedChoice, BootstrapAndGoodnessDrawFromTheCurveWithItsGuesses) {
  std::vector<AnswerCount> data;
  for (const double x : {0.5, 0.7, 0.9, 1.1, 1.4, 2.0}) {
    const double f =
        0.5 +
        0.5 * core::PsychometricFunction{.pse = 1.0, .weber_fraction = 0.4}.probability(x);
    data.push_back({x, std::lround(400 * f), 400});
  }
  const PsychometricFit fit = fit_psychometric(data, {.reference = 1.0,
                                                      .free_pse = true,
                                                      .guess_rate = 0.5,
                                                      .num_bootstrap = 400,
                                                      .diagnostics = true,
                                                      .num_goodness = 200,
                                                      .posterior = true});
  ASSERT_EQ(fit.status, FitStatus::kOk);
  EXPECT_NEAR(*fit.weber_fraction, 0.4, 0.01);
  const double low = *fit.weber_fraction_ci95.low, high = *fit.weber_fraction_ci95.high;
  EXPECT_NEAR(*fit.bootstrap.ci95.low, low, 0.15 * (high - low));
  EXPECT_NEAR(*fit.bootstrap.ci95.high, high, 0.15 * (high - low));
  EXPECT_NEAR(*fit.posterior.weber_fraction_ci95.low, low, 0.1 * (high - low));
  EXPECT_NEAR(*fit.posterior.weber_fraction_ci95.high, high, 0.1 * (high - low));
  EXPECT_GT(*fit.goodness.p_value, 0.5);
}

TEST(ForcedChoice, TheOutputTellsItsRates) {
  const json told =
      json::parse(to_json(fit_psychometric({{1.0, 6, 10}, {2.0, 8, 10}, {3.0, 10, 10}},
                                           {.reference = 1.0,
                                            .guess_rate = 0.5,
                                            .lapse_rate = 0.01,
                                            .symmetric_lapse = false}))
                      .dump());
  EXPECT_EQ(told.at("guess_rate"), 0.5);
  EXPECT_EQ(told.at("lapse_rate"), 0.01);
  EXPECT_EQ(told.at("lapses_at"), "upper end");
}

TEST(ForcedChoice, RatesOutOfRangeAreRefused) {
  const std::vector<AnswerCount> data = {{1.0, 6, 10}, {2.0, 8, 10}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double guess : {-0.1, 1.0, nan}) {
    EXPECT_THROW((void)fit_psychometric(data, {.reference = 1.0, .guess_rate = guess}),
                 core::Error);
  }
  EXPECT_THROW(
      (void)fit_psychometric(data, {.reference = 1.0, .guess_rate = 0.5, .lapse_rate = 0.25}),
      core::Error)
      << "at both ends";
  EXPECT_NO_THROW((void)fit_psychometric(
      data,
      {.reference = 1.0, .guess_rate = 0.5, .lapse_rate = 0.25, .symmetric_lapse = false}));
}

TEST(ForcedChoice, TheChanceIsWarnedOfOnlyWhereTheTaskIsNotKnown) {
  const json& demo = reference().at("cases")[0];
  const auto warnings = [&](double guess, bool unknown) {
    return fit_psychometric(reference_answers(demo.at("data")), {.reference = 0.004,
                                                                 .free_pse = true,
                                                                 .guess_rate = guess,
                                                                 .guess_unknown = unknown})
        .warnings;
  };
  EXPECT_THAT(warnings(0.0, true), testing::Contains(HasSubstr("--guess")));
  EXPECT_THAT(warnings(0.0, false), testing::Not(testing::Contains(HasSubstr("--guess"))));
  EXPECT_TRUE(warnings(0.5, false).empty());
}

}  // namespace forced_choice_test
}  // namespace jnd::analysis
