#include "analysis/fits/curve_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/fits/curve_comparison.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/psychometric_refit.h"
#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace curve_fit_test {

/// Returns the expected answers of a curve, with so many trials that rounding does not matter.
std::vector<AnswerCount> expected_answers(const CurveModel& model, double location,
                                          double scale, double guess, double lapse) {
  CurveFit curve;
  curve.model = model;
  curve.location.value = location;
  curve.scale.value = scale;
  curve.guess_rate.value = guess;
  curve.lapse_rate.value = lapse;
  constexpr double kNumTrials = 1e9;
  std::vector<AnswerCount> rows;
  for (int i = 0; i <= 12; ++i) {
    const double x = model.is_logarithmic() ? 0.2 * std::exp(0.3 * i) : -3.0 + 0.5 * i;
    rows.push_back({x, static_cast<std::int64_t>(std::round(kNumTrials * curve.probability(x))),
                    static_cast<std::int64_t>(kNumTrials)});
  }
  return rows;
}

TEST(CurveFit, TwoLevelsOfALogisticCurveAreWorkedByHand) {
  // The logit of 1/4 is -ln 3 at -1, and that of 3/4 is ln 3 at 1.
  const std::vector<AnswerCount> rows = {{-1.0, 25, 100}, {1.0, 75, 100}};
  const CurveFit fit = fit_curve(
      rows, {.model = {.family = CurveFamily::kLogistic}, .at = {0.75}, .jnd_at = 0.75});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.location.value, 0.0, 1e-12);
  EXPECT_NEAR(*fit.scale.value, 1.0 / std::log(3.0), 1e-12);
  EXPECT_NEAR(*fit.thresholds[0].intensity.value, 1.0, 1e-12);
  EXPECT_NEAR(*fit.jnd.value, 1.0, 1e-12);
  // The slope is p (1 - p) / scale.
  EXPECT_NEAR(*fit.thresholds[0].slope.value, 0.1875 * std::log(3.0), 1e-12);
  const double log_likelihood = 2.0 * (25.0 * std::log(0.25) + 75.0 * std::log(0.75));
  EXPECT_NEAR(*fit.log_likelihood, log_likelihood, 1e-10);
  EXPECT_NEAR(*fit.deviance, 0.0, 1e-10);
  EXPECT_NEAR(*fit.aic, 4.0 - 2.0 * log_likelihood, 1e-10);
  EXPECT_NEAR(*fit.bic, 2.0 * std::log(200.0) - 2.0 * log_likelihood, 1e-10);
}

/// A refit of a forced choice that tends to a step has it where its likelihood is greatest, and
/// one that tends to a level line lies beyond the levels on the side of its rarer answers. R,
/// with a search of its own, finds percentiles of 2.83 and 4.00, and of 4.75 and infinity.
TEST(CurveFit, RefitsOfAForcedChoiceThatTendToAStepOrALineKeepTheirPlace) {
  const CurveOptions how = {.model = {.family = CurveFamily::kNormal, .guess_rate = 0.5},
                            .num_bootstrap = 1000};
  const std::vector<AnswerCount> steep = {{1.0, 10, 20}, {2.0, 11, 20}, {3.0, 12, 20},
                                          {4.0, 18, 20}, {5.0, 20, 20}, {6.0, 20, 20}};
  const CurveFit fit = fit_curve(steep, how);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_GT(fit.num_bootstrap_degenerate, 300);
  EXPECT_NEAR(fit.pse.bootstrap_ci95.low.value_or(0.0), 2.83, 0.1);
  EXPECT_NEAR(fit.pse.bootstrap_ci95.high.value_or(0.0), 4.0, 0.1);

  const std::vector<AnswerCount> flat = {{1.0, 10, 20}, {2.0, 10, 20}, {3.0, 11, 20},
                                         {4.0, 12, 20}, {5.0, 13, 20}, {6.0, 15, 20}};
  const CurveFit near_chance = fit_curve(flat, how);
  ASSERT_EQ(near_chance.status, FitStatus::kOk) << near_chance.reason;
  EXPECT_NEAR(near_chance.pse.bootstrap_ci95.low.value_or(0.0), 4.75, 0.3);
  EXPECT_FALSE(near_chance.pse.bootstrap_ci95.high.has_value());

  // The mirror image of a curve that falls.
  std::vector<AnswerCount> mirrored = flat;
  for (AnswerCount& row : mirrored) row.intensity = -row.intensity;
  CurveOptions falling = how;
  falling.model.falling = true;
  const CurveFit mirror = fit_curve(mirrored, falling);
  ASSERT_EQ(mirror.status, FitStatus::kOk) << mirror.reason;
  EXPECT_FALSE(mirror.pse.bootstrap_ci95.low.has_value());
  EXPECT_NEAR(mirror.pse.bootstrap_ci95.high.value_or(0.0), -4.75, 0.3);
}

/// A curve with three parameters passes through three levels, so that no answers could lie
/// farther from it.
/// A threshold of a level line lies above the stimuli if the curve has more yes at it than the
/// line, and below them otherwise. 12 of 20 say yes at both levels or nearly so.
TEST(CurveFit, LevelRefitsLieOnTheSideOfEachThreshold) {
  const CurveFit fit = fit_curve(
      {{1.0, 11, 20}, {2.0, 13, 20}},
      {.model = {.family = CurveFamily::kNormal}, .at = {0.1, 0.9}, .num_bootstrap = 400});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_FALSE(fit.thresholds[0].intensity.bootstrap_ci95.low) << "0.1 is rarer than 0.6";
  EXPECT_FALSE(fit.thresholds[1].intensity.bootstrap_ci95.high) << "0.9 is more than 0.6";
  EXPECT_TRUE(fit.thresholds[0].intensity.bootstrap_ci95.high);
  EXPECT_TRUE(fit.thresholds[1].intensity.bootstrap_ci95.low);
}

TEST(CurveFit, AFreeGuessRateTakesADegreeOfFreedom) {
  const CurveFit fit = fit_curve(
      {{1.0, 4, 40}, {2.0, 15, 40}, {3.0, 36, 40}},
      {.model = {.family = CurveFamily::kNormal, .free_guess = true}, .num_goodness = 100});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  ASSERT_GT(*fit.guess_rate.value, 0.0);
  EXPECT_FALSE(fit.goodness_p_value);
  EXPECT_FALSE(fit.overdispersion);
  EXPECT_NE(fit.goodness_reason.find("no degree of freedom"), std::string::npos);
}

/// R has 0.6442 for the sum of squared residuals of all six levels, of which three degrees of
/// freedom are left.
TEST(CurveFit, AnswersAtIntensityZeroCountInTheirScatter) {
  const CurveFit fit = fit_curve(
      {{0.0, 5, 20}, {1.0, 4, 20}, {2.0, 7, 20}, {4.0, 11, 20}, {8.0, 18, 20}, {16.0, 20, 20}},
      {.model = {.family = CurveFamily::kNormal, .log_axis = true, .free_guess = true}});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.overdispersion, 0.6442 / 3.0, 1e-4);
}

/// At a rate of 0 an answer at intensity 0 would be impossible. R's profile of the falling
/// curve ends at 0.0062 and 0.3284.
TEST(CurveFit, ARateThatAnAnswerAtIntensityZeroNeedsHasALowEndAbove0) {
  const CurveFit rising = fit_curve(
      {{0.0, 1, 10}, {1.0, 2, 10}, {2.0, 4, 10}, {4.0, 7, 10}, {8.0, 9, 10}},
      {.model = {.family = CurveFamily::kNormal, .log_axis = true, .free_guess = true}});
  ASSERT_EQ(rising.status, FitStatus::kOk) << rising.reason;
  EXPECT_GT(rising.guess_rate.ci95.low.value_or(-1.0), 0.0);
  EXPECT_LT(rising.guess_rate.ci95.low.value_or(1.0), *rising.guess_rate.value);
  const CurveFit falling =
      fit_curve({{0.0, 9, 10}, {1.0, 8, 10}, {2.0, 6, 10}, {4.0, 3, 10}, {8.0, 1, 10}},
                {.model = {.family = CurveFamily::kNormal,
                           .log_axis = true,
                           .guess_rate = 0.02,
                           .free_lapse = true,
                           .falling = true}});
  ASSERT_EQ(falling.status, FitStatus::kOk) << falling.reason;
  EXPECT_NEAR(falling.lapse_rate.ci95.low.value_or(-1.0), 0.0062, 1e-4);
  EXPECT_NEAR(falling.lapse_rate.ci95.high.value_or(-1.0), 0.3284, 1e-4);
}

TEST(CurveFit, TwoLevelsOfEachFamilyGiveLocationAndScaleOfItsFormula) {
  // F is computed at location 0.4 and scale 0.8, for x = 0 and 1, by each formula of the help.
  const double low = -0.5, high = 0.75;  // (x - location) / scale
  struct Case {
    CurveFamily family;
    double at_low, at_high;
  };
  const auto phi = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
  const auto secant = [](double z) { return 2.0 / M_PI * std::atan(std::exp(0.5 * M_PI * z)); };
  for (const Case& one :
       {Case{CurveFamily::kNormal, phi(low), phi(high)},
        {CurveFamily::kLogistic, 1.0 / (1.0 + std::exp(-low)), 1.0 / (1.0 + std::exp(-high))},
        {CurveFamily::kGumbel, 1.0 - std::exp(-std::exp(low)), 1.0 - std::exp(-std::exp(high))},
        {CurveFamily::kReversedGumbel, std::exp(-std::exp(-low)), std::exp(-std::exp(-high))},
        {CurveFamily::kHyperbolicSecant, secant(low), secant(high)}}) {
    constexpr double kNum = 1e9;
    const std::vector<AnswerCount> rows = {
        {0.0, static_cast<std::int64_t>(kNum * one.at_low), static_cast<std::int64_t>(kNum)},
        {1.0, static_cast<std::int64_t>(kNum * one.at_high), static_cast<std::int64_t>(kNum)}};
    const CurveFit fit = fit_curve(rows, {.model = {.family = one.family}, .intervals = false});
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    EXPECT_NEAR(*fit.location.value, 0.4, 1e-7) << traits_of(one.family).name;
    EXPECT_NEAR(*fit.scale.value, 0.8, 1e-7) << traits_of(one.family).name;
    EXPECT_NEAR(fit.probability(1.0), one.at_high, 1e-7) << traits_of(one.family).name;
  }
}

TEST(CurveFit, EveryModelFindsTheCurveThatTheAnswersAreOf) {
  for (const CurveFamilyTraits& family : curve_families()) {
    for (const bool falling : {false, true}) {
      for (const bool free_guess : {false, true}) {
        for (const bool free_lapse : {false, true}) {
          const CurveModel model = {.family = family.family,
                                    .guess_rate = 0.25,
                                    .lapse_rate = 0.0,
                                    .free_guess = free_guess,
                                    .free_lapse = free_lapse,
                                    .falling = falling};
          const double guess = free_guess ? 0.11 : 0.25, lapse = free_lapse ? 0.04 : 0.0;
          const double location = model.is_logarithmic() ? 1.3 : 0.2;
          const double scale = model.family == CurveFamily::kWeibull ? 2.1 : 0.7;
          const CurveFit fit = fit_curve(expected_answers(model, location, scale, guess, lapse),
                                         {.model = model, .intervals = false});
          ASSERT_EQ(fit.status, FitStatus::kOk) << family.name << fit.reason;
          EXPECT_NEAR(*fit.location.value, location, 1e-5) << family.name << falling;
          EXPECT_NEAR(*fit.scale.value, scale, 1e-5) << family.name << falling;
          EXPECT_NEAR(*fit.guess_rate.value, guess, 1e-6) << family.name << falling;
          EXPECT_NEAR(*fit.lapse_rate.value, lapse, 1e-6) << family.name << falling;
        }
      }
    }
  }
}

TEST(CurveFit, ThresholdsAreAtLevelsOfTheCurveBetweenItsEnds) {
  const CurveModel model = {.family = CurveFamily::kNormal, .guess_rate = 0.5};
  const CurveFit fit = fit_curve(expected_answers(model, 0.2, 0.7, 0.5, 0.0),
                                 {.model = model, .at = {0.75, 0.5}});
  ASSERT_EQ(fit.status, FitStatus::kOk);
  EXPECT_NEAR(fit.thresholds[0].proportion, 0.875, 1e-12);
  EXPECT_NEAR(*fit.thresholds[0].intensity.value, 0.2 + 0.7 * 0.6744897501960817, 1e-5);
  EXPECT_NEAR(fit.probability(*fit.thresholds[0].intensity.value), 0.875, 1e-9);
  EXPECT_NEAR(*fit.thresholds[1].intensity.value, *fit.pse.value, 1e-12);
  EXPECT_NEAR(*fit.jnd.value, 0.7, 1e-5);
}

TEST(CurveFit, AFallingCurveIsTheRisingOneOfTheMirroredAxis) {
  const std::vector<AnswerCount> rows = {{-2, 28, 30}, {-1, 25, 30}, {0, 17, 30},
                                         {1, 8, 30},   {2, 3, 30},   {3, 2, 30}};
  std::vector<AnswerCount> mirrored = rows;
  for (AnswerCount& row : mirrored) row.intensity = -row.intensity;
  const CurveModel rising = {.family = CurveFamily::kLogistic, .free_lapse = true};
  CurveModel falling = rising;
  falling.falling = true;
  const CurveFit fit = fit_curve(rows, {.model = falling, .at = {0.75}});
  const CurveFit other = fit_curve(mirrored, {.model = rising, .at = {0.75}});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  ASSERT_EQ(other.status, FitStatus::kOk) << other.reason;
  EXPECT_NEAR(*fit.log_likelihood, *other.log_likelihood, 1e-9);
  EXPECT_NEAR(*fit.lapse_rate.value, *other.lapse_rate.value, 1e-8);
  const CurveThreshold &one = fit.thresholds[0], &mirror = other.thresholds[0];
  EXPECT_NEAR(*one.intensity.value, -*mirror.intensity.value, 1e-7);
  EXPECT_NEAR(*one.intensity.ci95.low, -*mirror.intensity.ci95.high, 1e-5);
  EXPECT_NEAR(*one.slope.value, -*mirror.slope.value, 1e-7);
  EXPECT_NEAR(*one.slope.ci95.low, -*mirror.slope.ci95.high, 1e-4);
  EXPECT_TRUE(answers_fall({rows}));
  EXPECT_FALSE(answers_fall({mirrored}));
}

const std::vector<AnswerCount> kSix = {{1.0, 2, 30},  {1.5, 6, 30},  {2.0, 13, 30},
                                       {2.5, 21, 30}, {3.0, 26, 30}, {4.0, 29, 30}};

TEST(CurveFit, IntervalsOfANormalCurveAreThoseOfTheWeberFit) {
  const CurveFit fit = fit_curve(kSix, {.model = {.family = CurveFamily::kNormal}});
  const PsychometricFit weber =
      fit_psychometric(kSix, {.reference = 2.0, .family = PsychometricFamily::kGauss});
  ASSERT_EQ(fit.status, FitStatus::kOk);
  EXPECT_NEAR(*fit.pse.value, *weber.pse, 1e-9);
  EXPECT_NEAR(*fit.pse.ci95.low, *weber.pse_ci95->low, 1e-7);
  EXPECT_NEAR(*fit.pse.ci95.high, *weber.pse_ci95->high, 1e-7);
  EXPECT_NEAR(*fit.location.ci95.low, *fit.pse.ci95.low, 1e-9);
  EXPECT_NEAR(*fit.jnd.ci95.low, *fit.scale.ci95.low, 1e-9);
  const PsychometricFit weibull =
      fit_psychometric(kSix, {.reference = 2.0, .family = PsychometricFamily::kWeibull});
  const CurveFit own = fit_curve(kSix, {.model = {.family = CurveFamily::kWeibull}});
  EXPECT_NEAR(*own.location.value, weibull.parameters[0].value, 1e-8);
  EXPECT_NEAR(*own.scale.value, weibull.parameters[1].value, 1e-8);
}

/// Returns minus the log-likelihood of a curve over ln x with this JND, minimised over its PSE.
double least_cost_at_jnd(const std::vector<AnswerCount>& rows, double jnd) {
  const auto cost = [&](double pse) {
    const double scale = std::log1p(jnd / pse);
    double sum = 0.0;
    for (const AnswerCount& row : rows) {
      const double z = (std::log(row.intensity) - std::log(pse)) / scale;
      sum -= static_cast<double>(row.num_yes) * std::log(0.5 * std::erfc(-z / std::sqrt(2.0)));
      sum -= static_cast<double>(row.num_trials - row.num_yes) *
             std::log(0.5 * std::erfc(z / std::sqrt(2.0)));
    }
    return sum;
  };
  double low = 1.0, high = 4.0;
  for (int i = 0; i < 200; ++i) {
    const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
    (cost(a) < cost(b) ? high : low) = cost(a) < cost(b) ? b : a;
  }
  return cost(0.5 * (low + high));
}

TEST(CurveFit, TheJndOfALogarithmicAxisHasTheIntervalOfItsProfile) {
  const CurveFit fit =
      fit_curve(kSix, {.model = {.family = CurveFamily::kNormal, .log_axis = true}});
  ASSERT_EQ(fit.status, FitStatus::kOk);
  const double least = -*fit.log_likelihood;
  EXPECT_NEAR(least_cost_at_jnd(kSix, *fit.jnd.value), least, 1e-8);
  for (const auto& end : {fit.jnd.ci95.low, fit.jnd.ci95.high}) {
    ASSERT_TRUE(end.has_value());
    EXPECT_NEAR(least_cost_at_jnd(kSix, *end) - least, 1.9207294103470617, 1e-4);
  }
  // At level 0.84 the threshold is one JND above the PSE.
  EXPECT_NEAR(*fit.pse.value * std::exp(*fit.scale.value) - *fit.pse.value, *fit.jnd.value,
              1e-9);
}

TEST(CurveFit, BootstrapAndPosteriorAreNearTheLikelihoodRatio) {
  std::vector<AnswerCount> many = kSix;
  for (AnswerCount& row : many) {
    row.num_yes *= 10;
    row.num_trials *= 10;
  }
  const CurveFit fit = fit_curve(
      many, {.model = {.family = CurveFamily::kLogistic, .guess_rate = 0.0, .free_lapse = true},
             .at = {0.75},
             .num_bootstrap = 1000,
             .posterior = true});
  ASSERT_EQ(fit.status, FitStatus::kOk);
  for (const CurveValue* value : {&fit.pse, &fit.thresholds[0].intensity, &fit.location}) {
    const double width = *value->ci95.high - *value->ci95.low;
    for (const Interval& other :
         {value->bootstrap_ci95, value->bca_ci95, value->posterior_ci95}) {
      ASSERT_TRUE(other.low && other.high);
      EXPECT_NEAR(*other.low, *value->ci95.low, 0.25 * width);
      EXPECT_NEAR(*other.high, *value->ci95.high, 0.25 * width);
    }
    EXPECT_NEAR(*value->posterior_median, *value->value, 0.25 * width);
  }
}

TEST(CurveFit, AnswersWithoutACurveSayWhy) {
  const std::vector<AnswerCount> step = {{1, 0, 10}, {2, 0, 10}, {3, 10, 10}};
  const CurveFit separated = fit_curve(step, {});
  EXPECT_EQ(separated.status, FitStatus::kDegenerate);
  EXPECT_NE(separated.reason.find("separated"), std::string::npos);
  EXPECT_FALSE(separated.location.value.has_value());
  const std::vector<AnswerCount> flat = {{1, 5, 10}, {2, 5, 10}, {3, 5, 10}};
  EXPECT_NE(fit_curve(flat, {}).reason.find("flat"), std::string::npos);
  EXPECT_EQ(fit_curve({}, {}).status, FitStatus::kDegenerate);
  EXPECT_NE(fit_curve({{1, 5, 10}, {2, 6, 10}, {3, 9, 10}},
                      {.model = {.free_guess = true, .free_lapse = true}})
                .reason.find("too few"),
            std::string::npos);
  EXPECT_THROW((void)fit_curve(flat, {.model = {.free_guess = true, .symmetric = true}}),
               core::Error);
  EXPECT_THROW((void)fit_curve({{-1, 5, 10}}, {.model = {.log_axis = true}}), core::Error);
  EXPECT_THROW((void)fit_curve(flat, {.at = {1.0}}), core::Error);
}

TEST(CurveFit, AThresholdOfAProportionIsWorkedByHandWhereRatesAreFree) {
  // The curve is 0.2 + 0.7 S. S is 0.5 at 0.55, and 0.75, a logit of ln 3, at 0.725.
  for (const bool falling : {false, true}) {
    const CurveModel model = {.family = CurveFamily::kLogistic,
                              .free_guess = true,
                              .free_lapse = true,
                              .falling = falling};
    const CurveFit fit = fit_curve(
        expected_answers(model, 0.25, 0.5, 0.2, 0.1),
        {.model = model, .at = {}, .at_proportion = {0.55, 0.725}, .num_bootstrap = 60});
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    ASSERT_EQ(fit.thresholds.size(), 2U);
    EXPECT_NEAR(fit.thresholds[0].at, 0.5, 1e-5);
    EXPECT_NEAR(*fit.thresholds[0].intensity.value, 0.25, 1e-5);
    const double sign = falling ? -1.0 : 1.0;
    EXPECT_NEAR(*fit.thresholds[0].slope.value, sign * 0.7 * 0.25 / 0.5, 1e-5);
    EXPECT_NEAR(fit.thresholds[1].at, 0.75, 1e-5);
    EXPECT_NEAR(*fit.thresholds[1].intensity.value, 0.25 + sign * 0.5 * std::log(3.0), 1e-5);
    EXPECT_NEAR(*fit.thresholds[1].slope.value, sign * 0.7 * 0.1875 / 0.5, 1e-5);
    EXPECT_LT(*fit.thresholds[1].slope.ci95.low, *fit.thresholds[1].slope.value);
    EXPECT_GT(*fit.thresholds[1].slope.ci95.high, *fit.thresholds[1].slope.value);
    EXPECT_NEAR(*fit.thresholds[1].intensity.bootstrap_ci95.low,
                *fit.thresholds[1].intensity.ci95.low, 1e-3);
  }
}

TEST(CurveFit, AThresholdOfAProportionHasTheIntervalOfItsLikelihood) {
  const CurveModel model = {
      .family = CurveFamily::kLogistic, .guess_rate = 0.5, .free_lapse = true};
  const std::vector<AnswerCount> rows = {{-2, 21, 40}, {-1, 24, 40}, {0, 30, 40},
                                         {1, 35, 40},  {2, 37, 40},  {3, 38, 40}};
  const CurveFit fit = fit_curve(rows, {.model = model, .at = {}, .at_proportion = {0.75}});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const CurveThreshold& threshold = fit.thresholds.at(0);
  const auto log_likelihood = [&](double at, double scale, double lapse) {
    const double level = 0.25 / (0.5 - lapse), z = std::log(level / (1.0 - level));
    double sum = 0.0;
    for (const AnswerCount& row : rows) {
      const double f = 1.0 / (1.0 + std::exp(-(z + (row.intensity - at) / scale)));
      const double p = 0.5 + (0.5 - lapse) * f;
      sum += static_cast<double>(row.num_yes) * std::log(p) +
             static_cast<double>(row.num_trials - row.num_yes) * std::log1p(-p);
    }
    return sum;
  };
  const auto best_at = [&](double at) {
    double best = -1e9;
    for (double lapse = 0.0; lapse < 0.24; lapse += 0.0005) {
      for (double scale = 0.05; scale < 6.0; scale *= 1.02) {
        best = std::max(best, log_likelihood(at, scale, lapse));
      }
    }
    return best;
  };
  EXPECT_NEAR(best_at(*threshold.intensity.value), *fit.log_likelihood, 2e-3);
  // The ends lie half the 95 % quantile of chi-squared below the maximum.
  EXPECT_NEAR(best_at(*threshold.intensity.ci95.low), *fit.log_likelihood - 1.9207, 4e-3);
  EXPECT_NEAR(best_at(*threshold.intensity.ci95.high), *fit.log_likelihood - 1.9207, 4e-3);
}

TEST(CurveFit, AProportionThatTheCurveNeverHasHasNoThreshold) {
  const CurveModel model = {
      .family = CurveFamily::kLogistic, .free_guess = true, .free_lapse = true};
  for (const bool log_axis : {false, true}) {
    CurveModel its = model;
    its.log_axis = log_axis;
    const CurveFit fit = fit_curve(expected_answers(its, log_axis ? 0.6 : 0.0, 0.5, 0.2, 0.1),
                                   {.model = its, .at = {}, .at_proportion = {0.1, 0.95}});
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    for (const CurveThreshold& one : fit.thresholds) {
      EXPECT_FALSE(one.intensity.value.has_value());
      EXPECT_FALSE(one.intensity.ci95.low || one.intensity.ci95.high);
      EXPECT_FALSE(one.slope.value.has_value());
    }
    ASSERT_EQ(fit.warnings.size(), 2U);
    EXPECT_EQ(fit.warnings[0],
              "no threshold at a proportion of 0.1: the fitted curve runs from 0.2 to 0.9 and "
              "never has that");
  }
}

TEST(CurveFit, ManyLevelsAreFittedAsTheyAre) {
  core::RandomStream random(7, "many levels");
  std::vector<AnswerCount> rows;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-2.0, 2.0);
    const double p = 0.5 * std::erfc(-(x - 0.3) / 0.8 / std::sqrt(2.0));
    rows.push_back({x, random.with_probability(p) ? 1 : 0, 1});
  }
  const CurveFit fit = fit_curve(rows, {});
  ASSERT_EQ(fit.status, FitStatus::kOk);
  EXPECT_EQ(fit.num_levels, 20000);
  EXPECT_NEAR(*fit.location.value, 0.3, 0.03);
  EXPECT_NEAR(*fit.scale.value, 0.8, 0.03);
  EXPECT_LT(*fit.location.ci95.low, *fit.location.value);
  EXPECT_GT(*fit.location.ci95.high, *fit.location.value);
  EXPECT_LE(fit.points.size(), 201U);
  // The optimum is that of all levels, not that of the bins.
  const FoundCurve found = found_curve(rows, {});
  EXPECT_LT(found.found.optimum.cost.gradient.head<2>().cwiseAbs().maxCoeff(), 1e-6);
}

TEST(PsychometricRefit, FindsWhatTheWholeSearchFinds) {
  core::RandomStream random(3, "refits");
  int num_worse = 0, num_compared = 0;
  for (const bool free_guess : {false, true}) {
    const CurveModel model = {.family = CurveFamily::kLogistic,
                              .guess_rate = 0.5,
                              .free_guess = free_guess,
                              .free_lapse = true};
    const std::vector<AnswerCount> rows = {{-2, 11, 20},  {-1, 12, 20}, {-0.3, 13, 20},
                                           {0.3, 16, 20}, {1, 18, 20},  {2, 19, 20}};
    const FoundCurve fit = found_curve(rows, model);
    ASSERT_EQ(fit.found.supremum, PsychometricSupremum::kAttained);
    const PsychometricSearch search(fit.levels, PsychometricMethod::kMaximumLikelihood, true,
                                    true);
    const PsychometricRefit refit(search, fit.levels, fit.found.optimum.curve);
    PsychometricLevels redrawn = fit.levels;
    for (int draw = 0; draw < 150; ++draw) {
      for (std::size_t i = 0; i < redrawn.size(); ++i) {
        double yes = 0.0;
        for (int trial = 0; trial < 20; ++trial) {
          yes += random.with_probability(fit.found.optimum.curve.probability(fit.levels, i))
                     ? 1.0
                     : 0.0;
        }
        redrawn.num_yes[i] = yes;
      }
      const auto whole = search.find(redrawn, minimised_by_newton);
      const auto quick = refit.find(redrawn);
      if (whole.supremum != PsychometricSupremum::kAttained) continue;
      ++num_compared;
      const bool same = quick.supremum == PsychometricSupremum::kAttained &&
                        quick.optimum.cost.value <= whole.optimum.cost.value + 1e-7;
      if (!same) ++num_worse;
    }
  }
  EXPECT_GT(num_compared, 100);
  EXPECT_LE(num_worse, num_compared / 50);
}

TEST(CurveComparison, FindsWhichParameterDiffers) {
  const CurveModel model = {.family = CurveFamily::kNormal};
  const auto rows_at = [&](double location, double scale) {
    std::vector<AnswerCount> rows = expected_answers(model, location, scale, 0.0, 0.0);
    for (AnswerCount& row : rows) {
      row.num_yes =
          static_cast<std::int64_t>(std::round(static_cast<double>(row.num_yes) / 1e7));
      row.num_trials = 100;
    }
    return rows;
  };
  const CurveComparison found = compare_curves(
      {{"a", rows_at(0.0, 0.6)}, {"b", rows_at(0.5, 0.6)}}, {.model = model, .at = {0.5}});
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  ASSERT_EQ(found.models.size(), 4U);
  ASSERT_EQ(found.tests.size(), 3U);
  EXPECT_EQ(found.best_by_bic, "different location, same scale");
  for (const ComparisonTest& test : found.tests) {
    if (test.name == "scale") {
      EXPECT_GT(test.p_value, 0.5);
      EXPECT_EQ(test.degrees_of_freedom, 1);
    } else {
      EXPECT_LT(test.p_value, 1e-6) << test.name;
    }
  }
  ASSERT_EQ(found.contrasts.size(), 1U);
  const CurveContrast& contrast = found.contrasts[0];
  EXPECT_NEAR(*contrast.difference.value, 0.5, 0.02);
  EXPECT_LT(*contrast.difference.ci95.low, 0.5);
  EXPECT_GT(*contrast.difference.ci95.high, 0.5);
  EXPECT_LT(*contrast.p_value, 1e-6);
  EXPECT_EQ(*contrast.p_value, *contrast.p_value_holm);
}

TEST(CurveComparison, TheLikelihoodRatioIsThatOfTheModelsWorkedByHand) {
  // There are two saturated groups of two levels. The joint model with the same scale is
  // symmetric: the logits are -+ln 3 and -+ln 9 at -+1, the location is 0, and the common slope
  // b solves 25 + 10 = 100 (1 - f(b)).
  const CurveModel model = {.family = CurveFamily::kLogistic};
  const CurveComparison found = compare_curves(
      {{"a", {{-1.0, 25, 100}, {1.0, 75, 100}}}, {"b", {{-1.0, 10, 100}, {1.0, 90, 100}}}},
      {.model = model});
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  const auto term = [](double k, double p) {
    return k * std::log(p) + (100.0 - k) * std::log(1.0 - p);
  };
  const double different = 2.0 * (term(25, 0.25) + term(10, 0.1));
  const double same = 2.0 * (term(25, 0.175) + term(10, 0.175));
  for (const ComparisonTest& test : found.tests) {
    const double gain = test.name == "location" ? 0.0 : 2.0 * (different - same);
    EXPECT_NEAR(test.statistic, gain, 1e-6) << test.name;
  }
}

}  // namespace curve_fit_test
}  // namespace jnd::analysis
