#include <gtest/gtest.h>

#include <csignal>
#include <set>
#include <string>

#include "app/json_document.h"
#include "app/sentence.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace characterize_test {

using test_support::ProgramOutcome;
using test_support::run_program;
using test_support::RunningProgram;

TEST(CharacterizeCommand, RecoversTheModelsConstantsAndPrintsTheKeysOfTheContract) {
  const ProgramOutcome outcome = run_program({"characterize", "--repetitions", "1", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(keys(json),
            (std::set<std::string>{"device", "finger", "num_repetitions", "break_away",
                                   "break_away_extension_n", "break_away_abduction_n",
                                   "torque_sensors", "free_space"}));
  EXPECT_EQ(json["device"], "exoskeleton");
  EXPECT_EQ(json["finger"], "index");
  ASSERT_EQ(json["break_away"].size(), 5U);
  EXPECT_EQ(keys(json["break_away"][0]), (std::set<std::string>{"pose", "joint", "force_n"}));
  EXPECT_NEAR(json["break_away_extension_n"]["mean"], 0.40, 0.02);
  EXPECT_NEAR(json["break_away_abduction_n"]["mean"], 0.83, 0.025);
  ASSERT_EQ(json["torque_sensors"].size(), 3U);
  EXPECT_NEAR(json["torque_sensors"][0]["mean_relative_error_ratio"], 0.0356, 0.001);
  EXPECT_NEAR(json["torque_sensors"][1]["mean_relative_error_ratio"], 0.0889, 0.001);
  EXPECT_NEAR(json["torque_sensors"][2]["mean_relative_error_ratio"], 0.0083, 0.001);
  ASSERT_EQ(json["torque_sensors"][0]["weights"].size(), 5U);
  EXPECT_EQ(json["torque_sensors"][0]["weights"][4]["weight_kg"], 0.25);
  EXPECT_GT(json["free_space"]["viscosity_n_s_per_m"], 3.0);
  EXPECT_LT(json["free_space"]["viscosity_n_s_per_m"], 8.0);
}

TEST(CharacterizeCommand, ADeviceWithoutJointsSaysSoInOneSentence) {
  for (const char* device : {"lumped", "mouse"}) {
    const ProgramOutcome outcome = run_program({"characterize", "--device", device});
    EXPECT_EQ(outcome.exit_code, 3) << device;
    EXPECT_EQ(sentence_flaw(outcome.err, {device, "joints"}), "");
  }
}

TEST(CharacterizeCommand, WrongArgumentsAreToldInOneSentence) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--device", "phantom"},
                                                {"--finger", "ring"},
                                                {"--repetitions", "0"},
                                                {"--seed", "-1"}}) {
    std::vector<std::string> all = {"characterize"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramOutcome outcome = run_program(all);
    EXPECT_EQ(outcome.exit_code, 2) << words[0] << ' ' << words[1];
    EXPECT_EQ(sentence_flaw(outcome.err), "");
  }
}

TEST(CharacterizeCommand, IsStoppedByCtrlC) {
  RunningProgram child({"characterize", "--repetitions", "1000"});
  // A signal that arrives before the program listens to it ends the program, which is as good.
  child.send_signal(SIGINT);
  const ProgramOutcome outcome = child.wait();
  EXPECT_TRUE(outcome.exit_code == 1 || outcome.signal == SIGINT) << outcome.exit_code;
  EXPECT_EQ(outcome.out, "");
}

}  // namespace characterize_test
}  // namespace jnd::app
