#include "analysis/results/discrimination_group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "core/error.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace discrimination_group_test {

const ResultsOptions kQuick = {.num_resamples = 50, .seed = 1};

StudyResults results(const HandMadeStudy& study) {
  return results_of(load_study(study.store()), {}, kQuick);
}

const Estimate& estimate(const StudyResults& of, const std::string& name) {
  const Estimate* found = of.find(name);
  if (found == nullptr) throw core::Error("no estimate " + name);
  return *found;
}

/// Adds a person for each number, which says how many of ten answers are right at 8 / 1.5 and
/// at 8 * 1.5.
void add_people(HandMadeStudy& study, const std::vector<int>& num_right) {
  int number = 0;
  for (const int right : num_right) {
    study.add("P0" + std::to_string(++number));
    study.compare_ten("group_d", right);
  }
}

TEST(DiscriminationGroup, EveryGroupValueNamesItsEstimand) {
  HandMadeStudy study;
  add_people(study, {7, 8, 8, 9, 9});
  const StudyResults of = results(study);
  EXPECT_TRUE(estimate(of, "group_d.weber_fraction").meaning.starts_with("pooled-curve w"));
  EXPECT_TRUE(
      estimate(of, "group_d.weber_fraction_free_pse").meaning.starts_with("pooled-curve w"));
  const Estimate& person = estimate(of, "group_d.weber_fraction_median_person");
  EXPECT_TRUE(person.meaning.starts_with("median person's w"));
  EXPECT_NE(person.meaning.find("primary"), std::string::npos);
  EXPECT_NE(estimate(of, "group_d.weber_fraction_median_person_at_reference")
                .meaning.find("secondary"),
            std::string::npos);
  ASSERT_TRUE(person.value && person.ci95.low && person.ci95.high);
  EXPECT_LT(*person.ci95.low, *person.value);
  EXPECT_GT(*person.ci95.high, *person.value);
  EXPECT_EQ(person.n, 5);
}

TEST(DiscriminationGroup, LevelsTooHardToTellLapsesAreACautionBesideTheMedianPerson) {
  // In the first case 80 % are right at both levels, and in the second 92 %. The Weber fraction
  // itself is at 84 %.
  for (const auto& [num_right, is_hard] :
       {std::pair{std::vector{7, 8, 8, 9, 8}, true}, {std::vector{9, 9, 10, 9, 9}, false}}) {
    HandMadeStudy study;
    add_people(study, num_right);
    const StudyResults of = results(study);
    const Estimate& person = estimate(of, "group_d.weber_fraction_median_person");
    ASSERT_EQ(person.cautions.size(), is_hard ? 1U : 0U);
    if (is_hard) {
      EXPECT_NE(person.cautions[0].find("too hard"), std::string::npos) << person.cautions[0];
    }
    EXPECT_NE(person.meaning.find("over lapse rates of 0"), std::string::npos)
        << person.meaning;
    const Estimate& lapses = estimate(of, "group_d.lapse_rate");
    EXPECT_EQ(*lapses.ci95.low, 0.0);
    EXPECT_NE(lapses.meaning.find("without its prior"), std::string::npos) << lapses.meaning;
  }
}

TEST(DiscriminationGroup, AnswersSymmetricAboutTheReferencePutThePseThere) {
  HandMadeStudy study;
  add_people(study, {7, 8, 8, 9, 9});
  const StudyResults of = results(study);
  EXPECT_NEAR(*estimate(of, "group_d.pse").value, 8.0, 1e-6);
  EXPECT_NEAR(*estimate(of, "group_d.pse_median_person").value, 8.0, 1e-5);
  EXPECT_EQ(estimate(of, "group_d.pse").unit, "Pa s");
  EXPECT_NEAR(*estimate(of, "group_d.weber_fraction_free_pse").value,
              *estimate(of, "group_d.weber_fraction_ml").value, 1e-6);
}

TEST(DiscriminationGroup, ATableWithoutTheDegenerateStandsBesideTheWhole) {
  HandMadeStudy study;
  add_people(study, {7, 8, 8, 9, 10});
  const StudyResults of = results(study);
  EXPECT_EQ(estimate(of, "group_d.weber_fraction").n, 5);
  EXPECT_EQ(estimate(of, "group_d.weber_fraction.without_degenerate").n, 4);
  EXPECT_GT(*estimate(of, "group_d.weber_fraction.without_degenerate").value,
            *estimate(of, "group_d.weber_fraction").value);
  EXPECT_EQ(estimate(of, "group_d.weber_fraction_median_person").n, 5);
  EXPECT_EQ(estimate(of, "group_d.weber_fraction_median_person.without_degenerate").n, 4);
  EXPECT_EQ(of.find("group_d.weber_fraction.with_excluded_trials"), nullptr);
}

TEST(DiscriminationGroup, ATableWithTheTrialsThatWereSetAsideStandsBesideTheRest) {
  HandMadeStudy study;
  add_people(study, {7, 8, 8, 9});
  study.exclude(1);  // This excludes a right "no" of the last participant.
  const StudyResults of = results(study);
  const double without = *estimate(of, "group_d.weber_fraction_ml").value;
  // With the excluded trial, 32 of 40 are right, which puts 84 % at 1.5^(1 / 0.8416).
  EXPECT_NEAR(*estimate(of, "group_d.weber_fraction.with_excluded_trials").value,
              std::expm1(std::log(1.5) / 0.8416212335729143), 1e-6);
  EXPECT_GT(without, *estimate(of, "group_d.weber_fraction.with_excluded_trials").value);
}

TEST(DiscriminationGroup, TwoConditionsAreComparedHierarchicallyAndByRanks) {
  HandMadeStudy study;
  int number = 0;
  for (const auto& [d, e] : {std::pair{7, 9}, {6, 8}, {7, 8}, {8, 9}, {6, 9}}) {
    study.add("P0" + std::to_string(++number));
    study.compare_ten("group_d", d);
    study.compare_ten("group_e", e);
  }
  const StudyResults of = results(study);
  const auto section =
      std::find_if(of.sections.begin(), of.sections.end(),
                   [](const auto& one) { return one.name == "group_d_against_group_e"; });
  ASSERT_NE(section, of.sections.end());
  const auto named = [&](const std::string& words) {
    for (const NamedComparison& one : section->comparisons) {
      if (one.name.find(words) != std::string::npos) return one.comparison;
    }
    throw core::Error("no comparison " + words);
  };
  const Comparison primary = named("hierarchical, pse free (primary)");
  ASSERT_EQ(primary.status, FitStatus::kOk) << primary.reason;
  EXPECT_GT(*primary.estimate, 0.0) << "D is the coarser";
  EXPECT_LT(*primary.ci95.low, *primary.estimate);
  EXPECT_GT(*primary.statistic, 0.0);
  const Comparison paired = named("ln ln(1 + w), paired");
  EXPECT_NEAR(*named("hierarchical, pse at the reference").estimate, *paired.estimate, 0.1);
  EXPECT_EQ(named("ln ln(1 + w), Wilcoxon, sensitivity").num_a, 5);
  EXPECT_EQ(named("ln ln(1 + w), paired, pse free").status, FitStatus::kOk);
}

TEST(DiscriminationGroup, NobodyWithAnAnswerLeavesReasonsAndNoNumber) {
  HandMadeStudy study;
  add_people(study, {10, 10});
  const StudyResults of = results(study);
  EXPECT_FALSE(estimate(of, "group_d.weber_fraction_median_person").value);
  for (const ResultsSection& section : of.sections) {
    if (section.name != "group_d") continue;
    EXPECT_TRUE(
        std::any_of(section.excluded.begin(), section.excluded.end(), [](const auto& one) {
          return one.participant == "everyone" &&
                 one.reason.find("median_person: no value") != std::string::npos;
        }));
  }
}

const NamedComparison* find_comparison(const ResultsSection& section,
                                       const std::string& words) {
  for (const NamedComparison& one : section.comparisons) {
    if (one.name.find(words) != std::string::npos) return &one;
  }
  return nullptr;
}

double log_log_of_right(double num_right, double num_trials) {
  const double z = core::standard_normal_quantile(num_right / num_trials);
  return std::log(std::log(1.5) / z);
}

TEST(DiscriminationGroup, HalfAnAnswerIsAddedToTheDegenerateAlone) {
  HandMadeStudy study;
  int number = 0;
  for (const int right : {7, 8, 10}) {
    study.add("P0" + std::to_string(++number));
    study.compare_ten("group_d", right);
    study.compare_ten("group_e", 9);
  }
  const ResultsSection against = section_of(results(study), "group_d_against_group_e");
  const NamedComparison* with = find_comparison(against, "paired, with degenerate");
  ASSERT_NE(with, nullptr);
  EXPECT_NE(with->name.find("half a yes and half a no added to theirs alone"),
            std::string::npos);
  // There are two levels of ten. A quarter of a yes and of a no added at each makes 10.25 of
  // 10.5 right.
  const double by_hand =
      (log_log_of_right(7, 10) + log_log_of_right(8, 10) + log_log_of_right(10.25, 10.5)) /
          3.0 -
      log_log_of_right(9, 10);
  EXPECT_NEAR(with->comparison.estimate.value(), by_hand, 1e-6);
  EXPECT_EQ(find_comparison(against, "paired, without degenerate")->comparison.num_a, 2);
}

TEST(DiscriminationGroup, WithoutADegenerateParticipantThereIsNoRowOfSuch) {
  HandMadeStudy study;
  int number = 0;
  for (const int right : {7, 8, 9}) {
    study.add("P0" + std::to_string(++number));
    study.compare_ten("group_d", right);
    study.compare_ten("group_e", 9);
  }
  const ResultsSection against = section_of(results(study), "group_d_against_group_e");
  EXPECT_EQ(find_comparison(against, "degenerate participants"), nullptr);
  EXPECT_NE(find_comparison(against, "ln ln(1 + w), paired"), nullptr);
  EXPECT_TRUE(against.excluded.empty());
}

TEST(DiscriminationGroup, WhoHasNoFractionWithAFreePseIsNamedWithTheReason) {
  HandMadeStudy study;
  for (const char* name : {"P01", "P02", "P03"}) {
    study.add(name);
    study.compare_ten("group_d", name[2] == '3' ? 7 : 8);
    study.compare_ten("group_e", 9);
  }
  // All three answers are "thicker" at each level. With the pse at the reference there is a
  // Weber fraction. With a free pse there is none, because all answers are alike.
  study.add("P04");
  for (const double intensity : {7.0, 12.0, 16.0}) {
    for (int i = 0; i < 3; ++i) study.compare("group_d", intensity, 8.0, true);
  }
  study.compare_ten("group_e", 8);
  const ResultsSection against = section_of(results(study), "group_d_against_group_e");
  const auto named = std::ranges::find_if(against.excluded, [](const auto& one) {
    return one.participant == "P04" &&
           one.reason.starts_with("group_d: no Weber fraction of their own with a free pse");
  });
  EXPECT_NE(named, against.excluded.end());
  EXPECT_EQ(find_comparison(against, "paired, pse free, without")->comparison.num_a, 3);
}

TEST(DiscriminationGroup, ChangesOverTheTrialsAreOneFamilyOfTheStudy) {
  HandMadeStudy study;
  int number = 0;
  for (const int right : {7, 8, 9, 8, 6}) {
    study.add("P0" + std::to_string(++number));
    study.compare_ten("group_d", right);
    study.compare_ten("group_e", 15 - right);
  }
  const StudyResults of = results(study);
  std::vector<double> p_values, adjusted;
  for (const ResultsSection& section : of.sections) {
    for (const NamedComparison& one : section.comparisons) {
      if (one.family != "exploratory, changes over the trials") continue;
      if (!one.comparison.p_value) continue;
      p_values.push_back(*one.comparison.p_value);
      adjusted.push_back(one.p_value_holm.value());
    }
  }
  ASSERT_GE(p_values.size(), 3U) << "of both blocks";
  const auto least = std::ranges::min_element(p_values);
  EXPECT_NEAR(adjusted[static_cast<std::size_t>(least - p_values.begin())],
              std::min(1.0, *least * static_cast<double>(p_values.size())), 1e-12);
}

TEST(DiscriminationGroup, APooledCurveOfAnswersThatAreAllAlikeSaysWhatItRestsOn) {
  HandMadeStudy study;
  for (const char* person : {"P01", "P02"}) {
    study.add(person);
    for (int i = 0; i < 10; ++i) study.compare("group_d", 6.0 + i, 8.0, true);
  }
  const StudyResults of = results(study);
  const Estimate& pooled = estimate(of, "group_d.weber_fraction");
  ASSERT_TRUE(pooled.value.has_value());
  ASSERT_EQ(pooled.cautions.size(), 1U);
  EXPECT_NE(pooled.cautions[0].find("every answer is the same"), std::string::npos);
}

TEST(DiscriminationGroup, ABlockOfWhichEveryAnswerIsSetAsideIsNotPassedOver) {
  HandMadeStudy study;
  add_people(study, {8});
  for (std::int64_t trial = 1; trial <= 20; ++trial) study.exclude(trial);
  const StudyResults of = results(study);
  const auto section = std::ranges::find(of.sections, "group_d", &ResultsSection::name);
  ASSERT_NE(section, of.sections.end());
  ASSERT_FALSE(section->excluded.empty());
  EXPECT_NE(section->excluded.back().reason.find("every answer in group_d is set aside"),
            std::string::npos);
}

}  // namespace discrimination_group_test
}  // namespace jnd::analysis
