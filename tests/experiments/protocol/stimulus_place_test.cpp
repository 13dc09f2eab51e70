#include "experiments/protocol/stimulus_place.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/experiments/protocol/broken_study.h"

namespace jnd::experiments {
namespace stimulus_place_test {

std::string pointer(const std::string& stage, const MediumSetting& setting,
                    const std::string& text = kSoundStudy) {
  return stimulus_pointer(nlohmann::json::parse(text), stage, setting);
}

TEST(StimulusPlace, IsTheNumberInTheListOfTheBlock) {
  EXPECT_EQ(pointer("estimation", {"water", "scale", 2.0}), "/stages/1/scale/2");
  EXPECT_EQ(pointer("comparison", {"viscous", "viscosity_pa_s", 20.0}),
            "/stages/2/arms/1/stages/0/viscosity_pa_s/1");
}

TEST(StimulusPlace, IsTheReferenceOrTheEndOfAnAdjustmentWhereOnlyTheseHaveIt) {
  EXPECT_EQ(pointer("comparison", {"viscous", "viscosity_pa_s", 16.0}),
            "/stages/2/arms/1/stages/0/reference_viscosity_pa_s");
  EXPECT_EQ(pointer("production", {"water", "scale", 8.0}),
            "/stages/2/arms/0/stages/0/max_scale");
}

TEST(StimulusPlace, IsNeverAStep) {
  EXPECT_EQ(pointer("production", {"water", "scale", 0.5}), "/stages/2/arms/0/stages/0");
}

TEST(StimulusPlace, IsTheOneOfItsMediumInAListOfMedia) {
  const std::string text = broken("\"stages\": [", R"("stages": [
    {"kind": "explore", "name": "media", "instruction": {"en": "E.", "de": "E."}, "media": [
      {"medium": "free_space", "duration_s": 5},
      {"medium": "viscous", "viscosity_pa_s": 30, "duration_s": 5},
      {"medium": "viscous_ellipsoid", "viscosity_pa_s": 30, "duration_s": 5}]},)");
  ASSERT_EQ(problems_of(text), "");
  EXPECT_EQ(pointer("media", {"viscous", "viscosity_pa_s", 30.0}, text),
            "/stages/0/media/1/viscosity_pa_s");
  EXPECT_EQ(pointer("media", {"viscous_ellipsoid", "viscosity_pa_s", 30.0}, text),
            "/stages/0/media/2/viscosity_pa_s");
  EXPECT_EQ(pointer("media", {"free_space", "", 0.0}, text), "/stages/0");
}

TEST(StimulusPlace, OfAStandardIsWhereTheStandardsStand) {
  const auto study = nlohmann::json::parse(R"({"stages": [{"kind": "block", "name": "match",
    "medium": "viscous", "viscosity_pa_s": [4, 8], "standard_medium": "viscous_stokes",
    "standard_viscosity_pa_s": [8, 4]}]})");
  EXPECT_EQ(stimulus_pointer(study, "match", {"viscous_stokes", "viscosity_pa_s", 8.0}),
            "/stages/0/standard_viscosity_pa_s/0");
  EXPECT_EQ(stimulus_pointer(study, "match", {"viscous", "viscosity_pa_s", 8.0}),
            "/stages/0/viscosity_pa_s/1");
}

TEST(StimulusPlace, IsNowhereForAnUnknownStage) {
  EXPECT_EQ(pointer("no_such_stage", {"water", "scale", 2.0}), "");
}

}  // namespace stimulus_place_test
}  // namespace jnd::experiments
