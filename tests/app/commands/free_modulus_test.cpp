#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "support/places.h"
#include "support/program.h"

// Tests a study as an author would derive it from the shipped one. People estimate with numbers
// of their own choice, in the order of a Williams square, with the eyes open and shut.

namespace jnd::app {
namespace free_modulus_test {

using test_support::ProgramOutcome;

class FreeModulusCommandTest : public CommandTest {
 protected:
  FreeModulusCommandTest() {
    std::ifstream file(test_support::source_folder() / "protocols" /
                       "viscosity_free_estimation.json");
    nlohmann::json study = nlohmann::json::parse(file);
    nlohmann::json stages = nlohmann::json::array();
    for (nlohmann::json& stage : study["stages"]) {
      if (stage["name"] != "numbers") continue;
      stage["order"] = {{"method", "williams"}};
      for (const char* vision : {"seen", "unseen"}) {
        stage["name"] = std::string("numbers_") + vision;
        stage["levels"] = {{"vision", vision}};
        stages.push_back(stage);
      }
    }
    study["stages"] = stages;
    study["name"] = "free_modulus";
    study.erase("$schema");
    study["factors"] = {{{"name", "vision"}, {"levels", {"seen", "unseen"}}}};
    study["contrasts"] = {{{"name", "steeper_when_seen"},
                           {"measure", "exponent"},
                           {"of", {{"vision", {{"seen", 1}, {"unseen", -1}}}}},
                           {"role", "primary"}}};
    std::ofstream(path("study.json")) << study.dump(1);
  }

  nlohmann::json contrast_with(const std::vector<std::string>& effect, const char* folder) {
    std::vector<std::string> words = {"simulate", "study.json", "--participants", "6",
                                      "--study",  folder,       "--fast"};
    words.insert(words.end(), effect.begin(), effect.end());
    const ProgramOutcome simulated = jnd(words);
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
    const ProgramOutcome results = jnd({"results", folder, "--resamples", "100", "--json"});
    EXPECT_EQ(results.exit_code, 0) << results.err;
    return document(results.out)["contrasts"].at(0);
  }
};

TEST_F(FreeModulusCommandTest, OverAWilliamsSquareAnEffectIsRecoveredAndNoneIsReported) {
  ASSERT_EQ(jnd({"validate", "study.json"}).exit_code, 0);
  const nlohmann::json with =
      contrast_with({"--effect", "vision=seen:exponent_difference=0.25"}, "with.study");
  EXPECT_GT(with["ci95"][0], 0.05) << with["sentence"];
  EXPECT_LT(with["ci95"][0], 0.25);
  EXPECT_GT(with["ci95"][1], 0.25);
  const nlohmann::json without = contrast_with({}, "without.study");
  EXPECT_LT(without["ci95"][0], 0.0) << without["sentence"];
  EXPECT_GT(without["ci95"][1], 0.0);
}

}  // namespace free_modulus_test
}  // namespace jnd::app
