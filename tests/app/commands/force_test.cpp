#include <gtest/gtest.h>

#include <cmath>

#include "app/json_document.h"
#include "support/program.h"

namespace jnd::app {
namespace {

nlohmann::json force(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "force");
  arguments.emplace_back("--json");
  const test_support::ProgramOutcome outcome = test_support::run_program(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return document(outcome.out);
}

TEST(ForceCommand, PrintsTheKeysOfTheContractForEveryLaw) {
  for (const char* law : {"free", "water", "viscous", "viscous-stokes"}) {
    const auto json = force({law});
    EXPECT_EQ(keys(json), (std::set<std::string>{"total_n", "points", "drag_coefficient",
                                                 "reynolds_number"}))
        << law;
    ASSERT_EQ(json["points"].size(), 5U) << law;
    double sum = 0.0;
    for (const auto& point : json["points"]) {
      EXPECT_EQ(keys(point), (std::set<std::string>{"name", "share_ratio", "force_n"}));
      ASSERT_EQ(point["force_n"].size(), 3U);
      sum += point["force_n"][0].get<double>();
    }
    EXPECT_NEAR(sum, -json["total_n"].get<double>(), 1e-12) << law;
  }
}

TEST(ForceCommand, WaterAtOneMetrePerSecondHeadOnIsThePublishedForce) {
  EXPECT_NEAR(force({"water"})["total_n"].get<double>(), 6.585, 0.001);
}

TEST(ForceCommand, OpposesTheMotionAndShrinksWithItsSquare) {
  const auto json = force({"water", "--velocity-m-per-s", "0,-0.5,0", "--scale", "2"});
  EXPECT_NEAR(json["total_n"].get<double>(), 2.0 * 0.25 * 6.585, 0.001);
  for (const auto& point : json["points"]) {
    EXPECT_EQ(point["force_n"][0], 0.0);
    EXPECT_GT(point["force_n"][1], 0.0);
  }
}

TEST(ForceCommand, AtRestThereIsNoForceAndNoCoefficient) {
  const auto json = force({"water", "--velocity-m-per-s", "0,0,0"});
  EXPECT_EQ(json["total_n"], 0.0);
  EXPECT_TRUE(json["drag_coefficient"].is_null());
  EXPECT_TRUE(json["reynolds_number"].is_null());
  for (const auto& point : json["points"])
    EXPECT_EQ(point["force_n"], (nlohmann::json{0, 0, 0}));
}

TEST(ForceCommand, ArgumentsWithoutAFiniteForceAreWrongUsage) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"force", "water", "--velocity-m-per-s", "nan,0,0"},
           {"force", "water", "--velocity-m-per-s", "1,0,0,0"},
           {"force", "water", "--velocity-m-per-s", "1e308,0,0", "--json"},
           {"force", "water", "--angle-of-attack-rad", "nan"},
           {"force", "viscous", "--viscosity-pa-s", "-1"},
           {"force", "viscous", "--viscosity-pa-s", "inf"}}) {
    const test_support::ProgramOutcome outcome = test_support::run_program(words);
    EXPECT_EQ(outcome.exit_code, 2) << words.back();
    EXPECT_EQ(outcome.out, "") << words.back();
  }
}

TEST(ForceCommand, RefusesAnOptionThatTheLawHasNoUseFor) {
  const test_support::ProgramOutcome outcome =
      test_support::run_program({"force", "viscous", "--scale", "3"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("--scale: expected only with water"), std::string::npos);
}

}  // namespace
}  // namespace jnd::app
