#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace matching_results_test {

constexpr char kToWater[] =
    R"({"name": "by_hand", "stages": [{"kind": "counterbalance", "name": "order",
  "arms": [{"name": "one", "stages": [{"kind": "block", "name": "match", "procedure": "matching",
    "standard_medium": "water", "standard_scale": [1, 4]}]}]}]})";
constexpr char kWithinViscous[] = R"({"name": "by_hand", "stages": [{"kind": "block",
  "name": "match", "procedure": "matching", "standard_medium": "viscous", "standard_viscosity_pa_s": [2]}]})";

StudyResults results(const HandMadeStudy& study) {
  return results_of(load_study(study.store()), {}, {.num_resamples = 100});
}

/// Adds a person whose matches are halved and doubled by the starting value, and one who is
/// certain.
void add_two_people(HandMadeStudy& study) {
  study.add("P01");
  study.match(1.0, 1.0, 2.0);
  study.match(1.0, 4.0, 8.0);
  study.match(4.0, 1.0, 4.0);
  study.match(4.0, 4.0, 16.0);
  study.add("P02");
  study.match(1.0, 1.0, 1.0);
  study.match(1.0, 4.0, 1.0);
  study.match(4.0, 1.0, 2.0);
  study.match(4.0, 4.0, 2.0);
}

TEST(MatchingResults, AreThoseWorkedByHand) {
  HandMadeStudy study(kToWater);
  add_two_people(study);
  const StudyResults all = results(study);
  // These are the geometric means of 4 and 1, and of 8 and 2.
  EXPECT_NEAR(value_of(all, "match.match_at_1"), 2.0, 1e-12);
  EXPECT_NEAR(value_of(all, "match.match_at_4"), 4.0, 1e-12);
  EXPECT_EQ(all.find("match.match_at_4")->unit, "Pa s");
  EXPECT_NE(all.find("match.match_at_4")->meaning.find("4 of water"), std::string::npos);
  // The people's matches are the geometric means of 4 and 8, and of 1 and 2: sqrt(32) and
  // sqrt(2).
  EXPECT_NEAR(value_of(all, "match.match"), std::sqrt(8.0), 1e-12);
  EXPECT_EQ(all.find("match.match")->unit, "Pa s");
  EXPECT_EQ(all.find("match.match")->n, 2);
  EXPECT_LT(all.find("match.match")->ci95.low.value(), std::sqrt(8.0));
  // The law goes from 2 at 1 to 4 at 4.
  EXPECT_NEAR(value_of(all, "match.k"), 2.0, 1e-9);
  EXPECT_NEAR(value_of(all, "match.a"), 0.5, 1e-9);
  // The first person has four deviations of ln 2 with 4 - 2 degrees of freedom, and the second
  // has none.
  EXPECT_NEAR(value_of(all, "match.match_sd_ln"), 0.5 * std::sqrt(2.0) * std::log(2.0), 1e-12);
  // The first person follows the starting value entirely, and the second not at all.
  EXPECT_NEAR(value_of(all, "match.starting_value_slope"), 0.5, 1e-12);
  EXPECT_EQ(value_of(all, "match.num_zeros"), 0.0);
}

TEST(MatchingResults, AreThereForEveryParticipant) {
  HandMadeStudy study(kToWater);
  add_two_people(study);
  const StudyResults all = results(study);
  const auto own = [&](const std::string& participant, const std::string& name) {
    for (const ParticipantEstimate& one : all.sections.front().participants) {
      if (one.participant == participant && one.name == name) return one.value;
    }
    return std::optional<double>();
  };
  EXPECT_NEAR(own("P01", "match.match_at_1").value(), 4.0, 1e-12);
  EXPECT_NEAR(own("P02", "match.match_at_4").value(), 2.0, 1e-12);
  EXPECT_NEAR(own("P02", "match.match").value(), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(own("P01", "match.starting_value_slope").value(), 1.0, 1e-12);
  EXPECT_NEAR(own("P02", "match.match_sd_ln").value(), 0.0, 1e-12);
}

TEST(MatchingResults, BetweenTwoUnitsThereIsNoRatio) {
  HandMadeStudy study(kToWater);
  add_two_people(study);
  EXPECT_EQ(results(study).find("match.ratio_to_standard"), nullptr);
}

TEST(MatchingResults, WithinAUnitTheRatioIsTheConstantError) {
  HandMadeStudy study(kWithinViscous);
  study.add("P01");
  study.match(2.0, 1.0, 1.0);
  study.match(2.0, 8.0, 4.0);
  study.add("P02");
  study.match(2.0, 1.0, 4.0);
  study.match(2.0, 8.0, 4.0);
  const StudyResults all = results(study);
  EXPECT_NEAR(value_of(all, "match.ratio_to_standard"), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(all.find("match.k"), nullptr) << "one standard makes no line";
  EXPECT_TRUE(std::ranges::any_of(all.sections.front().comparisons, [](const auto& one) {
    return one.name == "match: ln ratio_to_standard against 0, t";
  }));
}

TEST(MatchingResults, AMatchOfNothingHasNoLogarithmAndIsCounted) {
  HandMadeStudy study(kWithinViscous);
  study.add("P01");
  study.match(2.0, 1.0, 2.0);
  study.match(2.0, 8.0, 0.0);
  study.add("P02");
  study.match(2.0, 1.0, 0.0);
  const StudyResults all = results(study);
  EXPECT_NEAR(value_of(all, "match.match_at_2"), 2.0, 1e-12);
  EXPECT_EQ(value_of(all, "match.num_zeros"), 2.0);
  ASSERT_EQ(all.sections.front().excluded.size(), 1U);
  EXPECT_EQ(all.sections.front().excluded.front().participant, "P02");
}

TEST(MatchingResults, AMatchIsNoComparisonWithAReference) {
  HandMadeStudy study(kToWater);
  add_two_people(study);
  const StudyData data = load_study(study.store());
  ASSERT_EQ(data.blocks.size(), 1U);
  EXPECT_FALSE(data.blocks.front().compares());
  EXPECT_EQ(data.blocks.front().written.standard_medium, "water");
  EXPECT_EQ(data.blocks.front().standard_quantity(), "scale");
}

}  // namespace matching_results_test
}  // namespace jnd::analysis
