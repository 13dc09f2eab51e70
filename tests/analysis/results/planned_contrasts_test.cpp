#include "analysis/results/planned_contrasts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "analysis/hand_made_study.h"
#include "analysis/hierarchical/hierarchical_contrast.h"
#include "analysis/results/contrast_answers.h"
#include "analysis/results/contrast_words.h"
#include "analysis/results/study_results.h"
#include "analysis/results/test_families.h"
#include "analysis/statistics/comparison.h"
#include "experiments/designed_study.h"

namespace jnd::analysis {
namespace planned_contrasts_test {

using experiments::designed_study;
using experiments::fluid_contrast;

constexpr char kFluids[] = R"({"fluid": {"thin": 1, "thick": -1}})";

/// Adds a person with so many right answers of ten in each block, each given after `times_s`.
void add_person(HandMadeStudy& study, const std::string& name, const std::string& priming,
                int thin_right, int thick_right, double thin_s, double thick_s) {
  study.add(name, false, "", "priming=" + priming);
  const auto block = [&](const std::string& name_of, double reference, int num_right,
                         double time_s) {
    for (int answered = 0; answered < 10; ++answered) {
      for (const double factor : {1.0 / 1.5, 1.5}) {
        const bool right = answered < num_right;
        (void)study.answer({.block = name_of,
                            .procedure = "constant_stimuli",
                            .quantity = "viscosity_pa_s",
                            .repetition = 1,
                            .intensity = factor * reference,
                            .reference_intensity = reference,
                            .response = (factor > 1.0) == right ? 1.0 : 0.0,
                            .measures = {.response_time_s = time_s}});
      }
    }
  };
  block("thin_a", 4.0, thin_right, 0.5 * thin_s);
  block("thick_b", 16.0, thick_right, thick_s);
  // The geometric mean of both thin blocks is thin_s.
  block("thin_c", 4.0, thin_right, 2.0 * thin_s);
}

std::vector<ContrastResult> of_six(const std::string& contrasts) {
  HandMadeStudy study(designed_study(contrasts));
  add_person(study, "P01", "primed", 7, 9, 2.0, 1.0);
  add_person(study, "P02", "control", 6, 8, 3.0, 1.2);
  add_person(study, "P03", "primed", 8, 9, 2.5, 1.1);
  add_person(study, "P04", "control", 7, 8, 1.5, 1.4);
  add_person(study, "P05", "primed", 6, 9, 2.2, 0.9);
  add_person(study, "P06", "control", 7, 9, 2.6, 1.3);
  return planned_contrasts(load_study(study.store()));
}

std::string time_contrast(const std::string& of, const std::string& more = "",
                          const std::string& name = "time") {
  return fluid_contrast(more, name, of, "response_time");
}

TEST(PlannedContrasts, AreStudentsTOfPeoplesLogarithms) {
  const ContrastResult one =
      of_six(time_contrast(R"({"block": {"thin_a": 1, "thick_b": -1}})")).at(0);
  // Each group counts by itself, with the mean of three logarithms.
  const double primed =
      (std::log(1.0 / 1.0) + std::log(1.25 / 1.1) + std::log(1.1 / 0.9)) / 3.0;
  const double control =
      (std::log(1.5 / 1.2) + std::log(0.75 / 1.4) + std::log(1.3 / 1.3)) / 3.0;
  EXPECT_NEAR(one.test.effect.value(), std::exp(0.5 * (primed + control)), 1e-12);
  EXPECT_EQ(one.test.num_participants, 6);
  EXPECT_EQ(one.conditions.size(), 4U);
}

TEST(PlannedContrasts, OfBlocksWithoutGroupsAreThePairedTest) {
  // Without a factor of people, all belong to one group.
  std::string text = designed_study(time_contrast(kFluids));
  const std::string factor = R"(,
              {"name": "priming", "levels": ["primed", "control"]})";
  text.erase(text.find(factor), factor.size());
  HandMadeStudy study(text);
  const std::vector<double> thin = {2.0, 3.0, 2.5, 1.5}, thick = {1.0, 1.2, 1.1, 1.4};
  std::vector<double> thin_ln, thick_ln;
  for (std::size_t i = 0; i < thin.size(); ++i) {
    add_person(study, "P0" + std::to_string(i + 1), i % 2 == 0 ? "primed" : "control", 7, 9,
               thin[i], thick[i]);
    thin_ln.push_back(std::log(thin[i]));
    thick_ln.push_back(std::log(thick[i]));
  }
  const ContrastResult one = planned_contrasts(load_study(study.store())).at(0);
  const Comparison paired = paired_t_test(thin_ln, thick_ln);
  EXPECT_NEAR(one.test.effect.value(), std::exp(*paired.estimate), 1e-12);
  EXPECT_NEAR(one.test.ci95.low.value(), std::exp(*paired.ci95.low), 1e-12);
  EXPECT_NEAR(one.test.statistic.value(), *paired.statistic, 1e-10);
  EXPECT_NEAR(one.test.p_value.value(), *paired.p_value, 1e-12);
  EXPECT_EQ(one.conditions, (std::vector<std::string>{"thin (+1)", "thick (-1)"}));
  ASSERT_EQ(one.otherwise.size(), 1U);
  EXPECT_NE(one.otherwise[0].method.find("Wilcoxon"), std::string::npos);
}

TEST(PlannedContrasts, AnInteractionIsTheDifferenceOfBothGroups) {
  const std::vector<ContrastResult> all = of_six(
      time_contrast(kFluids) + ", " +
      time_contrast(
          R"({"fluid": {"thin": 1, "thick": -1}, "priming": {"primed": 1, "control": -1}})", "",
          "both") +
      ", " +
      time_contrast(R"({"fluid": {"thin": 1, "thick": -1}, "priming": {"primed": 1}})", "",
                    "primed_alone"));
  const double primed = (std::log(2.0) + std::log(2.5 / 1.1) + std::log(2.2 / 0.9)) / 3.0;
  const double control =
      (std::log(3.0 / 1.2) + std::log(1.5 / 1.4) + std::log(2.6 / 1.3)) / 3.0;
  EXPECT_NEAR(all[0].test.effect.value(), std::exp(0.5 * (primed + control)), 1e-12);
  EXPECT_NEAR(all[1].test.effect.value(), std::exp(primed - control), 1e-12);
  EXPECT_NEAR(all[2].test.effect.value(), std::exp(primed), 1e-12);
  EXPECT_EQ(all[2].test.num_participants, 3);
  EXPECT_NEAR(all[2].test.degrees_of_freedom.value(), 2.0, 1e-9);
  const Comparison welch =
      welch_t_test({std::log(2.0), std::log(2.5 / 1.1), std::log(2.2 / 0.9)},
                   {std::log(3.0 / 1.2), std::log(1.5 / 1.4), std::log(2.6 / 1.3)});
  EXPECT_NEAR(all[1].test.p_value.value(), *welch.p_value, 1e-10);
}

TEST(PlannedContrasts, AFamilyIsAdjustedAndOthersAreNot) {
  const std::vector<ContrastResult> all =
      of_six(time_contrast(kFluids, "", "one") + ", " +
             time_contrast(R"({"priming": {"primed": 1, "control": -1}})", "", "two") + ", " +
             time_contrast(kFluids, R"(, "family": "own")", "three"));
  EXPECT_NEAR(*all[0].p_value_adjusted, 2.0 * *all[0].test.p_value, 1e-12);
  EXPECT_NEAR(*all[2].p_value_adjusted, *all[2].test.p_value, 1e-15);
}

TEST(PlannedContrasts, ADirectionMakesTheTestOneSided) {
  const std::vector<ContrastResult> all =
      of_six(time_contrast(kFluids, R"(, "family": "a")", "both_sides") + ", " +
             time_contrast(kFluids, R"(, "family": "b", "direction": "greater")", "up") + ", " +
             time_contrast(kFluids, R"(, "family": "c", "direction": "less")", "down"));
  EXPECT_NEAR(*all[1].test.p_value, 0.5 * *all[0].test.p_value, 1e-12);
  EXPECT_NEAR(*all[2].test.p_value, 1.0 - 0.5 * *all[0].test.p_value, 1e-12);
}

TEST(PlannedContrasts, ASmallestEffectIsTestedForEquivalence) {
  const std::vector<ContrastResult> all =
      of_six(time_contrast(R"({"priming": {"primed": 1, "control": -1}})",
                           R"(, "smallest_effect": 10)", "small") +
             ", " +
             time_contrast(R"({"priming": {"primed": 1, "control": -1}})",
                           R"(, "smallest_effect": 1.01)", "narrow"));
  ASSERT_TRUE(all[0].equivalence && all[1].equivalence);
  EXPECT_TRUE(all[0].equivalence->is_shown);
  EXPECT_FALSE(all[1].equivalence->is_shown);
  EXPECT_NE(all[0].sentence.find("It is equivalent to no effect within the margin of 0.10 to "
                                 "10.0, 90 % CI ["),
            std::string::npos)
      << all[0].sentence;
  EXPECT_NE(all[1].sentence.find("Equivalence to no effect was not shown"), std::string::npos);
}

TEST(PlannedContrasts, OfWeberFractionsAreThoseOfTheMedianPerson) {
  const std::vector<ContrastResult> all =
      of_six(fluid_contrast() + ", " + fluid_contrast("", "biases", kFluids, "pse"));
  const ContrastTest& fractions = all[0].test;
  ASSERT_TRUE(fractions.effect) << fractions.reason;
  // The thin fluid has fewer right answers, and so a larger fraction.
  EXPECT_GT(*fractions.effect, 1.3);
  EXPECT_LT(*fractions.effect, 5.0);
  EXPECT_LT(*fractions.p_value, 0.05);
  EXPECT_LT(fractions.ci95.low.value(), *fractions.effect);
  EXPECT_GT(fractions.ci95.high.value(), *fractions.effect);
  EXPECT_NE(fractions.method.find("median person, "), std::string::npos);
  // The answers are as right below the reference as above it, so there is no bias.
  ASSERT_TRUE(all[1].test.effect || !all[1].test.reason.empty());
  if (all[1].test.effect) {
    EXPECT_NEAR(*all[1].test.effect, 1.0, 1e-3);
  }
  ASSERT_FALSE(all[0].otherwise.empty());
  EXPECT_NE(all[0].otherwise[0].method.find("ln ln(1 + w)"), std::string::npos);
}

// The contrast is about the three primed people, whose thin fluid comes in two blocks. The test
// repeats the fit by hand.
TEST(PlannedContrasts, TakeTheAnswersOfBothBlocksOfAConditionTogether) {
  const ContrastTest found =
      of_six(fluid_contrast("", "primed",
                            R"({"fluid": {"thin": 1, "thick": -1}, "priming": {"primed": 1}})"))
          .at(0)
          .test;
  std::vector<ParticipantAnswers> answers;
  for (const auto& [name, thin_right, thick_right] :
       {std::tuple("P01", 7, 9), {"P03", 8, 9}, {"P05", 6, 9}}) {
    const auto rows = [](double reference, int num_right, int num_trials) {
      return std::vector<AnswerCount>{
          {.intensity = reference / 1.5,
           .num_yes = num_trials - num_right,
           .num_trials = num_trials},
          {.intensity = reference * 1.5, .num_yes = num_right, .num_trials = num_trials}};
    };
    answers.push_back({name, "thin", 4.0, rows(4.0, 2 * thin_right, 20)});
    answers.push_back({name, "thick", 16.0, rows(16.0, thick_right, 10)});
  }
  const HierarchicalFit fit = fit_hierarchical(answers, {.lapse_profile = false});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  const double thin = fit.conditions[0].weber_fraction.value();
  const double thick = fit.conditions[1].weber_fraction.value();
  EXPECT_NEAR(found.effect.value(), thin / thick, 1e-3 * thin / thick);
  EXPECT_EQ(found.num_participants, 3);
}

TEST(HierarchicalContrast, HasTheErrorOfTheSlopesByTheDeltaMethod) {
  std::vector<ParticipantAnswers> answers;
  int person = 0;
  for (const int right : {6, 7, 8, 9}) {
    answers.push_back({"P" + std::to_string(++person),
                       "",
                       1.0,
                       {{.intensity = 0.5, .num_yes = 10 - right, .num_trials = 10},
                        {.intensity = 2.0, .num_yes = right, .num_trials = 10}}});
  }
  const HierarchicalFit fit =
      fit_hierarchical(answers, {.pse = HierarchicalPse::kReference, .lapse_profile = false});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  std::map<std::string, int> groups;
  for (const ParticipantAnswers& one : answers) groups[one.participant] = 0;
  const auto contrast = hierarchical_contrast(fit, HierarchicalLink::kLogSlope,
                                              HierarchicalNumber::kLogWeberFraction,
                                              {{"", 1.0}}, groups, {{0, 4}});
  ASSERT_TRUE(contrast);
  const auto log_fraction = [](double slope_number) {
    return std::log(std::expm1(std::exp(-slope_number)));
  };
  const double at = fit.conditions[0].slope_number;
  constexpr double kStep = 1e-5;
  const double slope = (log_fraction(at + kStep) - log_fraction(at - kStep)) / (2.0 * kStep);
  const double variance = slope * slope * fit.influence.row(0).squaredNorm() * 4.0 / 3.0;
  EXPECT_GT(fit.conditions[0].weber_fraction.value(), 0.5) << "not a small one";
  EXPECT_NEAR(contrast->effect, log_fraction(at), 1e-9);
  EXPECT_NEAR(contrast->standard_error, std::sqrt(variance), 1e-6 * std::sqrt(variance));
  EXPECT_NEAR(contrast->degrees_of_freedom, 3.0, 1e-9);
}

// Returns a study with two blocks of ratings, loud and quiet, and questions after each trial.
std::string rated_study(const std::string& contrasts) {
  const auto block = [](const std::string& name) {
    return R"({"kind": "block", "name": ")" + name + R"(", "levels": {"noise": ")" + name +
           R"("}, "procedure": "rating", "medium": "viscous", "viscosity_pa_s": [1, 4],
      "repetitions": 2, "num_steps": 7, "low_label": {"en": "thin"},
      "high_label": {"en": "thick"}, "instruction": {"en": "Rate."},
      "question": {"en": "How thick?"}, "expected_trial_s": 10, "questions": [
        {"name": "sure", "kind": "scale", "num_steps": 5, "question": {"en": "Sure?"},
         "low_label": {"en": "no"}, "high_label": {"en": "yes"}},
        {"name": "heard", "kind": "yes_no", "required": false,
         "question": {"en": "Heard anything?"}}]})";
  };
  return R"({"format": 1, "name": "rated", "languages": ["en"], "title": {"en": "R"},
    "authors": ["A"], "factors": [{"name": "noise", "levels": ["loud", "quiet"]}],
    "contrasts": [)" +
         contrasts + R"(], "stages": [)" + block("loud") + "," + block("quiet") + "]}";
}

std::string noise_contrast(const std::string& name, const std::string& measure,
                           const std::string& more = "") {
  return R"({"name": ")" + name + R"(", "role": "primary", "family": ")" + name + "\"," +
         measure + R"(, "of": {"noise": {"loud": 1, "quiet": -1}})" + more + "}";
}

/// Adds ratings of the thin and of the thick fluid, how certain the person was, and whether
/// they heard anything.
void add_ratings(HandMadeStudy& study, const std::string& block,
                 const std::vector<std::pair<double, double>>& rated, const std::string& sure,
                 const std::string& heard) {
  for (const auto& [intensity, step] : rated) {
    (void)study.answer({.block = block,
                        .procedure = "rating",
                        .medium = "viscous",
                        .quantity = "viscosity_pa_s",
                        .repetition = 1,
                        .intensity = intensity,
                        .response = step});
    study.say_after_trial(block, "sure", sure);
    study.say_after_trial(block, "heard", heard);
  }
}

TEST(PlannedContrasts, OfRatingsAreDifferencesOfMeanSteps) {
  HandMadeStudy study(rated_study(
      noise_contrast("steps", R"("measure": "rating")", R"(, "smallest_effect": 3)") + ", " +
      noise_contrast("how_sure", R"("measure": "question", "question": "sure")") + ", " +
      noise_contrast("what_was_heard", R"("measure": "question", "question": "heard")")));
  study.add("P01");
  // The thin fluid was rated twice, so the mean is that of the means, 0.5 * (2 + 6).
  add_ratings(study, "loud", {{1.0, 1.0}, {1.0, 3.0}, {4.0, 6.0}}, "2", "yes");
  add_ratings(study, "quiet", {{1.0, 2.0}, {4.0, 4.0}}, "4", "no");
  study.add("P02");
  add_ratings(study, "loud", {{1.0, 3.0}, {4.0, 7.0}}, "1", "yes");
  add_ratings(study, "quiet", {{1.0, 2.0}, {4.0, 4.0}}, "4", "no");
  study.add("P03");
  add_ratings(study, "loud", {{1.0, 4.0}, {4.0, 5.0}}, "3", "no");
  add_ratings(study, "quiet", {{1.0, 4.0}, {4.0, 4.0}}, "3", "no_answer");
  const std::vector<ContrastResult> all = planned_contrasts(load_study(study.store()));
  ASSERT_EQ(all.size(), 3U);
  const Comparison steps = paired_t_test({4.0, 5.0, 4.5}, {3.0, 3.0, 4.0});
  EXPECT_DOUBLE_EQ(all[0].test.effect.value(), 3.5 / 3.0);
  EXPECT_NEAR(all[0].test.ci95.low.value(), *steps.ci95.low, 1e-12);
  EXPECT_NEAR(all[0].test.p_value.value(), *steps.p_value, 1e-12);
  EXPECT_TRUE(
      all[0].sentence.starts_with("The rating was 1.17 higher in loud than in quiet, "
                                  "95 % CI ["))
      << all[0].sentence;
  EXPECT_NE(all[0].sentence.find("within the margin of -3.00 to 3.00"), std::string::npos)
      << "a margin is a difference, too: " << all[0].sentence;
  const Comparison sure = paired_t_test({2.0, 1.0, 3.0}, {4.0, 4.0, 3.0});
  EXPECT_DOUBLE_EQ(all[1].test.effect.value(), -5.0 / 3.0);
  EXPECT_NEAR(all[1].test.p_value.value(), *sure.p_value, 1e-12);
  EXPECT_TRUE(
      all[1].sentence.starts_with("The answer to the question sure was 1.67 lower in "
                                  "loud than in quiet, "))
      << all[1].sentence;
  // Yes counts 1 and no 0. A person who never answered the question in a block has no number
  // there.
  EXPECT_EQ(all[2].test.num_participants, 2);
  EXPECT_FALSE(all[2].test.p_value) << "both differ by the same";
  ASSERT_EQ(all[2].excluded.size(), 1U);
  EXPECT_EQ(all[2].excluded[0].reason, "no answer to the question heard of their own in quiet");
}

TEST(PlannedContrasts, OfTimesOfSimulatedPeopleSayThatTheySayNothing) {
  const auto sentences_of = [](const std::string& laboratory) {
    HandMadeStudy study(rated_study(noise_contrast("time", R"("measure": "response_time")") +
                                    ", " + noise_contrast("steps", R"("measure": "rating")")));
    double time_s = 1.0;
    for (const char* name : {"P01", "P02", "P03"}) {
      study.add(name, false, laboratory);
      for (const char* block : {"loud", "quiet"}) {
        (void)study.answer({.block = block,
                            .procedure = "rating",
                            .quantity = "viscosity_pa_s",
                            .repetition = 1,
                            .intensity = 1.0,
                            .response = 2.0 + time_s,
                            .measures = {.response_time_s = time_s}});
        time_s = 1.4 * time_s + 0.3;
      }
    }
    const std::vector<ContrastResult> all = planned_contrasts(load_study(study.store()));
    return std::pair(all.at(0).sentence, all.at(1).sentence);
  };
  constexpr char kCaution[] =
      " The people are SIMULATED: how long they take says nothing about people.";
  const auto [simulated, steps] = sentences_of("{}");
  ASSERT_TRUE(simulated.starts_with("The response time was ")) << simulated;
  EXPECT_TRUE(simulated.ends_with(kCaution)) << simulated;
  EXPECT_EQ(steps.find("SIMULATED"), std::string::npos) << "ratings are theirs";
  EXPECT_EQ(sentences_of("").first.find("SIMULATED"), std::string::npos);
}

TEST(PlannedContrasts, WhoLacksAConditionIsNamed) {
  HandMadeStudy study(designed_study(time_contrast(kFluids)));
  add_person(study, "P01", "primed", 7, 9, 2.0, 1.0);
  add_person(study, "P02", "primed", 7, 9, 2.4, 1.0);
  add_person(study, "P03", "control", 7, 9, 2.1, 1.2);
  add_person(study, "P04", "control", 7, 9, 2.2, 1.0);
  study.add("P05", false, "", "priming=control");
  study.compare("thin_a", 6.0, 4.0, true);
  const ContrastResult one = planned_contrasts(load_study(study.store())).at(0);
  EXPECT_EQ(one.test.num_participants, 4);
  ASSERT_EQ(one.excluded.size(), 1U);
  EXPECT_EQ(one.excluded[0].participant, "P05");
}

TEST(PlannedContrasts, StandBesidePairsThatAreExploratory) {
  HandMadeStudy study(designed_study(fluid_contrast()));
  for (const char* name : {"P01", "P02", "P03", "P04"}) {
    add_person(study, name, name[2] % 2 == 0 ? "primed" : "control", 6 + name[2] % 3, 9, 2.0,
               1.0);
  }
  const StudyResults results =
      results_of(load_study(study.store()), {}, {.num_resamples = 100, .seed = 1});
  ASSERT_EQ(results.contrasts.size(), 1U);
  bool any = false;
  for (const ResultsSection& section : results.sections) {
    for (const NamedComparison& named : section.comparisons) {
      EXPECT_FALSE(named.primary) << named.name;
      EXPECT_EQ(named.name.find("(primary)"), std::string::npos) << named.name;
      any |= named.family == kBesidePlanFamily;
    }
  }
  EXPECT_TRUE(any);
}

TEST(ContrastWords, AreAsAJournalPrintsThem) {
  ContrastResult result;
  result.plan = {.name = "fluids",
                 .measure = experiments::ContrastMeasure::kWeberFraction,
                 .weights = {{"fluid", {{"thin", 1.0}, {"thick", -1.0}}}}};
  result.test = {.effect = 2.1,
                 .ci95 = {1.6, 2.9},
                 .statistic = 4.1,
                 .degrees_of_freedom = 12.0,
                 .p_value = 0.0015};
  EXPECT_EQ(contrast_sentence(result),
            "The Weber fraction was 2.10 times as large in thin as in thick, 95 % CI [1.60, "
            "2.90], t(12) = 4.10, p = .0015.");
  result.plan.weights["priming"] = {{"primed", 1.0}};
  result.p_value_adjusted = 0.003;
  EXPECT_EQ(
      contrast_sentence(result),
      "The Weber fraction was 2.10 times as large in thin as in thick (priming: primed), "
      "95 % CI [1.60, 2.90], t(12) = 4.10, p = .0015, p = .0030 adjusted for the family.");
  result.plan.weights["priming"] = {{"primed", 1.0}, {"control", -1.0}};
  result.p_value_adjusted.reset();
  EXPECT_EQ(contrast_sentence(result),
            "The ratio of the Weber fraction in thin to that in thick was 2.10 times as large "
            "in primed as in control, 95 % CI [1.60, 2.90], t(12) = 4.10, p = .0015.");
  result.plan.measure = experiments::ContrastMeasure::kExponent;
  result.plan.weights.erase("priming");
  result.test.effect = -0.12;
  result.test.ci95 = {-0.2, -0.04};
  EXPECT_EQ(contrast_sentence(result),
            "The exponent was 0.12 smaller in thin than in thick, 95 % CI [-0.20, -0.040], "
            "t(12) = 4.10, p = .0015.");
}

TEST(ContrastWords, OfPValuesAreWithoutALeadingZero) {
  EXPECT_EQ(journal_p_words(0.0321), "p = .032");
  EXPECT_EQ(journal_p_words(0.00321), "p = .0032");
  EXPECT_EQ(journal_p_words(0.0003), "p < .001");
  EXPECT_EQ(journal_p_words(1.0), "p > .999");
}

}  // namespace planned_contrasts_test
}  // namespace jnd::analysis
