#include "analysis/results/own_fractions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"

namespace jnd::analysis {
namespace own_fractions_test {

StudyResults results(const HandMadeStudy& study, const Published& published = {}) {
  return results_of(load_study(study.store()), published, {.num_resamples = 1000});
}

/// Adds people who compare at two thirds and at one and a half of 8. Each number says how many
/// of ten are right.
void add_people(HandMadeStudy& study, const std::vector<int>& num_right) {
  for (std::size_t i = 0; i < num_right.size(); ++i) {
    study.add((i < 9 ? "P0" : "P") + std::to_string(i + 1));
    study.compare_ten("group_d", num_right[i]);
  }
}

const char kMedian[] = "group_d.individual_weber_fraction_median";
const char kSpread[] = "group_d.individual_weber_fraction_robust_sd";

OwnFractions fractions_between(const std::vector<std::pair<double, double>>& ranges) {
  OwnFractions fractions{.largest = 1.0};
  for (const auto& [at_least, at_most] : ranges) {
    fractions.people.push_back({.at_least = at_least, .at_most = at_most});
  }
  return fractions;
}

TEST(OwnFractions, AQuantileLiesBetweenWhatIsAtLeastAndWhatIsAtMostSo) {
  const OwnFractions fractions =
      fractions_between({{0.1, 0.1}, {0.3, 0.3}, {0.2, 0.2}, {1.0, INFINITY}});
  const std::vector<std::size_t> all = {0, 1, 2, 3};
  EXPECT_DOUBLE_EQ(own_fraction_quantile(fractions, all, 0.5).value().value(), 0.25);
  // The quantile lies three quarters of the way from the third person to the next one, of whom
  // only "> 1" is known.
  const CensoredValue upper = own_fraction_quantile(fractions, all, 0.75);
  EXPECT_FALSE(upper.value().has_value());
  EXPECT_DOUBLE_EQ(upper.at_least, 0.3 + 0.25 * (1.0 - 0.3));
  EXPECT_TRUE(std::isinf(upper.at_most));
  const CensoredValue spread = own_fraction_spread(fractions, all);
  EXPECT_DOUBLE_EQ(spread.at_least, (upper.at_least - 0.175) / 1.349);
  EXPECT_TRUE(std::isinf(spread.at_most));
}

TEST(OwnFractions, TheSpreadOfPeopleBeyondTheStimuliMayBeAnything) {
  const OwnFractions fractions = fractions_between({{1.0, INFINITY}, {1.0, INFINITY}});
  const CensoredValue spread = own_fraction_spread(fractions, {0, 1});
  EXPECT_EQ(spread.at_least, 0.0);
  EXPECT_TRUE(std::isinf(spread.at_most));
}

TEST(OwnFractions, TheIntervalOfAMedianIsOpenWhereResampledOnesLieBeyondTheStimuli) {
  HandMadeStudy study;
  // Seven of 13 people have a fraction, which is 0.37 (9 of 10 right). The six others have flat
  // answers.
  add_people(study, {9, 5, 9, 5, 9, 5, 9, 5, 9, 5, 9, 5, 9});
  const StudyResults of = results(study);
  EXPECT_EQ(of.find("group_d.individual_weber_fraction_beyond_stimuli")->value, 6.0);
  const Estimate& median = *of.find(kMedian);
  EXPECT_NEAR(median.value.value(), std::expm1(std::log(1.5) / 1.2815515655446004), 1e-6);
  EXPECT_NEAR(median.ci95.low.value(), *median.value, 1e-6);
  EXPECT_FALSE(median.ci95.high.has_value()) << *median.ci95.high;
  const Estimate& spread = *of.find(kSpread);
  EXPECT_FALSE(spread.value.has_value());
  EXPECT_FALSE(spread.ci95.high.has_value());
  EXPECT_NE(spread.reason.find("quartile"), std::string::npos);
}

TEST(OwnFractions, AMedianBeyondTheStimuliStillHasALowerEnd) {
  HandMadeStudy study;
  add_people(study, {9, 5, 9, 5, 9, 5, 9, 5, 9, 5, 5, 5, 5});
  const StudyResults of = results(study);
  const Estimate& median = *of.find(kMedian);
  EXPECT_FALSE(median.value.has_value());
  EXPECT_TRUE(median.reason.starts_with("> 0.5000: 8 of 13 lie beyond")) << median.reason;
  EXPECT_GT(median.ci95.low.value(), 0.3);
  EXPECT_FALSE(median.ci95.high.has_value());
}

TEST(OwnFractions, OnePersonHasNoSpread) {
  HandMadeStudy study;
  add_people(study, {9});
  const StudyResults of = results(study);
  EXPECT_FALSE(of.find(kSpread)->value.has_value());
  EXPECT_EQ(of.find(kSpread)->reason, "one participant has no spread");
  EXPECT_TRUE(of.find(kMedian)->value.has_value());
}

TEST(OwnFractions, AMedianOfSeparatedAnswersIsNotNought) {
  HandMadeStudy study;
  add_people(study, {10, 10, 10, 9, 9});
  const StudyResults of = results(study);
  const Estimate& median = *of.find(kMedian);
  EXPECT_FALSE(median.value.has_value());
  EXPECT_TRUE(median.reason.starts_with("< 0.")) << median.reason;
  EXPECT_NE(median.reason.find("3 of 5 are separated"), std::string::npos) << median.reason;
  EXPECT_FALSE(median.ci95.low.has_value());
  EXPECT_GT(median.ci95.high.value(), 0.0);
}

/// Adds answers that a pse above the reference explains: 3 of 10 are "more" at the reference of
/// 8.
void compare_above(HandMadeStudy& study, int num_more) {
  for (int answered = 0; answered < 10; ++answered) {
    study.compare("group_d", 8.0, 8.0 + 1e-6, answered < 3);
    study.compare("group_d", 10.0, 8.0, answered < num_more);
    study.compare("group_d", 12.0, 8.0, answered < num_more + 2);
    study.compare("group_d", 24.0, 8.0, true);
  }
}

TEST(OwnFractions, AreToldWithBothPsesByNamesOfTheirOwn) {
  HandMadeStudy study;
  for (const auto& [name, num_more] : {std::pair{"P01", 5}, {"P02", 6}, {"P03", 7}}) {
    study.add(name);
    compare_above(study, num_more);
  }
  const StudyResults of = results(study);
  const auto median_of = [&](const std::string& own_name) {
    std::vector<double> values;
    for (const ParticipantEstimate& own : section_of(of, "group_d").participants) {
      if (own.name == own_name) values.push_back(own.value.value());
    }
    std::ranges::sort(values);
    return values.at(1);
  };
  const Estimate& primary = *of.find(kMedian);
  const Estimate& fixed = *of.find(std::string(kMedian) + "_at_reference");
  EXPECT_NEAR(*primary.value, median_of("group_d.weber_fraction_free_pse"), 1e-9);
  EXPECT_NE(primary.meaning.find("pse free"), std::string::npos);
  EXPECT_NEAR(*fixed.value, median_of("group_d.weber_fraction"), 1e-9);
  EXPECT_NE(fixed.meaning.find("pse at the reference"), std::string::npos);
  EXPECT_GT(std::fabs(*primary.value - *fixed.value), 0.05);
}

TEST(OwnFractions, PublishedValuesChangeNoNumberOfTheAnalysis) {
  HandMadeStudy study;
  for (const auto& [name, num_more] : {std::pair{"P01", 5}, {"P02", 6}, {"P03", 7}}) {
    study.add(name);
    compare_above(study, num_more);
  }
  const StudyResults alone = results(study);
  Published published{.citation = "Somebody (2018)", .values = {}};
  for (const ResultsSection& one : alone.sections) {
    for (const Estimate& estimate : one.estimates) {
      published.values[estimate.name] = {.value = 0.72, .standard_deviation = 0.2};
    }
  }
  const StudyResults beside = results(study, published);
  ASSERT_EQ(alone.sections.size(), beside.sections.size());
  for (std::size_t i = 0; i < alone.sections.size(); ++i) {
    const ResultsSection& a = alone.sections[i];
    const ResultsSection& b = beside.sections[i];
    EXPECT_EQ(a.own_fractions_free_pse, b.own_fractions_free_pse) << a.name;
    ASSERT_EQ(a.estimates.size(), b.estimates.size()) << a.name;
    for (std::size_t j = 0; j < a.estimates.size(); ++j) {
      EXPECT_EQ(a.estimates[j].name, b.estimates[j].name);
      EXPECT_EQ(a.estimates[j].value, b.estimates[j].value) << a.estimates[j].name;
      EXPECT_EQ(a.estimates[j].meaning, b.estimates[j].meaning);
      EXPECT_EQ(a.estimates[j].ci95.low, b.estimates[j].ci95.low) << a.estimates[j].name;
    }
  }
}

TEST(OwnFractions, ByLeastSquaresAtTheReferenceAreThoseThatAreMadeByHand) {
  HandMadeStudy study;
  add_people(study, {8, 9});
  const StudyData data = load_study(study.store());
  std::vector<ExcludedParticipant> without_answers;
  const auto answers =
      discrimination_answers(data, data.blocks.front(), false, without_answers);
  const OwnFractions fractions =
      own_fractions(answers, {.method = PsychometricMethod::kLeastSquares});
  ASSERT_EQ(fractions.people.size(), 2U);
  EXPECT_EQ(fractions.people[1].participant, "P02");
  // With 80 and 90 % at 1.5, least squares go through both proportions, which are symmetrical.
  EXPECT_NEAR(*fractions.people[0].weber_fraction,
              std::expm1(std::log(1.5) / 0.8416212335729143), 1e-6);
  EXPECT_NEAR(*fractions.people[1].weber_fraction,
              std::expm1(std::log(1.5) / 1.2815515655446004), 1e-6);
  EXPECT_TRUE(fractions.people[0].is_beyond_stimuli()) << "0.62 of a largest stimulus of 0.5";
}

}  // namespace own_fractions_test
}  // namespace jnd::analysis
