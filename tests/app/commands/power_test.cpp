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
namespace power_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using Words = std::vector<std::string>;

class PowerCommandTest : public CommandTest {
 protected:
  ProgramOutcome power(const Words& more, const std::string& study = "viscosity_discrimination",
                       const std::string& participants = "6,8..10") {
    Words words = {"power", study, "--participants", participants};
    words.insert(words.end(), more.begin(), more.end());
    return jnd(words);
  }
};

TEST_F(PowerCommandTest, PrintsPowerPrecisionAndDurationOfEverySize) {
  const ProgramOutcome outcome = power({"--runs", "60", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["study"], "viscosity_discrimination");
  EXPECT_EQ(json["simulated"], true);
  EXPECT_EQ(json["compare"], nlohmann::json({"group_d", "group_e"}));
  ASSERT_EQ(json["sizes"].size(), 3U);
  double before = 0.0;
  for (const auto& size : json["sizes"]) {
    const auto& test = size["tests"][0];
    EXPECT_EQ(test["primary"], false);
    EXPECT_EQ(test["meaning"], "quick, in place of the primary, hierarchical one");
    EXPECT_LE(test["power_ci95"][0], test["power"]);
    EXPECT_GE(test["power_ci95"][1], test["power"]);
    ASSERT_EQ(size["estimates"].size(), 2U);
    EXPECT_EQ(size["estimates"][0]["name"], "group_d.weber_fraction");
    EXPECT_NEAR(size["estimates"][0]["true_value"], 0.4279, 1e-4);
    EXPECT_GT(size["estimates"][0]["half_width_median"], 0.0);
    EXPECT_GT(size["total_duration_s"], before);
    before = size["total_duration_s"];
    const double mean_s = size["duration_per_participant_s"];
    EXPECT_NEAR(mean_s * size["participants"].get<int>(), before, 1e-6);
  }
  const ProgramOutcome table = power({"--runs", "60"});
  for (const char* part : {"SIMULATED", "paired, pse free, without degenerate participants",
                           "(quick, in place of the primary, hierarchical one)",
                           "true value 0.4279", "min per participant"}) {
    EXPECT_NE(table.out.find(part), std::string::npos) << part << " in\n" << table.out;
  }
}

TEST_F(PowerCommandTest, AnySplitGivesTheSameBytesAsOneProcess) {
  const ProgramOutcome whole = power({"--runs", "23", "--json", "--out", "whole"});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(read_file(path("whole/power.json")), whole.out);
  EXPECT_EQ(power({"--runs", "23", "--json", "--jobs", "5"}).out, whole.out);
  for (const int count : {1, 2, 5}) {
    Words merge = {"power-merge"};
    const std::string folder = "shards" + std::to_string(count);
    for (int i = count; i >= 1; --i) {  // Their order does not matter.
      const std::string shard = std::to_string(i) + "/" + std::to_string(count);
      const ProgramOutcome one = power({"--runs", "23", "--shard", shard, "--out", folder});
      ASSERT_EQ(one.exit_code, 0) << one.err;
      merge.push_back(folder + "/shard-" + std::to_string(i) + "-of-" + std::to_string(count) +
                      ".json");
    }
    const std::string out = "merged" + std::to_string(count);
    merge.insert(merge.end(), {"--json", "--out", out});
    const ProgramOutcome merged = jnd(merge);
    ASSERT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_EQ(merged.out, whole.out) << count;
    for (const char* file : {"power.json", "power.csv", "power_precision.csv", "power.gp"}) {
      EXPECT_EQ(read_file(path(out) / file), read_file(path("whole") / file)) << file;
    }
  }
}

TEST_F(PowerCommandTest, MagnitudesGiveExponentsAndNothingToCompare) {
  const ProgramOutcome outcome =
      power({"--runs", "20", "--json"}, "magnitude_of_virtual_water", "8");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_TRUE(json["compare"].is_null());
  const auto& size = json["sizes"][0];
  EXPECT_TRUE(size["tests"].empty());
  EXPECT_EQ(size["estimates"][0]["name"], "magnitude_estimation.own_exponents");
  // The estimates of 160 people have a standard deviation of about 0.15 and 0.25, so the bias
  // is tested at three standard errors.
  EXPECT_NEAR(size["estimates"][0]["bias"], 0.0, 0.04);
  EXPECT_NEAR(size["estimates"][1]["bias"], 0.0, 0.06);
  EXPECT_GT(size["estimates"][0]["coverage"], 0.75);
  EXPECT_GT(size["estimates"][1]["coverage"], 0.75);
}

TEST_F(PowerCommandTest, BlocksThatAreNotPlannedForAreNamed) {
  const std::vector<std::string> words = {
      "power", "viscosity_threshold", "--participants", "4", "--runs", "2"};
  EXPECT_EQ(jnd(words).exit_code, 2) << "nothing to plan for";
  const nlohmann::json study = nlohmann::json::parse(kTinyStudy);
  nlohmann::json with = study;
  with["stages"].push_back(nlohmann::json::parse(R"json({"kind": "block", "name": "least",
    "procedure": "staircase", "task": "yes_no", "medium": "viscous",
    "start_viscosity_pa_s": [2], "lowest_viscosity_pa_s": 0.1, "highest_viscosity_pa_s": 8,
    "step_ratio": [2], "max_reversals": 8,
    "instruction": {"en": "Feel."}, "question": {"en": "Anything?"}, "expected_trial_s": 5})json"));
  write_file(temporary_.path() / "with.json", with.dump());
  const ProgramOutcome text = jnd({"power", "with.json", "--participants", "4", "--runs", "2"});
  EXPECT_NE(text.out.find("Not planned for, but in the duration: least (staircase, yes_no)"),
            std::string::npos)
      << text.out << text.err;
}

TEST_F(PowerCommandTest, TheNullHypothesisIsRejectedInAboutFivePercent) {
  const ProgramOutcome outcome =
      power({"--runs", "2000", "--null", "--json"}, "viscosity_discrimination", "13");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto size = document(outcome.out)["sizes"][0];
  // With 2000 runs, 5 % with three standard deviations is 3.5 to 6.5 %.
  EXPECT_NEAR(size["tests"][0]["power"], 0.05, 0.015);
  EXPECT_NEAR(size["tests"][0]["mean_difference"], 0.0, 0.02);
  EXPECT_EQ(size["estimates"][0]["true_value"], size["estimates"][1]["true_value"]);
}

TEST_F(PowerCommandTest, WhereNothingDiffersSaysThatItsShareIsNoPower) {
  auto laboratory = nlohmann::json::parse(
      read_file(test_support::source_folder() / "data" / "laboratories" / "thesis.json"));
  laboratory["name"] = "no_viscosity_of_its_own";
  laboratory["device"]["mechanical_viscosity_n_s_per_m"]["value"] = 0.0;
  write_file(path("alike.json"), laboratory.dump());
  const Words words = {"--runs", "40", "--laboratory", "alike.json"};
  const ProgramOutcome table = power(words);
  ASSERT_EQ(table.exit_code, 0) << table.err;
  for (const char* part : {"True difference in ln ln(1 + w): ", "Nothing differs", "p < 0.05",
                           "WARNING: In this laboratory the Weber fractions of group_d and "
                           "group_e do not differ"}) {
    EXPECT_NE(table.out.find(part), std::string::npos) << part << " in\n" << table.out;
  }
  Words with_json = words;
  with_json.push_back("--json");
  const auto json = document(power(with_json).out);
  EXPECT_EQ(json["nothing_differs"], true);
  EXPECT_EQ(json["sizes"][0]["tests"][0]["power_is"], "false_positive_rate");
  EXPECT_NE(json["warnings"].dump().find("rate of false positives"), std::string::npos);
  const auto apart = document(power({"--runs", "4", "--json"}).out);
  EXPECT_EQ(apart["nothing_differs"], false);
  EXPECT_GT(apart["true_difference"], 0.2);
  EXPECT_EQ(apart["sizes"][0]["tests"][0]["power_is"], "power");
}

TEST_F(PowerCommandTest, AnotherObserverCostsPower) {
  const auto share = [&](const char* laboratory) {
    return document(power({"--runs", "200", "--laboratory", laboratory, "--json"},
                          "viscosity_discrimination", "8")
                        .out)["sizes"][0]["tests"][0]["power"]
        .get<double>();
  };
  EXPECT_GT(share("thesis"), share("misspecified") + 0.05);
}

TEST_F(PowerCommandTest, TheHierarchicalFitComesOnRequest) {
  const ProgramOutcome outcome =
      power({"--runs", "1", "--hierarchical", "--json"}, "viscosity_discrimination", "4");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto size = document(outcome.out)["sizes"][0];
  EXPECT_EQ(size["tests"].size(), 3U);
  EXPECT_EQ(size["estimates"].size(), 4U);
  EXPECT_GT(size["estimates"][1]["median"], 0.0);
}

TEST_F(PowerCommandTest, BadInputIsToldInOneSentence) {
  write_file(path("tiny.json"), kTinyStudy);
  write_file(path("empty.json"), R"json({"format": 1, "name": "empty", "languages": ["en"],
    "title": {"en": "E"}, "authors": ["A"],
    "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
    "stages": [{"kind": "break", "name": "rest", "instruction": {"en": "R"},
                "duration_s": 1}]})json");
  const std::string study = "viscosity_discrimination";
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"power", study, "--participants", "8,6"}, "ascending"},
      {{"power", study, "--participants", "0"}, "from 1 to 10000"},
      {{"power", study, "--participants", "6", "--runs", "0"}, "whole number from 1"},
      {{"power", study, "--participants", "6", "--compare", "group_d"}, "two names"},
      {{"power", study, "--participants", "6", "--compare", "group_d,group_x"}, "`group_x`"},
      {{"power", study, "--participants", "6", "--compare", "group_d,group_d"}, "twice"},
      {{"power", "tiny.json", "--participants", "6", "--compare", "comparison,estimation"},
       "magnitude_estimation"},
      {{"power", "tiny.json", "--participants", "6", "--null"}, "--null"},
      {{"power", "empty.json", "--participants", "6"},
       "empty: expected a block to plan for, one that estimates, produces, matches or rates, "
       "or "
       "compares by the task `reminder` or `two_interval`, found no block at all; add one"},
      {{"power", "viscosity_threshold", "--participants", "6"},
       "found only threshold_staircase (staircase, yes_no)"},
      {{"power", study, "--participants", "6", "--shard", "3/2", "--out", "x"}, "`3/2`"},
      {{"power", study, "--participants", "6", "--shard", "0/2", "--out", "x"}, "`0/2`"},
      {{"power", study, "--participants", "6", "--shard", "two", "--out", "x"}, "`two`"},
      {{"power", study, "--participants", "6", "--shard", "1/2"}, "--out"},
      {{"power", study}, "--participants"},
      {{"power-merge"}, "FILES"}};
  for (const auto& [words, part] : cases) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 2) << joined(words) << outcome.err;
    EXPECT_EQ(sentence_flaw(outcome.err, {part}), "") << joined(words);
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(path("x")));
  }
}

TEST_F(PowerCommandTest, ShardsThatDoNotBelongTogetherAreRefused) {
  const auto shard = [&](const std::string& which, const std::string& folder,
                         const std::string& seed) {
    ASSERT_EQ(power({"--runs", "4", "--shard", which, "--out", folder, "--seed", seed},
                    "viscosity_discrimination", "4")
                  .exit_code,
              0);
  };
  shard("1/2", "a", "1");
  shard("2/2", "a", "1");
  shard("2/2", "b", "2");
  shard("2/3", "c", "1");
  const std::string first = "a/shard-1-of-2.json", second = "a/shard-2-of-2.json";
  std::string cut = read_file(path(second));
  write_file(path("cut.json"), cut.substr(0, cut.size() / 2));
  write_file(path("junk.json"), "{\"kind\": \"jnd power shard\", \"format\": 1}");
  std::string fewer = cut;
  const std::size_t runs = fewer.find("\"runs\":[[");
  ASSERT_NE(runs, std::string::npos);
  write_file(path("fewer.json"), fewer.substr(0, runs) + "\"runs\":[]}\n");
  const std::vector<std::pair<Words, std::string>> cases = {
      {{first}, "shard 2 is missing"},
      {{first, first}, "every shard once"},
      {{first, second, second}, "every shard once"},
      {{first, "b/shard-2-of-2.json"}, "the same seed"},
      {{first, "c/shard-2-of-3.json"}, "one of 2 shards"},
      {{first, "cut.json"}, "cut.json: expected a whole file"},
      {{first, "junk.json"}, "junk.json: expected a whole file"},
      {{first, "fewer.json"}, "all runs of its shard"},
      {{first, "none.json"}, "none that can be read"},
      {{first, "a"}, "none that can be read"}};
  for (const auto& [files, part] : cases) {
    Words words = {"power-merge", "--out", "merged"};
    words.insert(words.end(), files.begin(), files.end());
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words);
    EXPECT_EQ(sentence_flaw(outcome.err, {part}), "") << joined(words);
    EXPECT_FALSE(fs::exists(path("merged")));
  }
}

TEST_F(PowerCommandTest, StoppedItLeavesNothingBehind) {
  for (const Words& more :
       {Words{"--out", "whole"}, Words{"--shard", "1/2", "--out", "shards"}}) {
    Words words = {"power",  "viscosity_discrimination", "--participants", "40", "--runs",
                   "1000000"};
    words.insert(words.end(), more.begin(), more.end());
    test_support::RunningProgram child(words, options_);
    child.send_signal(SIGINT);
    const ProgramOutcome outcome = child.wait();
    // A signal that arrives before the program listens to it ends the program, which is as
    // good.
    EXPECT_TRUE(outcome.exit_code == 1 || outcome.signal == SIGINT) << outcome.exit_code;
    EXPECT_TRUE(fs::is_empty(temporary_.path()));
  }
}

TEST_F(PowerCommandTest, TheResultsFolderIsNewOrEmpty) {
  write_file(path("taken"), "x");
  const ProgramOutcome outcome = power({"--runs", "1", "--out", "taken"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(sentence_flaw(outcome.err, {"nothing is overwritten"}), "");
}

}  // namespace power_test
}  // namespace jnd::app
