#include "analysis/fits/fit_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace jnd::analysis {
namespace fit_json_test {

TEST(FitJson, HoldsTheKeysOfTheContractWhetherThereIsAFitOrNot) {
  for (const std::int64_t num_yes : {4, 5}) {  // 5 of 5 is separated.
    const auto json =
        to_json(fit_psychometric({{2.0, num_yes, 5}}, {.reference = 1.0, .num_bootstrap = 10}));
    for (const char* key :
         {"status", "reason", "method", "weber_fraction", "weber_fraction_ci95",
          "standard_error", "log_likelihood", "deviance", "pse", "pse_ci95", "lapse_rate",
          "r_squared", "bootstrap"}) {
      EXPECT_TRUE(json.contains(key)) << key;
    }
    EXPECT_EQ(json["weber_fraction_ci95"].size(), 2U);
    EXPECT_EQ(json["status"], num_yes == 4 ? "ok" : "degenerate");
    EXPECT_EQ(json["weber_fraction"].is_null(), num_yes == 5);
    EXPECT_EQ(json["reason"].is_null(), num_yes == 4);
  }
}

TEST(FitJson, AnOpenEndAndAnythingNotFiniteAreNull) {
  PsychometricFit fit;
  fit.weber_fraction = HUGE_VAL;
  fit.weber_fraction_ci95 = {0.25, std::nullopt};
  fit.pse_ci95 = Interval{std::nullopt, 2.0};
  EXPECT_EQ(to_json(fit)["weber_fraction"], nullptr);
  EXPECT_EQ(to_json(fit)["weber_fraction_ci95"].dump(), "[0.25,null]");
  EXPECT_EQ(to_json(fit)["pse_ci95"].dump(), "[null,2.0]");
  EXPECT_EQ(to_json(fit)["bootstrap"], nullptr);
}

TEST(FitJson, NumbersComeBackToTheLastBit) {
  PowerFit fit;
  fit.k = 0.1 + 0.2;
  fit.excluded.push_back({4, {0.0, 1.5}, "why"});
  const auto json = nlohmann::json::parse(to_json(fit).dump());
  EXPECT_EQ(json["k"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(json["excluded"][0]["row"], 5);
  for (const char* key : {"status", "a", "k_standard_error", "a_standard_error", "r_squared"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
}

TEST(FitJson, OnlyThePairedTestHasAnEffectSize) {
  const auto paired = to_json(paired_t_test({1, 2, 4}, {0, 3, 2}));
  const auto welch = to_json(welch_t_test({1, 2, 4}, {0, 3}));
  EXPECT_TRUE(paired.contains("cohen_dz"));
  EXPECT_FALSE(welch.contains("cohen_dz"));
  for (const char* key :
       {"status", "estimate", "ci95", "statistic", "degrees_of_freedom", "p_value"}) {
    EXPECT_TRUE(paired.contains(key) && welch.contains(key)) << key;
  }
}

}  // namespace fit_json_test
}  // namespace jnd::analysis
