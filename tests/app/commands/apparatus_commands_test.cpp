#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/json_document.h"
#include "app/sentence.h"
#include "app/session/session_setup.h"
#include "app/tiny_study.h"
#include "experiments/protocol/study_reader.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace apparatus_commands_test {

using test_support::ProgramOutcome;
using test_support::run_program;

TEST(LoopCommand, PrintsTheKeysOfTheContract) {
  const ProgramOutcome outcome =
      run_program({"loop", "--seconds", "0.1", "--rate-hz", "500", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["rate_hz"], 500.0);
  EXPECT_GT(json["num_ticks"], 0);
  EXPECT_GE(json["missed_ticks"], 0);
  for (const char* key : {"lateness_us", "tick_cost_us"}) {
    EXPECT_EQ(keys(json[key]), (std::set<std::string>{"p50", "p99", "p999", "max"})) << key;
    EXPECT_LE(json[key]["p50"], json[key]["max"]) << key;
  }
  EXPECT_TRUE(json["scheduler"].is_string());
  EXPECT_TRUE(json["memory_locked"].is_boolean());
}

TEST(LoopCommand, SaysWhatItWasGivenAndLosesNoSample) {
  const ProgramOutcome outcome = run_program({"loop", "--seconds", "0.2", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["num_dropped_samples"], 0);
  EXPECT_GE(json["num_page_faults"], 0);
  ASSERT_FALSE(json["cpus"].empty());
  EXPECT_GE(json["cpus"][0], 0);
  EXPECT_EQ(json["priority"] == 80, json["scheduler"] == "SCHED_FIFO 80") << json;
  EXPECT_TRUE(json["cpus_kept_awake"].is_boolean());
  EXPECT_GT(json["cpu_time_ratio"], 0.0);
  // The loop spins for at most a fifth of a period, and a tick adds little to that.
  EXPECT_LT(json["cpu_time_ratio"], 0.5);
}

TEST(LoopCommand, APinnedLoopRunsOnItsCpuAlone) {
  const auto anywhere = document(run_program({"loop", "--seconds", "0.05", "--json"}).out);
  const int cpu = anywhere["cpus"].back();
  const ProgramOutcome outcome =
      run_program({"loop", "--seconds", "0.05", "--cpu", std::to_string(cpu), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(document(outcome.out)["cpus"], std::vector<int>{cpu});
}

TEST(LoopCommand, ACpuThatIsNotThereIsALackOfThisMachine) {
  const ProgramOutcome outcome = run_program({"loop", "--seconds", "0.05", "--cpu", "1000"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("CPU 1000"), std::string::npos) << outcome.err;
}

TEST(LoopCommand, APersonReadsAVerdict) {
  const ProgramOutcome outcome = run_program({"loop", "--seconds", "0.05"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("lateness"), std::string::npos);
  EXPECT_NE(outcome.out.find("0 samples lost"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("page faults"), std::string::npos) << outcome.out;
}

TEST(DevicesCommand, ListsTheSimulatedHand) {
  const ProgramOutcome outcome = run_program({"devices", "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = document(outcome.out);
  ASSERT_FALSE(json["devices"].empty());
  EXPECT_EQ(json["devices"][0]["name"], "lumped");
  EXPECT_EQ(json["devices"][0]["simulated"], true);
  EXPECT_NE(run_program({"devices"}).out.find("lumped"), std::string::npos);
}

TEST(DevicesCommand, ListsTheMouse) {
  const auto json = document(run_program({"devices", "--json"}).out);
  bool listed = false;
  for (const auto& device : json["devices"]) {
    if (device["name"] != "mouse") continue;
    listed = true;
    EXPECT_EQ(device["simulated"], true);
    EXPECT_EQ(device["max_total_force_n"], 30.0);
  }
  EXPECT_TRUE(listed) << json;
}

TEST(LoopCommand, AMouseThatNobodyMovesIsAHandAtRest) {
  const ProgramOutcome outcome =
      run_program({"loop", "--seconds", "0.1", "--device", "mouse", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(document(outcome.out)["device"], "mouse");
  EXPECT_GT(document(outcome.out)["num_ticks"], 0);
}

TEST(PlanCommand, ComparesWithTheLimitsOfTheMouse) {
  const ProgramOutcome outcome =
      run_program({"plan", "short_tour", "--device", "mouse", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(document(outcome.out)["problems"].empty());
}

TEST(ApparatusCommands, SimulatedParticipantsAreRefusedADeviceThatAPersonHasToMove) {
  const test_support::TemporaryFolder folder;
  const test_support::ProgramOptions here{.folder = folder.path(), .environment = {}};
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"run", "short_tour", "--study", "a.study", "--participant", "P01", "--headless",
            "--device", "mouse"},
           {"simulate", "short_tour", "--study", "a.study", "--participants", "1", "--device",
            "mouse"},
           {"demo", "--fast", "--out", "demo", "--device", "mouse"}}) {
    const auto outcome = test_support::run_program(words, here);
    EXPECT_EQ(outcome.exit_code, 2) << words[0];
    EXPECT_EQ(outcome.out, "") << words[0];
    EXPECT_EQ(outcome.err,
              "jnd: --device mouse: expected a device that moves by itself, for participants "
              "that are simulated, found one that a person has to move; choose another, see "
              "`jnd devices`\n")
        << words[0];
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ApparatusCommands, ASessionThatAPersonBeganWithAMouseIsNotResumedWithoutThem) {
  const test_support::TemporaryFolder folder;
  const std::filesystem::path file = write_file(folder.path() / "tiny.json", kTinyStudy);
  const experiments::Study study = experiments::read_study(file);
  {
    core::StudyStore store(folder.path() / "a.study", core::StudyStore::Mode::kCreate);
    (void)add_sessions(store, {.study = study, .study_file = file, .device = "mouse"}, {"P01"});
  }
  const auto outcome =
      run_program({"resume", (folder.path() / "a.study").string(), "--headless"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(sentence_flaw(outcome.err, {"session 1: expected a device that moves by itself"}),
            "");
}

TEST(DoctorCommand, SaysOfEveryLackWhatMendsIt) {
  const ProgramOutcome outcome = run_program({"doctor", "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = document(outcome.out);
  std::set<std::string> names;
  for (const auto& check : json["checks"]) {
    names.insert(check["name"]);
    EXPECT_EQ(check["remedy"].get<std::string>().empty(), check["ok"].get<bool>()) << check;
  }
  EXPECT_TRUE(names.contains("display"));
  for (const char* name : {"real-time priority", "memory lock", "kernel", "timer resolution",
                           "cpu governor", "idle states"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  const ProgramOutcome plain = run_program({"doctor"});
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_NE(plain.out.find("lacks display"), std::string::npos) << plain.out;
}

TEST(DoctorCommand, MissesTheShippedFilesWhereThereAreNone) {
  const auto json = document(
      run_program({"doctor", "--json"}, {.folder = {}, .environment = {{"JND_SHARE", "/none"}}})
          .out);
  bool found = false;
  for (const auto& check : json["checks"]) {
    if (check["name"] == "shipped studies") found = !check["ok"].get<bool>();
  }
  EXPECT_TRUE(found);
}

TEST(ApparatusCommands, ADeviceThatDoesNotStartIsToldAndNothingIsStoredForIt) {
  const test_support::TemporaryFolder folder;
  const test_support::ProgramOptions here{.folder = folder.path(), .environment = {}};
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"loop", "--device", "unplugged", "--seconds", "1"},
           {"run", "short_tour", "--study", "a.study", "--participant", "P01", "--headless",
            "--device", "unplugged"},
           {"simulate", "short_tour", "--study", "a.study", "--participants", "1", "--device",
            "unplugged"},
           {"demo", "--fast", "--out", "demo", "--device", "unplugged"}}) {
    const auto outcome = test_support::run_program(words, here);
    EXPECT_EQ(outcome.exit_code, 3) << words[0];
    EXPECT_EQ(outcome.out, "") << words[0];
    EXPECT_EQ(
        outcome.err,
        "jnd: unplugged: expected the device to answer, found nothing connected; check its "
        "cable, its power and its emergency stop, then try again\n")
        << words[0];
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace apparatus_commands_test
}  // namespace jnd::app
