#include <gtest/gtest.h>

#include <stdexcept>

#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "support/program.h"

namespace jnd::app {
namespace contrasts_test {

using test_support::ProgramOutcome;
using Words = std::vector<std::string>;

class ContrastsCommandTest : public CommandTest {
 protected:
  /// Returns the results of simulated people in the shipped study that has contrasts.
  nlohmann::json results_with(const Words& effects, const std::string& study,
                              int participants) {
    Words words = {"simulate",       "viscosity_priming",
                   "--participants", std::to_string(participants),
                   "--study",        study,
                   "--fast",         "--laboratory",
                   "thesis"};
    words.insert(words.end(), effects.begin(), effects.end());
    const ProgramOutcome simulated = jnd(words);
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
    const ProgramOutcome outcome = jnd({"results", study, "--resamples", "100", "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return document(outcome.out);
  }

  static const nlohmann::json& contrast(const nlohmann::json& results,
                                        const std::string& name) {
    for (const auto& one : results["contrasts"]) {
      if (one["name"] == name) return one;
    }
    throw std::out_of_range("no contrast " + name);
  }
};

TEST_F(ContrastsCommandTest, RecoverAnEffectThatWasPutInAndReportNoneWhereNoneIs) {
  const auto with =
      results_with({"--effect", "priming=primed:pse_factor=1.5"}, "with.study", 10);
  const auto& bias = contrast(with, "primed_against_unprimed");
  EXPECT_GT(bias["ci95"][0], 1.05) << bias["sentence"];
  EXPECT_LT(bias["p_value_adjusted"], 0.05);
  EXPECT_EQ(bias["effect_is"], "ratio");
  EXPECT_EQ(bias["equivalence"]["is_shown"], false);
  EXPECT_EQ(bias["n"], 10);
  EXPECT_EQ(with["laboratory_changed"], true) << "an effect is told as a change";
  // The simulation adds no effect on discrimination, but the device itself changes thin fluids.
  EXPECT_GT(contrast(with, "thin_against_thick")["effect"], 1.2);

  const auto without = results_with({}, "without.study", 6);
  const auto& none = contrast(without, "primed_against_unprimed");
  EXPECT_LT(none["ci95"][0], 1.0) << none["sentence"];
  EXPECT_GT(none["ci95"][1], 1.0);
  EXPECT_GT(none["p_value"], 0.05);
  EXPECT_GT(contrast(without, "fluid_by_priming")["p_value"], 0.05);
}

TEST_F(ContrastsCommandTest, StandFirstInTheTableAndOthersAreExploratory) {
  (void)results_with({}, "s.study", 4);
  const ProgramOutcome table = jnd({"results", "s.study", "--resamples", "100"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  const std::size_t planned = table.out.find("\nplanned contrasts\n");
  ASSERT_NE(planned, std::string::npos);
  EXPECT_LT(planned, table.out.find("in short:"));
  EXPECT_NE(table.out.find("thin_against_thick (primary): The Weber fraction was "),
            std::string::npos);
  EXPECT_NE(table.out.find("[exploratory, beside the planned contrasts]"), std::string::npos);
}

TEST_F(ContrastsCommandTest, HavePowerForAnEffectAndTheirLevelWithoutOne) {
  const auto power = [&](const Words& more) {
    Words words = {"power", "viscosity_priming", "--participants", "12", "--runs", "60",
                   "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return document(outcome.out);
  };
  const auto test_of = [](const nlohmann::json& json, const std::string& name) {
    for (const auto& test : json["sizes"][0]["tests"]) {
      if (test["name"] == name) return test;
    }
    throw std::out_of_range("no test " + name);
  };
  const auto with = power({"--effect", "priming=primed:pse_factor=1.8"});
  EXPECT_TRUE(with["compare"].is_null()) << "the study plans what is compared";
  EXPECT_GT(test_of(with, "primed_against_unprimed")["power"], 0.8);
  EXPECT_EQ(test_of(with, "primed_against_unprimed")["planned"], true);
  EXPECT_LT(test_of(with, "primed_against_unprimed: equivalence")["power"], 0.1);
  const auto without = power({"--null"});
  // In 60 runs without an effect, at most 9 reject with a probability of 99.8 %.
  EXPECT_LT(test_of(without, "primed_against_unprimed")["power"], 0.16);
  EXPECT_LT(test_of(without, "fluid_by_priming")["power"], 0.16);
  bool names_times = false;
  for (const auto& left_out : without["left_out"]) {
    names_times |=
        left_out.get<std::string>().find("time_for_thin_fluids") != std::string::npos;
  }
  EXPECT_TRUE(names_times);
}

TEST_F(ContrastsCommandTest, AnEffectThatIsWrittenWronglyIsWrongUsage) {
  for (const char* effect :
       {"priming", "priming=primed", "priming=primed:pse_factor=x", "priming=primed:size=2"}) {
    const ProgramOutcome outcome = jnd({"power", "viscosity_priming", "--participants", "4",
                                        "--runs", "2", "--effect", effect});
    EXPECT_EQ(outcome.exit_code, 2) << effect;
    EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
  }
  const ProgramOutcome unknown =
      jnd({"simulate", "viscosity_priming", "--participants", "1", "--study", "x.study",
           "--effect", "fluid=watery:pse_factor=2"});
  EXPECT_NE(unknown.exit_code, 0);
  EXPECT_NE(unknown.err.find("found `watery`"), std::string::npos) << unknown.err;
}

}  // namespace contrasts_test
}  // namespace jnd::app
