#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "support/files.h"
#include "support/places.h"
#include "support/program.h"

// Studies as an author would derive them from the shipped one: fluids are rated, and confidence
// is asked, with and without noise.

namespace jnd::app {
namespace rating_contrasts_test {

using nlohmann::json;
using test_support::ProgramOutcome;
using Words = std::vector<std::string>;

class RatingContrastsTest : public CommandTest {
 protected:
  RatingContrastsTest() {
    json study = json::parse(test_support::read_file(
        test_support::source_folder() / "protocols" / "viscosity_rating_with_confidence.json"));
    study.erase("$schema");
    json rates, compares;
    for (const json& stage : study["stages"]) {
      if (stage["name"] == "thickness") rates = stage;
      if (stage["name"] == "comparison") compares = stage;
    }
    rates.erase("questions");
    study["factors"] = {{{"name", "noise"}, {"levels", {"loud", "quiet"}}}};
    write("rating.json", study, rates, {{"measure", "rating"}, {"smallest_effect", 0.5}});
    write("sure.json", study, compares, {{"measure", "question"}, {"question", "confidence"}});
  }

  void write(const char* file, json study, json block, json contrast) {
    study["name"] = std::string(file).substr(0, std::string(file).find('.'));
    study["stages"] = json::array();
    for (const char* noise : {"loud", "quiet"}) {
      block["name"] = noise;
      block["levels"] = {{"noise", noise}};
      study["stages"].push_back(block);
    }
    contrast["name"] = "loud_against_quiet";
    contrast["role"] = "primary";
    contrast["of"] = {{"noise", {{"loud", 1}, {"quiet", -1}}}};
    study["contrasts"] = json::array({contrast});
    test_support::write_file(path(file), study.dump(1));
  }

  json contrast_of(const std::string& study, const Words& more, const char* folder) {
    Words words = {"simulate", study, "--participants", "6", "--study", folder, "--fast"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramOutcome simulated = jnd(words);
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
    const ProgramOutcome results = jnd({"results", folder, "--resamples", "100", "--json"});
    EXPECT_EQ(results.exit_code, 0) << results.err;
    return document(results.out)["contrasts"].at(0);
  }
};

TEST_F(RatingContrastsTest, OfRatingsRecoverAnEffectAndReportNoneWhereNoneIs) {
  ASSERT_EQ(jnd({"validate", "rating.json"}).exit_code, 0);
  const json with =
      contrast_of("rating.json", {"--effect", "noise=loud:rating_difference=1"}, "with.study");
  EXPECT_EQ(with["effect_is"], "difference");
  EXPECT_EQ(with["measure"], "rating");
  EXPECT_GT(with["ci95"][0], 0.5) << with["sentence"];
  // The simulated effect is 1, but nobody can rate above the last step.
  EXPECT_NEAR(with["effect"], 0.9, 0.3);
  EXPECT_LT(with["p_value"], 0.01);
  EXPECT_EQ(with["equivalence"]["is_shown"], false);
  const json without = contrast_of("rating.json", {}, "without.study");
  EXPECT_LT(without["ci95"][0], 0.0) << without["sentence"];
  EXPECT_GT(without["ci95"][1], 0.0);
  EXPECT_GT(without["p_value"], 0.05);
}

TEST_F(RatingContrastsTest, OfConfidenceRecoverAnEffectAndReportNoneWhereNoneIs) {
  ASSERT_EQ(jnd({"validate", "sure.json"}).exit_code, 0);
  const json with = contrast_of(
      "sure.json",
      {"--laboratory", "thesis_questions", "--effect", "noise=loud:weber_fraction_factor=4"},
      "with.study");
  EXPECT_EQ(with["question"], "confidence");
  EXPECT_LT(with["ci95"][1], -0.5) << "who feels less is less sure: " << with["sentence"];
  EXPECT_TRUE(with["sentence"].get<std::string>().starts_with(
      "The answer to the question confidence was "))
      << with["sentence"];
  const json without =
      contrast_of("sure.json", {"--laboratory", "thesis_questions"}, "without.study");
  EXPECT_LT(without["ci95"][0], 0.0) << without["sentence"];
  EXPECT_GT(without["ci95"][1], 0.0);
}

TEST_F(RatingContrastsTest, OfRatingsHavePowerForAnEffectAndTheirLevelWithoutOne) {
  const auto power = [&](const Words& more) {
    Words words = {"power", "rating.json", "--participants", "8", "--runs", "200", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return document(outcome.out);
  };
  const json with = power({"--effect", "noise=loud:rating_difference=1"});
  EXPECT_EQ(with["sizes"][0]["tests"][0]["name"], "loud_against_quiet");
  EXPECT_EQ(with["sizes"][0]["tests"][0]["effect_is"], "difference");
  EXPECT_GT(with["sizes"][0]["tests"][0]["power"], 0.9);
  EXPECT_NEAR(with["sizes"][0]["tests"][0]["mean_effect"], 0.9, 0.15);
  const json& loud = with["sizes"][0]["estimates"][0];
  EXPECT_EQ(loud["name"], "loud.rating");
  EXPECT_NEAR(loud["bias"], 0.0, 0.1);
  EXPECT_GT(loud["coverage"], 0.85);
  const json without = power({"--null"});
  // Of 200 runs, at most 21 are significant with a probability of 99.9 %.
  EXPECT_LE(without["sizes"][0]["tests"][0]["power"], 0.105);
  // If estimate and test come from one split, they equal those of one process.
  const ProgramOutcome confidence =
      jnd({"power", "sure.json", "--participants", "6", "--runs", "4"});
  EXPECT_NE(confidence.out.find("contrast loud_against_quiet (of a question after the trials)"),
            std::string::npos)
      << confidence.out << confidence.err;
}

TEST_F(RatingContrastsTest, AnEffectThatChangesNothingIsRefused) {
  for (const Words& words :
       {Words{"simulate", "rating.json", "--participants", "1", "--study", "x.study", "--fast"},
        Words{"power", "rating.json", "--participants", "4", "--runs", "2"}}) {
    Words with = words;
    with.insert(with.end(), {"--effect", "block=loud:magnitude_factor=1.3"});
    const ProgramOutcome outcome = jnd(with);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_EQ(sentence_flaw(outcome.err, {"effect on `block=loud`", "`rating_difference`",
                                          "found `magnitude_factor`"}),
              "");
  }
  EXPECT_FALSE(std::filesystem::exists(path("x.study")));
}

TEST_F(RatingContrastsTest, ArePreregisteredWithTheirQuestion) {
  const ProgramOutcome outcome = jnd({"preregister", "sure.json", "--participants", "6",
                                      "--exclusions", "Nobody is left out.", "--out", "plan"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string page = test_support::read_file(path("plan/preregistration.md"));
  EXPECT_NE(page.find("question confidence of"), std::string::npos) << page;
}

}  // namespace rating_contrasts_test
}  // namespace jnd::app
