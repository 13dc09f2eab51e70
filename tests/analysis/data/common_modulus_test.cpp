#include <gtest/gtest.h>

#include <cmath>

#include "analysis/hand_made_study.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace common_modulus_test {

std::string protocol(const std::string& keys) {
  return R"({"name": "by_hand", "stages": [{"kind": "block", "name": "estimation",
    "procedure": "magnitude_estimation", )" +
         keys + "}]}";
}

void estimate(HandMadeStudy& study, double intensity, double number) {
  (void)study.answer({.block = "estimation",
                      .procedure = "magnitude_estimation",
                      .quantity = "scale",
                      .repetition = 1,
                      .intensity = intensity,
                      .response = number});
}

StudyResults results(const HandMadeStudy& study, const Published& published = {}) {
  return results_of(load_study(study.store()), published, {.num_resamples = 100});
}

/// Adds two people with S = I^2. One of them answers in tens, the other in thousands.
void add_two_counts(HandMadeStudy& study) {
  study.add("P01");
  estimate(study, 1.0, 10.0);
  estimate(study, 2.0, 40.0);
  estimate(study, 4.0, 160.0);
  study.add("P02");
  estimate(study, 1.0, 1000.0);
  estimate(study, 2.0, 4000.0);
  estimate(study, 4.0, 16000.0);
}

TEST(CommonModulus, PeopleWhoCountInTheirOwnNumbersAreBroughtTogether) {
  HandMadeStudy study(protocol(R"("modulus": "free")"));
  add_two_counts(study);
  const StudyData data = load_study(study.store());
  // The geometric means of their numbers are 40 and 4000.
  EXPECT_NEAR(data.blocks.front().own_log_moduli.at("P01"), std::log(40.0), 1e-12);
  EXPECT_NEAR(data.blocks.front().own_log_moduli.at("P02"), std::log(4000.0), 1e-12);
  for (const ParticipantData& participant : data.participants) {
    EXPECT_NEAR(*participant.trials[0].response, 25.0, 1e-9);
    EXPECT_NEAR(*participant.trials[2].response, 400.0, 1e-9);
  }
  const StudyResults all = results(study);
  EXPECT_NEAR(all.find("estimation.a")->value.value(), 2.0, 1e-6);
  EXPECT_NEAR(all.find("estimation.modulus_sd_ln")->value.value(),
              std::log(100.0) / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(all.find("estimation.equalised.a"), nullptr) << "every fit is of equalised moduli";
}

TEST(CommonModulus, WithAStandardMagnitudesAreRatiosToIt) {
  HandMadeStudy study(protocol(
      R"("modulus": "standard", "standard_medium": "water", "standard_scale": [1],
         "modulus_value": 10)"));
  study.add("P01");
  estimate(study, 1.0, 10.0);
  estimate(study, 2.0, 40.0);
  study.add("P02");
  estimate(study, 1.0, 10.0);
  estimate(study, 2.0, 40.0);
  const StudyResults all = results(study);
  EXPECT_NEAR(all.find("estimation.k")->value.value(), 1.0, 1e-6);
  EXPECT_NEAR(all.find("estimation.a")->value.value(), 2.0, 1e-6);
  EXPECT_NE(all.find("estimation.mean_at_2")->meaning.find("the standard being 1"),
            std::string::npos);
}

TEST(CommonModulus, PercentOfWaterStaysAsItIs) {
  HandMadeStudy study(protocol(R"("medium": "water")"));
  study.add("P01");
  estimate(study, 1.0, 80.0);
  EXPECT_EQ(*load_study(study.store()).participants.front().trials.front().response, 80.0);
}

TEST(CommonModulus, NothingIsComparedInPercentOfWater) {
  const Published published{.values = {{"estimation.k", {.value = 0.67}}}};
  HandMadeStudy free(protocol(R"("modulus": "free")"));
  add_two_counts(free);
  const StudyResults without = results(free, published);
  EXPECT_FALSE(without.find("estimation.k")->published);
  bool says_so = false;
  for (const ExcludedParticipant& one : without.sections.front().excluded) {
    says_so = says_so || one.reason.find("percent of water") != std::string::npos;
  }
  EXPECT_TRUE(says_so);
  HandMadeStudy in_water(protocol(R"("medium": "water")"));
  add_two_counts(in_water);
  EXPECT_TRUE(results(in_water, published).find("estimation.k")->published);
}

TEST(CommonModulus, WithoutACommonStimulusNumbersStandAsTheyWereSaid) {
  HandMadeStudy study(protocol(R"("modulus": "free")"));
  study.add("P01");
  estimate(study, 1.0, 10.0);
  study.add("P02");
  estimate(study, 2.0, 1000.0);
  const StudyData data = load_study(study.store());
  EXPECT_TRUE(data.blocks.front().own_log_moduli.empty());
  EXPECT_EQ(*data.participants.front().trials.front().response, 10.0);
}

}  // namespace common_modulus_test
}  // namespace jnd::analysis
