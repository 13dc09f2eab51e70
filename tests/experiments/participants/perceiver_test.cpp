#include "experiments/participants/perceiver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace jnd::experiments {
namespace perceiver_test {

constexpr double kMechanical = 4.0;
constexpr double kStandard = 3.0;
constexpr double kWeber = 0.3;

/// A population without spread, habits or lapses, so that everybody has these numbers.
Laboratory plain_laboratory() {
  Laboratory laboratory;
  laboratory.device.mechanical_viscosity_n_s_per_m = kMechanical;
  laboratory.movement = {.max_speed_m_per_s = 0.4,
                         .body_height_m = 1.75,
                         .hand_height_ratio = 0.5,
                         .surface_height_m = 1.6};
  laboratory.perceiver = {.weber_fraction = kWeber,
                          .noise = "normal",
                          .exponent = 1.0,
                          .unit = 1.0,
                          .standard_damping_n_s_per_m = kStandard,
                          .shrink = 1.0,
                          .centre_ratio = 2.0,
                          .learning_trials = 3.0,
                          .match_tolerance_ln = 0.03,
                          .coarse_step_ln = 0.5};
  return laboratory;
}

Perceiver perceiver_of(const Laboratory& laboratory, std::uint64_t seed) {
  return {laboratory, draw_person(laboratory, seed), seed};
}

/// A moment far into a block, where nothing is learnt any more.
Moment moment(std::int64_t trial, std::int64_t presentation = 1) {
  return {.trial = trial, .attempt = 1, .presentation = presentation, .trial_in_block = 1};
}

/// Returns how often the second of two dampings is called thicker, over persons and trials.
double probability_of_thicker(const Laboratory& laboratory, double reference, double test) {
  int num_thicker = 0;
  int num_trials = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Perceiver perceiver = perceiver_of(laboratory, seed);
    for (std::int64_t trial = 1; trial <= 100; ++trial) {
      const double first = perceiver.reading_ln(reference, moment(trial, 1));
      const double second = perceiver.reading_ln(test, moment(trial, 2));
      num_thicker += perceiver.says_thicker(second, first, moment(trial, 2)) ? 1 : 0;
      ++num_trials;
    }
  }
  return static_cast<double>(num_thicker) / num_trials;
}

// For 20 000 answers, four standard deviations of a proportion are 0.0141 at one half.
constexpr double kTolerance = 0.015;

TEST(Perceiver, TwoDampingsThatDifferByItsWeberFractionAreToldApartWith84Percent) {
  const Laboratory laboratory = plain_laboratory();
  // Phi(1) = 0.8413 at every level, since the noise is in the logarithm.
  for (const double reference : {2.0, 10.0, 50.0}) {
    EXPECT_NEAR(probability_of_thicker(laboratory, reference, reference * (1.0 + kWeber)),
                0.8413, kTolerance)
        << reference;
    EXPECT_NEAR(probability_of_thicker(laboratory, reference, reference / (1.0 + kWeber)),
                0.1587, kTolerance)
        << reference;
  }
  EXPECT_NEAR(probability_of_thicker(laboratory, 10.0, 10.0), 0.5, kTolerance);
}

TEST(Perceiver, LapsesSetTheAsymptotes) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.lapse_rate = 0.05;
  EXPECT_NEAR(probability_of_thicker(laboratory, 1.0, 1000.0), 0.95, kTolerance);
  EXPECT_NEAR(probability_of_thicker(laboratory, 1000.0, 1.0), 0.05, kTolerance);
  laboratory.perceiver.lapse_rate = 0.0;
  EXPECT_EQ(probability_of_thicker(laboratory, 1.0, 1000.0), 1.0);
}

TEST(Perceiver, APersonsCriterionShiftsTheCurveOfThatPersonAlone) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.criterion_sd_ln = 0.5;
  int num_persons = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Person person = draw_person(laboratory, seed);
    const Perceiver perceiver(laboratory, person, seed);
    EXPECT_FALSE(perceiver.says_thicker(person.criterion_ln - 1e-9, 0.0, moment(1)));
    EXPECT_TRUE(perceiver.says_thicker(person.criterion_ln + 1e-9, 0.0, moment(1)));
    num_persons += person.criterion_ln != 0.0 ? 1 : 0;
  }
  EXPECT_EQ(num_persons, 20);
}

TEST(Perceiver, ADriftingCriterionMovesWithTheTrialsOfABlock) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.criterion_drift_per_trial_ln = 0.02;
  const Person person = draw_person(laboratory, 3);
  const Perceiver perceiver(laboratory, person, 3);
  Moment late = moment(1);
  late.trial_in_block = 11;
  const double criterion = 10.0 * person.criterion_drift_per_trial_ln;
  EXPECT_NE(criterion, 0.0);
  EXPECT_TRUE(perceiver.says_thicker(criterion + 1e-9, 0.0, late));
  EXPECT_FALSE(perceiver.says_thicker(criterion - 1e-9, 0.0, late));
}

class Noise : public ::testing::TestWithParam<const char*> {};

TEST_P(Noise, HasMeanZeroAndTheSpreadOfTheWeberFraction) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.noise = GetParam();
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  const double expected_sd = std::log(1.0 + kWeber) / std::sqrt(2.0);
  constexpr int kReadings = 100000;
  double sum = 0.0;
  double squares = 0.0;
  for (std::int64_t trial = 1; trial <= kReadings; ++trial) {
    const double noise =
        (perceiver.reading_ln(10.0, moment(trial)) - std::log(10.0)) / expected_sd;
    sum += noise;
    squares += noise * noise;
  }
  EXPECT_NEAR(sum / kReadings, 0.0, 4.0 / std::sqrt(kReadings));
  EXPECT_NEAR(std::sqrt(squares / kReadings), 1.0, 0.015);
}

INSTANTIATE_TEST_SUITE_P(Families, Noise, ::testing::Values("normal", "weibull"),
                         [](const auto& one) { return std::string(one.param); });

TEST(Perceiver, WeibullNoiseIsSkewedAndNormalNoiseIsNot) {
  for (const char* family : {"normal", "weibull"}) {
    Laboratory laboratory = plain_laboratory();
    laboratory.perceiver.noise = family;
    const Perceiver perceiver = perceiver_of(laboratory, 1);
    const double sd = std::log(1.0 + kWeber) / std::sqrt(2.0);
    double cubes = 0.0;
    constexpr int kReadings = 50000;
    for (std::int64_t trial = 1; trial <= kReadings; ++trial) {
      const double noise = perceiver.reading_ln(1.0, moment(trial)) / sd;
      cubes += noise * noise * noise;
    }
    // The skewness of ln of a Weibull variable is -1.1395.
    EXPECT_NEAR(cubes / kReadings, std::string(family) == "weibull" ? -1.14 : 0.0, 0.1)
        << family;
  }
}

TEST(Perceiver, IsNoisierAtFirstAndAgainWhenTired) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.learning_ratio = 1.0;
  laboratory.perceiver.fatigue_ratio_per_trial = 0.01;
  const Laboratory steady = plain_laboratory();
  const auto ratio = [&](std::int64_t trial_in_block) {
    Moment at = moment(5);
    at.trial_in_block = trial_in_block;
    // Both readings have the same draw of noise, stretched.
    return perceiver_of(laboratory, 1).reading_ln(1.0, at) /
           perceiver_of(steady, 1).reading_ln(1.0, at);
  };
  EXPECT_NEAR(ratio(1), 2.0, 1e-9);
  EXPECT_NEAR(ratio(4), (1.0 + std::exp(-1.0)) * 1.03, 1e-9);
  EXPECT_NEAR(ratio(101), 2.0, 1e-9) << "all learnt, tired";
}

TEST(Perceiver, ReadingsAreKeyedByTrialAttemptAndPresentationAlone) {
  const Laboratory laboratory = plain_laboratory();
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  const double first = perceiver.reading_ln(10.0, moment(3, 1));
  (void)perceiver.reading_ln(10.0, moment(4, 1));
  EXPECT_EQ(perceiver.reading_ln(10.0, moment(3, 1)), first);
  EXPECT_EQ(perceiver_of(laboratory, 1).reading_ln(10.0, moment(3, 1)), first);
  Moment repeated = moment(3, 1);
  repeated.attempt = 2;
  const std::set<double> readings = {first, perceiver.reading_ln(10.0, moment(3, 2)),
                                     perceiver.reading_ln(10.0, moment(4, 1)),
                                     perceiver.reading_ln(10.0, repeated),
                                     perceiver_of(laboratory, 2).reading_ln(10.0, moment(3))};
  EXPECT_EQ(readings.size(), 5U);
}

TEST(Perceiver, WithoutShrinkEstimationAndProductionAgree) {
  // What feels like the target is estimated as the target. With shrink the two differ.
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.exponent = 0.8;
  laboratory.perceiver.unit = 0.7;
  for (const double target_percent : {50.0, 100.0, 200.0}) {
    const double matching =
        kMechanical + kStandard * std::pow(target_percent / 100.0 / 0.7, 1.0 / 0.8);
    const double reading = std::log(matching);
    const Perceiver agreeing = perceiver_of(laboratory, 1);
    EXPECT_EQ(agreeing.estimate_percent(reading, moment(1), std::nullopt), target_percent);
    EXPECT_EQ(agreeing.wish(reading, reading, target_percent, moment(1)),
              Perceiver::Wish::kMatches);
  }
  laboratory.perceiver.shrink = 0.5;
  const double reading = std::log(kMechanical + kStandard * std::pow(0.5 / 0.7, 1.0 / 0.8));
  const Perceiver shrinking = perceiver_of(laboratory, 1);
  EXPECT_GT(shrinking.estimate_percent(reading, moment(1), std::nullopt), 50.0);
  EXPECT_NE(shrinking.wish(reading, reading, 50.0, moment(1)), Perceiver::Wish::kMatches);
}

TEST(Perceiver, ShrinkDrawsAnswersTowardTheCentreOfTheRange) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.shrink = 0.5;
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  const auto answer = [&](double ratio) {
    return perceiver.estimate_percent(std::log(kMechanical + kStandard * ratio), moment(1),
                                      std::nullopt);
  };
  EXPECT_EQ(answer(2.0), 200.0) << "the centre stays";
  // The geometric means with 2 are sqrt(2 * 0.5) = 1 and sqrt(2 * 8) = 4.
  EXPECT_EQ(answer(0.5), 100.0);
  EXPECT_EQ(answer(8.0), 400.0);
}

TEST(Perceiver, WhatFeelsLikeFreeSpaceOrLessIsZero) {
  const Laboratory laboratory = plain_laboratory();
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  for (const double felt : {kMechanical, 0.5 * kMechanical, 1e-9}) {
    EXPECT_EQ(perceiver.estimate_percent(std::log(felt), moment(1), 100.0), 0.0) << felt;
    EXPECT_EQ(perceiver.wish(std::log(felt), std::log(felt), 100.0, moment(1)),
              Perceiver::Wish::kRaiseCoarse)
        << felt;
  }
}

TEST(Perceiver, ReadingsOfNothingOrLessAreFinite) {
  const Laboratory laboratory = plain_laboratory();
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  for (const double felt : {0.0, -1.0, 1e-300}) {
    EXPECT_TRUE(std::isfinite(perceiver.reading_ln(felt, moment(1)))) << felt;
  }
}

TEST(Perceiver, AnswersInRoundNumbersFinerWhereTheyAreSmall) {
  const Laboratory laboratory = plain_laboratory();
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  for (double percent = 1.0; percent < 2000.0; percent *= 1.07) {
    const double answer = perceiver.estimate_percent(
        std::log(kMechanical + kStandard * percent / 100.0), moment(1), std::nullopt);
    const double step = percent < 50.0    ? 5.0
                        : percent < 200.0 ? 10.0
                        : percent < 400.0 ? 25.0
                                          : 50.0;
    EXPECT_NEAR(answer, percent, 0.5 * step + 1e-6) << percent;
    EXPECT_NEAR(std::remainder(answer, step), 0.0, 1e-9) << percent;
  }
}

TEST(Perceiver, IsPulledTowardTheAnswerBeforeUnlessThatWasNothing) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.assimilation_ratio = 0.5;
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  const double reading = std::log(kMechanical + kStandard);  // This is 100 percent.
  EXPECT_EQ(perceiver.estimate_percent(reading, moment(1), std::nullopt), 100.0);
  EXPECT_EQ(perceiver.estimate_percent(reading, moment(1), 400.0), 200.0);
  EXPECT_EQ(perceiver.estimate_percent(reading, moment(1), 25.0), 50.0);
  EXPECT_EQ(perceiver.estimate_percent(reading, moment(1), 0.0), 100.0);
}

TEST(Perceiver, InProductionWishesForCoarseStepsFarOffAndFineOnesNear) {
  const Laboratory laboratory = plain_laboratory();
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  const auto wish = [&](double ratio) {
    const double reading = std::log(kMechanical + kStandard * ratio);
    return perceiver.wish(reading, reading, 100.0, moment(1));
  };
  using Wish = Perceiver::Wish;
  EXPECT_EQ(wish(1.0), Wish::kMatches);
  EXPECT_EQ(wish(std::exp(0.02)), Wish::kMatches);
  EXPECT_EQ(wish(std::exp(0.04)), Wish::kLowerFine);
  EXPECT_EQ(wish(std::exp(-0.04)), Wish::kRaiseFine);
  EXPECT_EQ(wish(std::exp(0.6)), Wish::kLowerCoarse);
  EXPECT_EQ(wish(std::exp(-0.6)), Wish::kRaiseCoarse);
}

TEST(Perceiver, AnAnchorDrawsTheAimTowardWhereTheStepsBegan) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.anchor_ratio = 0.5;
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  const double start = std::log(kMechanical + kStandard * 4.0);
  const double matching = std::log(kMechanical + kStandard * 2.0);  // This is halfway, in ln.
  EXPECT_EQ(perceiver.wish(matching, start, 100.0, moment(1)), Perceiver::Wish::kMatches);
}

TEST(Perceiver, LooksAgainAsOftenAsTheLaboratorySays) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.look_again_probability = 0.15;
  const Perceiver perceiver = perceiver_of(laboratory, 1);
  int num_again = 0;
  for (std::int64_t trial = 1; trial <= 20000; ++trial) {
    num_again += perceiver.looks_again(moment(trial)) ? 1 : 0;
  }
  EXPECT_NEAR(num_again / 20000.0, 0.15, 0.012);
}

TEST(Person, IsTheSameForTheSameSeedAndAnotherForAnother) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.weber_fraction_sd_ln = 0.25;
  laboratory.movement.max_speed_sd_ln = 0.2;
  const Person person = draw_person(laboratory, 42);
  EXPECT_EQ(draw_person(laboratory, 42).weber_fraction, person.weber_fraction);
  EXPECT_EQ(draw_person(laboratory, 42).max_speed_m_per_s, person.max_speed_m_per_s);
  EXPECT_NE(draw_person(laboratory, 43).weber_fraction, person.weber_fraction);
}

TEST(Person, ASpreadInOneTraitLeavesTheOthersAlone) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.exponent_sd = 0.1;
  const Person before = draw_person(laboratory, 7);
  laboratory.perceiver.weber_fraction_sd_ln = 0.5;
  const Person after = draw_person(laboratory, 7);
  EXPECT_NE(after.weber_fraction, before.weber_fraction);
  EXPECT_EQ(after.exponent, before.exponent);
  EXPECT_EQ(after.amplitude_score, before.amplitude_score);
}

TEST(Person, APopulationHasTheMeanAndSpreadOfItsLaboratory) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.weber_fraction_sd_ln = 0.25;
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kPersons = 20000;
  for (std::uint64_t seed = 1; seed <= kPersons; ++seed) {
    const double z = std::log(draw_person(laboratory, seed).weber_fraction / kWeber) / 0.25;
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / kPersons, 0.0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / kPersons), 1.0, 0.02);
}

TEST(Person, StaysPossibleHoweverWideTheSpreads) {
  Laboratory laboratory = plain_laboratory();
  laboratory.perceiver.exponent_sd = 1.0;
  laboratory.perceiver.shrink = 0.5;
  laboratory.perceiver.shrink_sd_ln = 2.0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const Person person = draw_person(laboratory, seed);
    EXPECT_GT(person.exponent, 0.0);
    EXPECT_GT(person.shrink, 0.0);
    EXPECT_LE(person.shrink, 1.0);
    EXPECT_GE(person.age_years, 18);
  }
}

}  // namespace perceiver_test
}  // namespace jnd::experiments
