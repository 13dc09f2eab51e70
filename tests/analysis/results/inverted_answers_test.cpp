#include "analysis/results/inverted_answers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"

namespace jnd::analysis {
namespace inverted_answers_test {

StudyResults results(const StudyData& data) {
  return results_of(data, {}, {.num_resamples = 100});
}

/// Adds five people with 8 or 9 of ten right in both blocks, and P06, who mixes up the keys in
/// the first block.
void add_six(HandMadeStudy& study, int num_right_of_last = 1) {
  for (int i = 1; i <= 6; ++i) {
    study.add("P0" + std::to_string(i));
    study.compare_ten("group_d", i == 6 ? num_right_of_last : 8 + i % 2);
    study.compare_ten("group_e", 8 + i % 2);
  }
}

bool has(const std::vector<std::string>& cautions, const std::string& words) {
  return std::ranges::any_of(
      cautions, [&](const std::string& one) { return one.find(words) != std::string::npos; });
}

TEST(InvertedAnswers, AreThoseThatFallSignificantlyAndNoOthers) {
  HandMadeStudy study;
  add_six(study);
  const std::vector<InvertedAnswers> found = inverted_answers(load_study(study.store()));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].participant, "P06");
  EXPECT_EQ(found[0].block, "group_d");
  // Fisher's exact test: nine "more" of ten at the lower level, and one at the upper.
  EXPECT_NEAR(found[0].p_value, 0.000546666955335686, 1e-12);
}

TEST(InvertedAnswers, GuessingIsNotTheWrongWayRound) {
  HandMadeStudy study;
  add_six(study, 4);
  EXPECT_TRUE(inverted_answers(load_study(study.store())).empty());
}

TEST(InvertedAnswers, AreNamedAndEveryNumberThatHasThemSaysSo) {
  HandMadeStudy study;
  add_six(study);
  const StudyResults of = results(load_study(study.store()));
  const ResultsSection& block = section_of(of, "group_d");
  ASSERT_EQ(block.cautions.size(), 1U);
  EXPECT_EQ(block.cautions[0].participant, "P06");
  EXPECT_NE(block.cautions[0].caution.find("wrong way round"), std::string::npos);
  for (const char* name : {"group_d.weber_fraction", "group_d.weber_fraction_median_person",
                           "group_d.slope_sd_between_people"}) {
    EXPECT_TRUE(has(of.find(name)->cautions, "P06, who answers the wrong way round, is in it"))
        << name;
    EXPECT_EQ(of.find(name)->n, 6) << name;
  }
  const auto without = of.find("group_d.weber_fraction_median_person.without_degenerate");
  ASSERT_NE(without, nullptr);
  EXPECT_TRUE(without->cautions.empty());
  EXPECT_TRUE(section_of(of, "group_e").cautions.empty());
  EXPECT_TRUE(of.find("group_e.weber_fraction_median_person")->cautions.empty());
  bool any_test = false;
  for (const NamedComparison& named : section_of(of, "group_d_against_group_e").comparisons) {
    const bool has_everybody = named.name.find("hierarchical") != std::string::npos;
    EXPECT_EQ(has(named.cautions, "P06"), has_everybody) << named.name;
    any_test = any_test || has_everybody;
  }
  EXPECT_TRUE(any_test);
}

TEST(InvertedAnswers, LeftOutOnRequestAreNamedAndShownBesides) {
  HandMadeStudy study;
  add_six(study);
  StudyData data = load_study(study.store());
  const StudyResults with_all = results(data);
  leave_out_inverted(data);
  const StudyResults of = results(data);
  const ResultsSection& block = section_of(of, "group_d");
  EXPECT_TRUE(block.cautions.empty());
  EXPECT_TRUE(std::ranges::any_of(block.excluded, [](const ExcludedParticipant& one) {
    return one.participant == "P06" && one.reason.find("--inverted out") != std::string::npos;
  }));
  const Estimate& person = *of.find("group_d.weber_fraction_median_person");
  EXPECT_EQ(person.n, 5);
  EXPECT_TRUE(person.cautions.empty());
  EXPECT_LT(*person.value, *with_all.find(person.name)->value);
  EXPECT_EQ(of.find(person.name + ".with_excluded_trials")->n, 6);
  EXPECT_EQ(of.find("group_e.weber_fraction_median_person")->n, 6) << "that block is sound";
}

TEST(InvertedAnswers, WhoFeelsNothingWhereThereIsMoreIsNamed) {
  HandMadeStudy study(R"({"name": "by_hand", "stages": [
    {"kind": "block", "name": "felt", "procedure": "constant_stimuli", "task": "yes_no"}]})");
  for (int i = 1; i <= 2; ++i) {
    study.add("P0" + std::to_string(i));
    for (int trial = 0; trial < 20; ++trial) {
      const double intensity = 1.0 + trial % 4;
      const bool is_felt = (intensity > 2.0) == (i == 1);
      (void)study.answer({.block = "felt",
                          .procedure = "constant_stimuli",
                          .quantity = "viscosity_pa_s",
                          .intensity = intensity,
                          .response = is_felt ? 1.0 : 0.0});
    }
  }
  const StudyResults of = results(load_study(study.store()));
  ASSERT_EQ(section_of(of, "felt").cautions.size(), 1U);
  EXPECT_EQ(section_of(of, "felt").cautions[0].participant, "P02");
}

/// Adds three people. The last one gives smaller numbers for stronger stimuli, or sets smaller
/// intensities for larger targets.
void add_three(HandMadeStudy& study, bool production_falls) {
  for (int i = 1; i <= 3; ++i) {
    study.add("P0" + std::to_string(i));
    for (const double intensity : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0}) {
      const double percent = i == 3 && !production_falls ? 400.0 - 90.0 * intensity
                                                         : 100.0 + 5.0 * i + 50.0 * intensity;
      (void)study.answer({.block = "estimation",
                          .procedure = "magnitude_estimation",
                          .quantity = "scale",
                          .repetition = 1,
                          .intensity = intensity,
                          .response = percent});
    }
    for (const double target : {50.0, 60.0, 80.0, 100.0, 150.0, 200.0}) {
      const double set =
          i == 3 && production_falls ? 3.0 - 0.01 * target : 0.01 * target + 0.1 * i;
      (void)study.answer({.block = "production",
                          .procedure = "magnitude_production",
                          .quantity = "scale",
                          .repetition = 1,
                          .intensity = set,
                          .target_percent = target,
                          .response = set});
    }
  }
}

constexpr char kBothMagnitudes[] = R"({"name": "by_hand", "stages": [
  {"kind": "block", "name": "estimation", "procedure": "magnitude_estimation"},
  {"kind": "block", "name": "production", "procedure": "magnitude_production"}]})";

TEST(InvertedAnswers, MagnitudesThatFallAreNamedWhereverTheyCount) {
  HandMadeStudy study(kBothMagnitudes);
  add_three(study, false);
  const StudyData data = load_study(study.store());
  const std::vector<InvertedAnswers> found = inverted_answers(data);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].participant, "P03");
  EXPECT_EQ(found[0].block, "estimation");
  EXPECT_NEAR(found[0].p_value, 1.0 / 720.0, 1e-12) << "one order of six falls throughout";
  const StudyResults of = results(data);
  const ResultsSection& block = section_of(of, "estimation");
  ASSERT_EQ(block.cautions.size(), 1U);
  EXPECT_EQ(block.cautions[0].participant, "P03");
  EXPECT_NE(block.cautions[0].caution.find("the answers fall as the intensity grows"),
            std::string::npos);
  EXPECT_TRUE(has(own_of(block, "P03", "estimation.a").cautions, "wrong way round"));
  EXPECT_TRUE(own_of(block, "P01", "estimation.a").cautions.empty());
  for (const char* name :
       {"estimation.k", "estimation.a", "estimation.data_points.a", "estimation.log_log.a",
        "estimation.geometric.a", "estimation.equalised.a", "estimation.individual_a_mean",
        "estimation.individual_a_median", "estimation.mean_at_2", "combined.k", "combined.a"}) {
    EXPECT_TRUE(has(of.find(name)->cautions, "P03, who answers the wrong way round, is in it"))
        << name;
  }
  for (const char* name : {"estimation.num_zeros", "production.k", "production.a"}) {
    EXPECT_TRUE(of.find(name)->cautions.empty()) << name;
  }
}

TEST(InvertedAnswers, MagnitudesThatFallAreLeftOutOnRequest) {
  HandMadeStudy study(kBothMagnitudes);
  add_three(study, false);
  StudyData data = load_study(study.store());
  leave_out_inverted(data);
  const StudyResults of = results(data);
  EXPECT_TRUE(section_of(of, "estimation").cautions.empty());
  EXPECT_EQ(of.find("estimation.a")->n, 2);
  EXPECT_GT(*of.find("estimation.a")->value, 0.0);
  EXPECT_TRUE(of.find("estimation.a")->cautions.empty());
  EXPECT_EQ(of.find("production.a")->n, 3);
  EXPECT_EQ(of.find("combined.a")->n, 2);
  EXPECT_TRUE(std::ranges::any_of(
      section_of(of, "estimation").excluded, [](const ExcludedParticipant& one) {
        return one.participant == "P03" &&
               one.reason.find("--inverted out") != std::string::npos;
      }));
}

TEST(InvertedAnswers, IntensitiesSetThatFallWithTheTargetAreNamed) {
  HandMadeStudy study(kBothMagnitudes);
  add_three(study, true);
  const StudyResults of = results(load_study(study.store()));
  EXPECT_TRUE(section_of(of, "estimation").cautions.empty());
  ASSERT_EQ(section_of(of, "production").cautions.size(), 1U);
  EXPECT_NE(section_of(of, "production").cautions[0].caution.find("the intensities set fall"),
            std::string::npos);
  EXPECT_TRUE(has(of.find("production.a")->cautions, "P03"));
  EXPECT_TRUE(has(of.find("set_intensity.50_percent")->cautions, "P03"));
  EXPECT_TRUE(of.find("estimation.a")->cautions.empty());
}

TEST(InvertedAnswers, AMeanOfOwnExponentsIsNotOfWhoHasNone) {
  HandMadeStudy study(kBothMagnitudes);
  add_three(study, false);
  study.add("P04");
  for (int intensity = 0; intensity < 12; ++intensity) {
    // Only the answers to the two weakest stimuli are above 0, so the exponent falls without
    // bound.
    (void)study.answer({.block = "estimation",
                        .procedure = "magnitude_estimation",
                        .quantity = "scale",
                        .repetition = 1,
                        .intensity = static_cast<double>(intensity),
                        .response = intensity == 0   ? 900.0
                                    : intensity == 1 ? 500.0
                                                     : 0.0});
  }
  const StudyResults of = results(load_study(study.store()));
  EXPECT_FALSE(own_of(section_of(of, "estimation"), "P04", "estimation.a").value);
  EXPECT_TRUE(has(of.find("estimation.a")->cautions, "P03 and P04, who answer"));
  EXPECT_TRUE(has(of.find("estimation.individual_a_mean")->cautions, "P03, who answers"));
  EXPECT_FALSE(has(of.find("estimation.individual_a_mean")->cautions, "P04"));
}

}  // namespace inverted_answers_test
}  // namespace jnd::analysis
