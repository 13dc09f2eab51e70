#include "analysis/results/study_results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/fits/power_fit.h"
#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "core/error.h"

namespace jnd::analysis {
namespace study_results_test {

const ResultsOptions kQuick = {.num_resamples = 200, .seed = 1};

StudyResults results(const HandMadeStudy& study, const Published& published = {}) {
  return results_of(load_study(study.store()), published, kQuick);
}

const Comparison& comparison(const ResultsSection& of, const std::string& words) {
  for (const NamedComparison& named : of.comparisons) {
    if (named.name.find(words) != std::string::npos) return named.comparison;
  }
  throw core::Error("no comparison " + words);
}

bool is_named(const std::vector<ExcludedParticipant>& excluded, const std::string& participant,
              const std::string& words) {
  return std::any_of(excluded.begin(), excluded.end(), [&](const ExcludedParticipant& one) {
    return one.participant == participant && one.reason.find(words) != std::string::npos;
  });
}

/// Adds people who answer 2 sqrt(I) and 4 sqrt(I), in percent. The group's mean is 3 sqrt(I).
void add_two_estimators(HandMadeStudy& study) {
  for (const auto& [name, k] : {std::pair{"P01", 2.0}, {"P02", 4.0}}) {
    study.add(name);
    for (const double intensity : {1.0, 4.0, 9.0}) {
      study.estimate(intensity, 100.0 * k * std::sqrt(intensity));
    }
  }
}

TEST(StudyResults, EstimationIsThePowerLawThroughTheGroupMeans) {
  HandMadeStudy study;
  add_two_estimators(study);
  const StudyResults of = results(study);
  EXPECT_EQ(of.study, "by_hand");
  EXPECT_EQ(of.num_participants, 2);
  EXPECT_NEAR(value_of(of, "estimation.k"), 3.0, 1e-6);
  EXPECT_NEAR(value_of(of, "estimation.a"), 0.5, 1e-6);
  EXPECT_NEAR(value_of(of, "estimation.log_log.a"), 0.5, 1e-9);
  const Estimate& k = *of.find("estimation.k");
  EXPECT_EQ(k.n, 2);
  EXPECT_FALSE(k.ci95.low.has_value()) << "two participants say nothing of others";
  // The individual laws are 2 sqrt(I) and 4 sqrt(I).
  const std::vector<ParticipantEstimate>& own = section_of(of, "estimation").participants;
  ASSERT_GE(own.size(), 4U);
  EXPECT_EQ(own[0].participant, "P01");
  EXPECT_EQ(own[0].name, "estimation.k");
  EXPECT_NEAR(own[0].value.value(), 2.0, 1e-6);
  EXPECT_NEAR(own[2].value.value(), 4.0, 1e-6);
}

TEST(StudyResults, GroupIntervalsLieAmongWhatParticipantsCanGive) {
  HandMadeStudy study;
  for (const char* name : {"P01", "P02", "P03", "P04", "P05", "P06"}) {
    study.add(name);
    const double k = name[2] % 2 == 0 ? 4.0 : 2.0;
    for (const double intensity : {1.0, 4.0, 9.0}) {
      study.estimate(intensity, 100.0 * k * std::sqrt(intensity));
    }
  }
  const StudyResults of = results(study);
  const Estimate& k = *of.find("estimation.k");
  EXPECT_NEAR(k.value.value(), 3.0, 1e-6);
  EXPECT_GE(k.ci95.low.value(), 2.0 - 1e-6);
  EXPECT_LT(k.ci95.low.value(), 2.5);
  EXPECT_LE(k.ci95.high.value(), 4.0 + 1e-6);
  EXPECT_GT(k.ci95.high.value(), 3.5);
}

TEST(StudyResults, RepetitionsAreAveragedWithinAParticipantFirst) {
  HandMadeStudy study;
  study.add("P01");
  // The means of P01 are 1 and 2. P02 answers once and has the same weight.
  for (const double answer : {50.0, 100.0, 150.0}) study.estimate(1.0, answer);
  for (const double answer : {100.0, 200.0, 300.0}) study.estimate(2.0, answer);
  study.add("P02");
  study.estimate(1.0, 300.0);
  study.estimate(2.0, 600.0);
  EXPECT_NEAR(value_of(results(study), "estimation.k"), 2.0, 1e-6);
  EXPECT_NEAR(value_of(results(study), "estimation.a"), 1.0, 1e-6);
}

TEST(StudyResults, ProductionIsThePowerLawFromSetValuesToTargets) {
  HandMadeStudy study;
  for (const char* name : {"P01", "P02"}) {
    study.add(name);
    // The law is 0.25 I^2, with 100 % at 2 and 400 % at 4.
    study.produce(100.0, 2.0);
    study.produce(400.0, 4.0);
  }
  const StudyResults of = results(study);
  EXPECT_NEAR(value_of(of, "production.k"), 0.25, 1e-6);
  EXPECT_NEAR(value_of(of, "production.a"), 2.0, 1e-6);
  EXPECT_NEAR(value_of(of, "set_intensity.100_percent"), 2.0, 1e-12);
  EXPECT_NEAR(value_of(of, "production_ratio_400_100"), 2.0, 1e-12);
}

TEST(StudyResults, CombinedIsTheCurveBetweenEstimationAndProduction) {
  HandMadeStudy study;
  study.add("P01");
  for (const double intensity : {1.0, 4.0, 9.0}) {
    study.estimate(intensity, 100.0 * std::sqrt(intensity));
  }
  study.produce(100.0, 2.0);
  study.produce(400.0, 4.0);
  const StudyResults of = results(study);
  const PowerFit between = power_between({1.0, 0.5}, {0.25, 2.0}, {1.0, 4.0, 9.0});
  EXPECT_NEAR(value_of(of, "combined.k"), between.k.value(), 1e-6);
  EXPECT_NEAR(value_of(of, "combined.a"), between.a.value(), 1e-6);
}

TEST(StudyResults, RepetitionsOfAnEstimationAreCorrelatedIntensityByIntensity) {
  HandMadeStudy study;
  study.add("P01");
  for (const double intensity : {1.0, 2.0, 3.0}) {
    study.estimate(intensity, 100.0 * intensity, 1);
    study.estimate(intensity, 700.0 + 10.0 * intensity, 2);
    study.estimate(intensity, 400.0 - 100.0 * intensity, 3);
  }
  const StudyResults of = results(study);
  EXPECT_NEAR(value_of(of, "trial_correlation.t1_t2"), 1.0, 1e-12);
  EXPECT_NEAR(value_of(of, "trial_correlation.t1_t3"), -1.0, 1e-12);
  EXPECT_NEAR(value_of(of, "trial_correlation_median"), -1.0, 1e-12);
}

TEST(StudyResults, DiscriminationIsTheWeberFractionOfThePooledCurve) {
  HandMadeStudy study;
  study.add("P01");
  study.compare_ten("group_d", 7);
  study.add("P02");
  study.compare_ten("group_d", 9);
  // 16 of 20 are right: Phi(ln 1.5 / ln(1 + w)) = 0.8, so ln(1 + w) = ln 1.5 / 0.8416212.
  const double expected = std::expm1(std::log(1.5) / 0.8416212335729143);
  const StudyResults of = results(study);
  EXPECT_NEAR(value_of(of, "group_d.weber_fraction"), expected, 1e-6);
  EXPECT_NEAR(value_of(of, "group_d.weber_fraction_ml"), expected, 1e-6);
  const Estimate& w = *of.find("group_d.weber_fraction");
  EXPECT_FALSE(w.ci95.low.has_value());
}

TEST(StudyResults, TwoConditionsAreComparedPairedInLnLnAndUnpairedInW) {
  HandMadeStudy study;
  study.add("P01");
  study.compare_ten("group_d", 8);
  study.compare_ten("group_e", 9);
  study.add("P02");
  study.compare_ten("group_d", 7);
  study.compare_ten("group_e", 9);
  const StudyResults of = results(study);
  const ResultsSection& against = section_of(of, "group_d_against_group_e");
  const Comparison& paired = comparison(against, "ln ln(1 + w), paired");
  // ln ln(1 + w) is ln ln 1.5 - ln z, so the differences are ln(z_e / z_d).
  const double z70 = 0.5244005127080407;
  const double z80 = 0.8416212335729143;
  const double z90 = 1.2815515655446004;
  const double first = std::log(z90 / z80);
  const double second = std::log(z90 / z70);
  EXPECT_NEAR(paired.estimate.value(), 0.5 * (first + second), 1e-6);
  EXPECT_EQ(paired.degrees_of_freedom, 1.0);
  EXPECT_NEAR(paired.statistic.value(), (first + second) / (second - first), 1e-4);
  const Comparison& unpaired = comparison(against, ": w, unpaired, Welch");
  const auto w = [](double z) { return std::expm1(std::log(1.5) / z); };
  EXPECT_NEAR(unpaired.estimate.value(), 0.5 * (w(z80) + w(z70)) - w(z90), 1e-5);
  EXPECT_EQ(unpaired.num_a, 2);
}

TEST(StudyResults, AParticipantWithoutAWeberFractionIsNamedAndComparedWithAndWithout) {
  HandMadeStudy study;
  for (const auto& [name, right_d] : {std::pair{"P01", 8}, {"P02", 7}, {"P03", 10}}) {
    study.add(name);
    study.compare_ten("group_d", right_d);
    study.compare_ten("group_e", 9);
  }
  const StudyResults of = results(study);
  EXPECT_TRUE(is_named(section_of(of, "group_d").excluded, "P03", "group_d"));
  EXPECT_FALSE(is_named(section_of(of, "group_d").excluded, "P01", ""));
  EXPECT_TRUE(section_of(of, "group_e").excluded.empty());
  const ResultsSection& against = section_of(of, "group_d_against_group_e");
  EXPECT_EQ(comparison(against, "paired, without degenerate").num_a, 2);
  EXPECT_EQ(comparison(against, "paired, with degenerate").num_a, 3);
  // The pooled curve contains everybody's answers: 25 of 30.
  EXPECT_EQ(of.find("group_d.weber_fraction")->n, 3);
}

TEST(StudyResults, AMedianOfOwnFractionsIsThereWhileMostPeopleHaveOne) {
  HandMadeStudy study;
  for (const auto& [name, right] : {std::pair{"P01", 9}, {"P02", 9}, {"P03", 5}}) {
    study.add(name);
    study.compare_ten("group_d", right);
  }
  const double w90 = std::expm1(std::log(1.5) / 1.2815515655446004);
  EXPECT_NEAR(value_of(results(study), "group_d.individual_weber_fraction_median"), w90, 1e-6);
}

TEST(StudyResults, NobodyWithAFractionLeavesNoNumberAndAReason) {
  HandMadeStudy study;
  study.add("P01");
  study.compare_ten("group_d", 10);
  const StudyResults of = results(study);
  EXPECT_FALSE(of.find("group_d.weber_fraction")->value);
  EXPECT_TRUE(is_named(section_of(of, "group_d").excluded, "P01", "group_d"));
  for (const ResultsSection& one : of.sections) {
    for (const Estimate& estimate : one.estimates) {
      if (estimate.value) {
        EXPECT_TRUE(std::isfinite(*estimate.value)) << estimate.name;
      }
    }
  }
}

TEST(StudyResults, WhoLacksABlockIsNamedThere) {
  HandMadeStudy study;
  study.add("P01");
  study.compare_ten("group_d", 8);
  study.compare_ten("group_e", 9);
  study.estimate(1.0, 100.0);
  study.estimate(2.0, 200.0);
  study.produce(100.0, 2.0);
  study.produce(200.0, 3.0);
  study.add("P02");
  study.compare_ten("group_d", 8);
  study.estimate(1.0, 100.0);
  study.estimate(2.0, 200.0);
  const StudyResults of = results(study);
  EXPECT_TRUE(is_named(section_of(of, "group_e").excluded, "P02", "no answers in group_e"));
  EXPECT_TRUE(
      is_named(section_of(of, "production").excluded, "P02", "no answers in production"));
  EXPECT_TRUE(is_named(section_of(of, "combined").excluded, "P02", "no answers in production"));
  EXPECT_EQ(of.find("group_e.weber_fraction")->n, 1);
}

/// A study whose kinds of blocks, and a form, are divided between two arms.
constexpr char kArms[] = R"({"name": "by_hand", "participant_fields": [
   {"name": "sex", "options": [{"value": "female"}, {"value": "male"}]}], "stages": [
  {"kind": "counterbalance", "name": "oil", "method": "one_of", "arms": [
    {"name": "thin", "stages": [{"kind": "block", "name": "thin_oil", "procedure": "constant_stimuli"},
      {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation"}]},
    {"name": "thick", "stages": [{"kind": "block", "name": "thick_oil", "procedure": "constant_stimuli"},
      {"kind": "block", "name": "production", "procedure": "magnitude_production"}, {"kind": "block", "name": "match", "procedure": "matching"},
      {"kind": "block", "name": "felt", "procedure": "constant_stimuli", "task": "yes_no"}]}]},
  {"kind": "questionnaire", "name": "about", "only_for": {"oil": "thick"},
   "items": [{"name": "tired", "kind": "yes_no"}]}]})";

void move_widely(HandMadeStudy& study) {
  study.move({.presentation = 1,
              .interval = "test",
              .intensity = 12.0,
              .measures = {.num_strokes = 3, .stroke_width_m = 0.3, .max_speed_m_per_s = 0.4}});
}

/// Adds P01 and P02 to one arm and P03 to the other. P04 and P05 left before their arm began.
void add_both_arms(HandMadeStudy& study) {
  for (const char* name : {"P01", "P02"}) {
    study.add(name, false, "", "sex=female;oil=thin");
    study.compare_ten("thin_oil", 8);
    move_widely(study);
    study.estimate(1.0, 100.0);
    study.estimate(2.0, 200.0);
  }
  study.add("P03", false, "", "sex=female;oil=thick");
  study.compare_ten("thick_oil", 9);
  move_widely(study);
  study.produce(100.0, 2.0);
  study.produce(200.0, 3.0);
  study.match(1.0, 1.0, 2.0);
  (void)study.answer({.block = "felt",
                      .procedure = "constant_stimuli",
                      .quantity = "viscosity_pa_s",
                      .intensity = 1.0,
                      .response = 1.0});
  study.say("about", "tired", "no");
  study.add("P04", false, "", "sex=female;oil=thin");
  study.add("P05", false, "", "sex=female;oil=thick");
}

TEST(StudyResults, NobodyIsLeftOutOfWhatBelongsToAnotherArm) {
  HandMadeStudy study(kArms);
  add_both_arms(study);
  const StudyResults of = results(study);
  const auto is_named_anywhere = [&](const std::string& participant, const std::string& stage) {
    return std::ranges::any_of(of.sections, [&](const ResultsSection& one) {
      return is_named(one.excluded, participant, " in " + stage);
    });
  };
  for (const char* stage : {"thin_oil", "estimation"}) {
    EXPECT_TRUE(is_named_anywhere("P04", stage)) << stage;
    for (const char* other : {"P03", "P05", "everyone"}) {
      EXPECT_FALSE(is_named_anywhere(other, stage)) << other << " in " << stage;
    }
  }
  for (const char* stage : {"thick_oil", "production", "match", "felt", "about"}) {
    EXPECT_TRUE(is_named_anywhere("P05", stage)) << stage;
    for (const char* other : {"P01", "P02", "P04", "everyone"}) {
      EXPECT_FALSE(is_named_anywhere(other, stage)) << other << " in " << stage;
    }
  }
}

TEST(StudyResults, ArmsThatNobodySharesHaveNoPairs) {
  HandMadeStudy study(kArms);
  add_both_arms(study);
  const StudyResults of = results(study);
  for (const NamedComparison& named : section_of(of, "movement").comparisons) {
    EXPECT_EQ(named.name.find("thin_oil - "), std::string::npos) << named.name;
  }
  EXPECT_NE(of.find("stroke_width_m.thin_oil"), nullptr);
  EXPECT_EQ(of.find("stroke_width_m.thin_oil_minus_thick_oil"), nullptr);
  const ResultsSection& against = section_of(of, "thin_oil_against_thick_oil");
  for (const NamedComparison& named : against.comparisons) {
    EXPECT_EQ(named.name.find(", paired"), std::string::npos) << named.name;
    EXPECT_EQ(named.name.find("Wilcoxon"), std::string::npos) << named.name;
  }
  EXPECT_EQ(comparison(against, ": w, unpaired, Welch").num_a, 2);
}

TEST(StudyResults, AnOwnFractionIsBeyondTheStimuliOfTheBlockNotOfOnesOwnAnswers) {
  HandMadeStudy study;
  study.add("P01");
  // The own stimuli of P01 lie between 6 and 10. The Weber fraction is beyond these, but within
  // the stimuli of the block.
  for (int answered = 0; answered < 10; ++answered) {
    study.compare("group_d", 6.0, 8.0, answered < 3);
    study.compare("group_d", 10.0, 8.0, answered < 7);
  }
  study.add("P02");
  study.compare_ten("group_d", 8);
  for (int answered = 0; answered < 10; ++answered) study.compare("group_d", 16.0, 8.0, true);
  const StudyResults of = results(study);
  EXPECT_EQ(value_of(of, "group_d.individual_weber_fraction_beyond_stimuli"), 0.0);
  EXPECT_GT(value_of(of, "group_d.individual_weber_fraction_median"), 0.3);
}

TEST(StudyResults, AMedianBeyondTheStimuliSaysBeyondWhat) {
  HandMadeStudy study;
  for (const auto& [name, right] : {std::pair{"P01", 9}, {"P02", 5}, {"P03", 4}}) {
    study.add(name);
    study.compare_ten("group_d", right);
  }
  const StudyResults of = results(study);
  EXPECT_FALSE(of.find("group_d.individual_weber_fraction_median")->value);
  EXPECT_TRUE(is_named(section_of(of, "group_d").excluded, "everyone",
                       "group_d.individual_weber_fraction_median: no value, > 0.5000: 2 of 3"));
}

TEST(StudyResults, SessionsThatDidNotComeToTheirEndAreNamed) {
  HandMadeStudy study;
  study.add("P01");
  study.compare_ten("group_d", 8);
  study.end("session_completed");
  study.add("P02");
  study.end("session_ended_early");
  study.add("P03");
  study.add("PILOT", /*pilot=*/true);
  const StudyResults of = results(study);
  EXPECT_EQ(of.sessions.open, std::vector<std::string>{"P03"});
  EXPECT_EQ(of.sessions.ended_early, std::vector<std::string>{"P02"});
  EXPECT_EQ(of.sessions.num_pilots, 1);
}

TEST(StudyResults, PilotsAndAnswersTakenBackOrSetAsideDoNotCount) {
  HandMadeStudy study;
  add_two_estimators(study);
  study.add("P99", /*pilot=*/true);
  study.estimate(1.0, 10000.0);
  study.add("P03");
  for (const double intensity : {1.0, 4.0})
    study.estimate(intensity, 300.0 * std::sqrt(intensity));
  study.estimate(9.0, 5.0);
  study.undo_last_answer();
  study.answer_again({.block = "estimation",
                      .procedure = "magnitude_estimation",
                      .quantity = "scale",
                      .repetition = 1,
                      .intensity = 9.0,
                      .response = 900.0},
                     2);
  const std::int64_t strange = study.answer({.block = "estimation",
                                             .procedure = "magnitude_estimation",
                                             .quantity = "scale",
                                             .repetition = 2,
                                             .intensity = 9.0,
                                             .response = 77777.0});
  study.exclude(strange);
  const StudyResults of = results(study);
  EXPECT_EQ(of.num_participants, 3);
  EXPECT_NEAR(value_of(of, "estimation.k"), 3.0, 1e-6);
  EXPECT_NEAR(value_of(of, "estimation.a"), 0.5, 1e-6);
}

TEST(StudyResults, PilotsAloneAreNothingToAnalyse) {
  HandMadeStudy study;
  study.add("P99", /*pilot=*/true);
  study.estimate(1.0, 100.0);
  EXPECT_THROW((void)load_study(study.store()), core::Error);
}

TEST(StudyResults, PublishedValuesStandBesideOursByName) {
  HandMadeStudy study;
  add_two_estimators(study);
  Published published{.citation = "Somebody (1999)"};
  published.values["estimation.k"] = {.value = 2.5, .standard_deviation = 0.5, .place = "p. 3"};
  const StudyResults of = results(study, published);
  EXPECT_EQ(of.citation, "Somebody (1999)");
  EXPECT_EQ(of.find("estimation.k")->published, 2.5);
  EXPECT_EQ(of.find("estimation.k")->published_sd, 0.5);
  EXPECT_FALSE(of.find("estimation.a")->published);
  EXPECT_NEAR(value_of(of, "estimation.k"), 3.0, 1e-6) << "never moved by what was published";
}

TEST(StudyResults, SayOfEachValueWhetherTheLaboratoryWasCalibratedOnIt) {
  HandMadeStudy study;
  const char* laboratory =
      R"({"name":"lab","calibrated_on":["estimation.k","by_hand/estimation.a","other/production.k"],
          "implied":["production.a"]})";
  study.add("P01", false, laboratory);
  study.estimate(1.0, 100.0);
  study.estimate(2.0, 200.0);
  study.produce(100.0, 2.0);
  study.produce(200.0, 3.0);
  const StudyResults of = results(study);
  EXPECT_TRUE(of.simulated);
  EXPECT_EQ(of.laboratory, "lab");
  EXPECT_TRUE(of.find("estimation.k")->calibrated);
  EXPECT_TRUE(of.find("estimation.a")->calibrated);
  EXPECT_FALSE(of.find("production.k")->calibrated) << "of another study";
  EXPECT_TRUE(of.find("production.a")->implied);
}

TEST(StudyResults, PersonsAreNeverCalledSimulated) {
  HandMadeStudy study;
  add_two_estimators(study);
  const StudyResults of = results(study);
  EXPECT_FALSE(of.simulated);
  for (const ResultsSection& one : of.sections) {
    for (const Estimate& estimate : one.estimates) EXPECT_FALSE(estimate.calibrated);
  }
}

TEST(StudyResults, MovementIsTheMeanOverParticipantsOfPresentationsWithAWholeStroke) {
  HandMadeStudy study;
  const auto present = [&](const char* block, double width_m, double speed_m_per_s,
                           std::int64_t num_strokes, const char* interval = "test") {
    study.compare(block, 12.0, 8.0, true);
    study.move({.presentation = 1,
                .interval = interval,
                .measures = {.num_strokes = num_strokes,
                             .stroke_width_m = width_m,
                             .max_speed_m_per_s = speed_m_per_s}});
  };
  study.add("P01");
  present("group_d", 0.2, 0.40, 2);
  present("group_d", 0.4, 0.60, 2);
  present("group_d", 9.0, 9.00, 0);
  present("group_e", 0.3, 0.30, 2, "reference");
  present("group_e", 9.0, 9.00, 3, "free_space");
  study.add("P02");
  present("group_d", 0.5, 0.70, 1);
  present("group_e", 0.1, 0.20, 1);
  const StudyResults of = results(study);
  EXPECT_NEAR(value_of(of, "stroke_width_m.group_d"), 0.5 * (0.3 + 0.5), 1e-12);
  EXPECT_NEAR(value_of(of, "max_speed_m_per_s.group_d"), 0.5 * (0.5 + 0.7), 1e-12);
  EXPECT_NEAR(value_of(of, "max_speed_m_per_s.group_e"), 0.5 * (0.3 + 0.2), 1e-12);
  EXPECT_NEAR(value_of(of, "stroke_width_m"), 0.5 * (0.3 + 0.3), 1e-12);
  EXPECT_NEAR(
      comparison(section_of(of, "movement"), "max_speed_m_per_s, paired").estimate.value(),
      0.5 * (0.2 + 0.5), 1e-12);
  for (const NamedComparison& named : section_of(of, "movement").comparisons) {
    const bool paired = named.comparison.kind == Comparison::Kind::kPaired;
    EXPECT_EQ(named.family, paired ? "exploratory, movement" : "") << named.name;
    EXPECT_EQ(named.p_value_holm.has_value(), paired) << named.name;
    EXPECT_EQ(named.name.ends_with(", sensitivity"), !paired) << named.name;
  }
}

TEST(StudyResults, FingersTrailBehindThePalmOfADeviceThatHasThem) {
  HandMadeStudy study;
  const auto present = [&](const char* block, std::optional<double> finger_lag_s) {
    study.compare(block, 12.0, 8.0, true);
    study.move({.presentation = 1,
                .interval = "test",
                .measures = {.num_strokes = 2,
                             .stroke_width_m = 0.3,
                             .max_speed_m_per_s = 0.4,
                             .finger_lag_s = finger_lag_s}});
  };
  study.add("P01");
  present("group_d", std::nullopt);
  EXPECT_EQ(results(study).find("finger_lag_s"), nullptr);
  present("group_d", 0.010);
  present("group_d", 0.014);
  study.add("P02");
  present("group_d", 0.020);
  EXPECT_NEAR(value_of(results(study), "finger_lag_s"), 0.5 * (0.012 + 0.020), 1e-12);
}

TEST(StudyResults, ATrendOverTheTrialsNamesTheAnswerItIsOf) {
  HandMadeStudy study;
  study.add("P01");
  study.compare_ten("group_d", 8);
  const StudyResults all = results(study);
  const auto& comparisons = all.sections.front().comparisons;
  EXPECT_TRUE(std::ranges::any_of(comparisons, [](const NamedComparison& one) {
    return one.name.starts_with(
        "group_d: the test is called \"more\" more often over the trials, exploratory");
  }));
}

TEST(StudyResults, PracticeIsToldInNumbersOrWithTheReasonWhyNot) {
  HandMadeStudy study;
  study.add("P01");
  study.compare_ten("group_d", 8);
  StudyData data = load_study(study.store());
  data.practice = {{.participant = "P01",
                    .block = "warm_up",
                    .num_trials = 14,
                    .num_judged = 10,
                    .num_correct = 8,
                    .criterion_met = true},
                   {.participant = "P02",
                    .block = "warm_up",
                    .num_trials = 3,
                    .problem = "its study file has no such practice"}};
  const StudyResults all = results_of(data, {}, {.num_resamples = 50});
  const auto practice = std::ranges::find(all.sections, "practice", &ResultsSection::name);
  ASSERT_NE(practice, all.sections.end());
  const auto own = [&](const std::string& participant, const std::string& name) {
    for (const ParticipantEstimate& one : practice->participants) {
      if (one.participant == participant && one.name == "warm_up." + name) return one;
    }
    ADD_FAILURE() << participant << ' ' << name;
    return ParticipantEstimate{};
  };
  EXPECT_EQ(own("P01", "num_trials").value, 14.0);
  EXPECT_EQ(own("P01", "num_judged").value, 10.0);
  EXPECT_EQ(own("P01", "num_correct").value, 8.0);
  EXPECT_EQ(own("P01", "criterion_met").value, 1.0);
  EXPECT_EQ(own("P01", "num_trials").reason, "");
  EXPECT_EQ(own("P02", "num_trials").value, 3.0);
  EXPECT_EQ(own("P02", "num_trials").reason, "");
  for (const char* name : {"num_judged", "num_correct", "criterion_met"}) {
    EXPECT_FALSE(own("P02", name).value) << name;
    EXPECT_EQ(own("P02", name).reason, "its study file has no such practice") << name;
  }
}

TEST(StudyResults, TheSameSeedGivesTheSameIntervals) {
  HandMadeStudy study;
  for (int person = 1; person <= 6; ++person) {
    study.add("P0" + std::to_string(person));
    study.compare_ten("group_d", 5 + person % 4);
  }
  const auto interval = [&] { return results(study).find("group_d.weber_fraction")->ci95; };
  EXPECT_EQ(interval().low, interval().low);
  EXPECT_EQ(interval().high, interval().high);
  EXPECT_TRUE(interval().low);
}

}  // namespace study_results_test
}  // namespace jnd::analysis
