#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/hand_made_study.h"
#include "analysis/results/planned_contrasts.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace contrast_reference_test {

// data/reference/contrasts/contrasts_reference.R says how R computed these numbers.

std::string study_text(const std::string& factors, const std::string& of) {
  const auto block = [](const std::string& fluid) {
    return R"({"kind": "block", "name": ")" + fluid +
           R"(", "procedure": "constant_stimuli", "medium": "viscous", "levels": {"fluid": ")" +
           fluid + R"("}, "viscosity_pa_s": [8, 32], "reference_viscosity_pa_s": 16,
           "repetitions": 5, "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
           "expected_trial_s": 10})";
  };
  return R"({"format": 1, "name": "times", "languages": ["en"], "title": {"en": "Times"},
    "authors": ["A. Author"], "factors": [{"name": "fluid", "levels": ["thin", "medium", "thick"]})" +
         factors + R"(], "contrasts": [{"name": "one", "measure": "response_time",
    "role": "primary", "of": )" +
         of + R"(}], "stages": [
    {"kind": "counterbalance", "name": "priming", "method": "one_of", "arms": [
      {"name": "primed", "stages": []}, {"name": "control", "stages": []}]},)" +
         block("thin") + ", " + block("medium") + ", " + block("thick") + "]}";
}

constexpr char kPriming[] = R"(, {"name": "priming", "levels": ["primed", "control"]})";

ContrastTest contrast(const nlohmann::json& reference, const std::string& factors,
                      const std::string& of) {
  HandMadeStudy study(study_text(factors, of));
  std::map<int, bool> known;
  for (const auto& row : reference["trials"]) {
    const int person = row[0];
    if (!known[person]) {
      study.add((person < 10 ? "P0" : "P") + std::to_string(person), false, "",
                "priming=" + row[1].get<std::string>());
      known[person] = true;
      for (const auto& trial : reference["trials"]) {
        if (trial[0] != person) continue;
        (void)study.answer({.block = trial[2],
                            .procedure = "constant_stimuli",
                            .quantity = "viscosity_pa_s",
                            .repetition = 1,
                            .intensity = 8.0,
                            .reference_intensity = 16.0,
                            .response = 0.0,
                            .measures = {.response_time_s = std::exp(trial[3].get<double>())}});
      }
    }
  }
  return planned_contrasts(load_study(study.store())).at(0).test;
}

void expect_as_in(const nlohmann::json& expected, const ContrastTest& found, bool with_df) {
  constexpr double kAgreed = 1e-4;
  const double estimate = expected["estimate"], error = expected["standard_error"];
  ASSERT_TRUE(found.effect) << found.reason;
  EXPECT_NEAR(std::log(*found.effect), estimate, kAgreed * std::abs(estimate));
  EXPECT_NEAR(std::log(*found.effect) / *found.statistic, error, kAgreed * error);
  if (with_df) {
    EXPECT_NEAR(*found.degrees_of_freedom, expected["df"], 1e-6);
  }
}

TEST(ContrastReference, OfOneGroupAreThoseOfLme4AndEmmeans) {
  const nlohmann::json reference =
      test_support::reference_data("contrasts/contrasts_reference.json");
  const auto& expected = reference["contrasts"];
  const ContrastTest pair = contrast(reference, "", R"({"fluid": {"thin": 1, "thick": -1}})");
  expect_as_in(expected["thin_thick_one_group"], pair, true);
  expect_as_in(expected["thin_thick_lmer"], pair, true);
  expect_as_in(expected["thin_against_both_one_group"],
               contrast(reference, "", R"({"fluid": {"medium": 1, "thick": 1, "thin": -2}})"),
               true);
}

// If people vary more in one group than in the other, the degrees of freedom are Welch's, and
// not those of one variance for all.
TEST(ContrastReference, OfTwoGroupsAreThoseOfLme4AndEmmeansWithWelchsDegreesOfFreedom) {
  const nlohmann::json reference =
      test_support::reference_data("contrasts/contrasts_reference.json");
  const auto& expected = reference["contrasts"];
  expect_as_in(expected["thin_thick_two_groups_lmer"],
               contrast(reference, kPriming, R"({"fluid": {"thin": 1, "thick": -1}})"), false);
  const ContrastTest interaction = contrast(
      reference, kPriming,
      R"({"fluid": {"thin": 1, "thick": -1}, "priming": {"primed": 1, "control": -1}})");
  expect_as_in(expected["interaction_lmer"], interaction, false);
  expect_as_in(expected["interaction_welch"], interaction, true);
}

}  // namespace contrast_reference_test
}  // namespace jnd::analysis
