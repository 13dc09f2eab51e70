#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"

namespace jnd::app {
namespace stability_test {

using test_support::ProgramOutcome;

class StabilityCommandTest : public CommandTest {};

TEST_F(StabilityCommandTest, PrintsTheKeysOfTheContractAndKeepsTheSameInAFile) {
  const ProgramOutcome outcome = jnd(
      {"stability", "--rate-hz", "250", "--delay-s", "0.008", "--out", "map.json", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_file(temporary_.path() / "map.json"), outcome.out);
  const auto json = document(outcome.out);
  EXPECT_EQ(keys(json), (std::set<std::string>{"device", "made_by", "program_version",
                                               "limiter_knows_attachment", "limits"}));
  EXPECT_EQ(json["limiter_knows_attachment"], false);
  ASSERT_EQ(json["limits"].size(), 3U);
  EXPECT_EQ(keys(json["limits"][0]),
            (std::set<std::string>{"rate_hz", "extra_delay_s", "contact", "viscosity_pa_s",
                                   "viscosity_is_at_least", "stiffness_n_per_m",
                                   "stiffness_is_at_least"}));
  EXPECT_EQ(json["limits"][0]["contact"], "attached");
  EXPECT_EQ(json["limits"][2]["contact"], "detached");
  EXPECT_EQ(json["limits"][2]["rate_hz"], 250.0);
  EXPECT_LT(json["limits"][2]["viscosity_pa_s"], json["limits"][0]["viscosity_pa_s"]);
}

TEST_F(StabilityCommandTest, StoppedByCtrlCItKeepsNothing) {
  test_support::RunningProgram child({"stability", "--out", "map.json"}, options_);
  child.send_signal(SIGINT);
  const ProgramOutcome outcome = child.wait();
  // A signal that arrives before the program listens to it ends the program, which is as good.
  EXPECT_TRUE(outcome.exit_code == 1 || outcome.signal == SIGINT) << outcome.exit_code;
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(std::filesystem::exists(temporary_.path() / "map.json"));
}

TEST_F(StabilityCommandTest, ADeviceThatIsNoModelAndValuesOutOfRangeAreToldInOneSentence) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--device", "lumped"},
                                                {"--device", "phantom"},
                                                {"--rate-hz", "0"},
                                                {"--rate-hz", "1000,nan"},
                                                {"--delay-s", "0.021"},
                                                {"--jobs", "0"}}) {
    std::vector<std::string> all = {"stability"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramOutcome outcome = jnd(all);
    EXPECT_EQ(outcome.exit_code, 2) << words[0] << ' ' << words[1];
    EXPECT_EQ(sentence_flaw(outcome.err), "");
  }
}

TEST_F(StabilityCommandTest, AStudyPlannedForTheExoskeletonIsComparedWithItsMap) {
  const ProgramOutcome outcome =
      jnd({"plan", "viscosity_discrimination", "--device", "exoskeleton", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(keys(json["stability"]),
            (std::set<std::string>{"rate_hz", "attached", "detached", "remark"}));
  EXPECT_GT(json["stability"]["attached"]["viscosity_pa_s"], 30.0);
  for (const auto& entry : json["range"]) EXPECT_EQ(entry["stable"], true) << entry;
  const auto lumped = document(jnd({"plan", "short_tour", "--device", "lumped", "--json"}).out);
  EXPECT_TRUE(lumped["stability"].is_null());
}

TEST_F(StabilityCommandTest, AStimulusBeyondTheMapIsAProblemOfThePlan) {
  // The test writes its own map, which the program finds through the share folder.
  namespace fs = std::filesystem;
  const fs::path share = temporary_.path() / "share";
  fs::create_directories(share / "data/stability");
  fs::copy(test_support::source_folder() / "protocols", share / "protocols");
  fs::copy(test_support::source_folder() / "data/laboratories", share / "data/laboratories");
  const std::string limits =
      R"("extra_delay_s": 0, "stiffness_n_per_m": 5000, "stiffness_is_at_least": false,
         "viscosity_is_at_least": false)";
  write_file(share / "data/stability/exoskeleton.json",
             R"({"device": "exoskeleton", "limits": [
                 {"rate_hz": 833, "contact": "attached", "viscosity_pa_s": 20, )" +
                 limits +
                 R"(}, {"rate_hz": 833, "contact": "detached", "viscosity_pa_s": 3, )" +
                 limits + "}]}");
  options_.environment.push_back({"JND_SHARE", share.string()});
  const std::vector<std::string> plan = {"plan", "viscosity_discrimination", "--device",
                                         "exoskeleton"};
  const ProgramOutcome outcome = jnd(plan);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(sentence_flaw(outcome.err, {"stably", "20 Pa s", "weaken"}), "");
  EXPECT_NE(outcome.out.find("a finger that came off would be unstable above 3 Pa s"),
            std::string::npos)
      << outcome.out;
}

}  // namespace stability_test
}  // namespace jnd::app
