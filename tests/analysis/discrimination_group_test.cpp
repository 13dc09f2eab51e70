#include "analysis/discrimination_group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/hand_made_study.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr ResultsOptions kQuick = {.num_resamples = 50, .seed = 1};

StudyResults results(const HandMadeStudy& study) {
  return results_of(load_study(study.store()), {}, kQuick);
}

const Estimate& estimate(const StudyResults& of, const std::string& name) {
  const Estimate* found = of.find(name);
  if (found == nullptr) throw core::Error("no estimate " + name);
  return *found;
}

/// Right answers of ten at 8 / 1.5 and at 8 * 1.5, for each participant.
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
  study.exclude(1);  // Of the last participant: a right "no".
  const StudyResults of = results(study);
  const double without = *estimate(of, "group_d.weber_fraction_ml").value;
  // 32 of 40 right with it, which put 84 % at 1.5^(1 / 0.8416).
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
  const Comparison paired = named("ln ln(1 + w), paired, without");
  EXPECT_NEAR(*named("hierarchical, pse at the reference").estimate, *paired.estimate, 0.1);
  EXPECT_EQ(named("Wilcoxon, without").num_a, 5);
  EXPECT_EQ(named("paired, pse free, without").status, FitStatus::kOk);
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

}  // namespace
}  // namespace jnd::analysis
