#include <gtest/gtest.h>

#include <cmath>

#include "app/json_document.h"
#include "support/program.h"

namespace jnd::app {
namespace force_test {

nlohmann::json force(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "force");
  arguments.emplace_back("--json");
  const test_support::ProgramOutcome outcome = test_support::run_program(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return document(outcome.out);
}

TEST(ForceCommand, PrintsTheKeysOfTheContractForEveryLaw) {
  for (const char* law : {"free", "water", "map", "lift", "viscous", "viscous-stokes",
                          "viscous-schiller-naumann", "ellipsoid"}) {
    // The speed is low enough for every law to hold.
    const auto json = force({law, "--velocity-m-per-s", "0.5,0,0"});
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
    EXPECT_NEAR(sum, -json["total_n"].get<double>(), 1e-12) << law << ", head on no lift";
  }
}

TEST(ForceCommand, TheMapOfTheThesisIsItsWater) {
  const double water = force({"water", "--angle-of-attack-rad", "0.7"})["total_n"];
  EXPECT_NEAR(force({"map", "--angle-of-attack-rad", "0.7"})["total_n"].get<double>(), water,
              1e-12);
  EXPECT_NEAR(
      force({"map", "--angle-of-attack-rad", "0.7", "--force-map", "thesis_fit.csv"})["total_n"]
          .get<double>(),
      water, 0.01);
}

TEST(ForceCommand, LiftIsAcrossTheMotion) {
  const auto json = force({"lift", "--angle-of-attack-rad", "0.7853981633974483"});
  // The plate: C_N = 2 pi sin / (4 + pi sin) = 0.71412 and C_L = C_N cos = 0.50496. The force
  // is 7.4 times C_L.
  EXPECT_NEAR(json["total_n"].get<double>(), 7.4 * 0.504962, 1e-5);
  for (const auto& point : json["points"])
    EXPECT_NEAR(point["force_n"][0].get<double>(), 0.0, 1e-12);
  EXPECT_TRUE(json["drag_coefficient"].is_null());
}

TEST(ForceCommand, AnEllipsoidIsHarderToMoveHeadOn) {
  const auto at = [](const char* angle) {
    return force({"ellipsoid", "--viscosity-pa-s", "5", "--angle-of-attack-rad",
                  angle})["total_n"]
        .get<double>();
  };
  EXPECT_GT(at("1.5707963267948966"), 1.1 * at("0"));
}

TEST(ForceCommand, SchillerAndNaumannAddToCreepingFlowAndSayWhereTheyEnd) {
  const auto json = force(
      {"viscous-schiller-naumann", "--viscosity-pa-s", "10", "--velocity-m-per-s", "0.1,0,0"});
  EXPECT_NEAR(json["reynolds_number"].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(json["total_n"].get<double>(), 1.15 * 1.776, 1e-12);
  EXPECT_NEAR(json["drag_coefficient"].get<double>(), 24.0 * 1.15, 1e-9);
  const test_support::ProgramOutcome thin = test_support::run_program(
      {"force", "viscous-schiller-naumann", "--viscosity-pa-s", "0.01", "--json"});
  EXPECT_EQ(thin.exit_code, 0);
  EXPECT_NE(thin.err.find("Reynolds number of at most 800"), std::string::npos);
  EXPECT_EQ(keys(document(thin.out)).size(), 4U);
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
           {"force", "map", "--force-map", "no_such_map.csv"},
           {"force", "ellipsoid", "--viscosity-pa-s", "-1"},
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
  EXPECT_EQ(test_support::run_program({"force", "water", "--force-map", "x"}).exit_code, 2);
  EXPECT_EQ(test_support::run_program({"force", "lift", "--viscosity-pa-s", "2"}).exit_code, 2);
}

}  // namespace force_test
}  // namespace jnd::app
