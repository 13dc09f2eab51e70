#include <gtest/gtest.h>

#include "app/json_document.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace {

using test_support::ProgramOutcome;

class FitCommandTest : public ::testing::Test {
 protected:
  ProgramOutcome fit(std::vector<std::string> arguments, bool as_json = true) {
    arguments.insert(arguments.begin(), "fit");
    if (as_json) arguments.emplace_back("--json");
    return test_support::run_program(arguments,
                                     {.folder = temporary_.path(), .environment = {}});
  }
  void table(const char* name, const std::string& text) const {
    write_file(temporary_.path() / name, text);
  }
  test_support::TemporaryFolder temporary_;
};

constexpr char kAnswers[] =
    "intensity,num_yes,num_trials\n5,2,20\n8,10,20\n12,17,20\n20,20,20\n";

TEST_F(FitCommandTest, WeberPrintsTheKeysOfTheContract) {
  table("a.csv", kAnswers);
  const ProgramOutcome outcome = fit({"weber", "--csv", "a.csv", "--reference", "8"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const auto json = document(outcome.out);
  for (const char* key : {"status", "reason", "method", "weber_fraction", "weber_fraction_ci95",
                          "standard_error", "log_likelihood", "deviance", "pse", "pse_ci95",
                          "lapse_rate", "r_squared", "bootstrap"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["method"], "ml");
  EXPECT_EQ(json["pse"], 8.0);
  EXPECT_EQ(json["lapse_rate"], 0.0);
  EXPECT_EQ(json["weber_fraction_ci95"].size(), 2U);
  EXPECT_LT(json["weber_fraction_ci95"][0], json["weber_fraction"]);
  EXPECT_GT(json["weber_fraction_ci95"][1], json["weber_fraction"]);
}

TEST_F(FitCommandTest, WeberTellsTheBootstrapAndIsReproducible) {
  table("a.csv", kAnswers);
  const std::vector<std::string> words = {
      "weber",  "--csv", "a.csv",       "--reference", "8",      "--free", "pse",
      "--free", "lapse", "--bootstrap", "50",          "--seed", "3"};
  const ProgramOutcome outcome = fit(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["bootstrap"]["n"], 50);
  EXPECT_TRUE(json["bootstrap"]["ci95"].is_array());
  EXPECT_TRUE(json["bootstrap"]["method"].is_string());
  EXPECT_TRUE(json["pse_ci95"].is_array());
  EXPECT_EQ(fit(words).out, outcome.out);
}

TEST_F(FitCommandTest, LeastSquaresTellsRSquared) {
  table("a.csv", kAnswers);
  const auto json =
      document(fit({"weber", "--csv", "a.csv", "--reference", "8", "--method", "lsq"}).out);
  EXPECT_EQ(json["method"], "lsq");
  EXPECT_GT(json["r_squared"], 0.9);
}

TEST_F(FitCommandTest, AWeberFractionThatDoesNotExistIsExit1WithItsJson) {
  table("a.csv", "intensity,num_yes,num_trials\n5,0,20\n20,20,20\n");
  const ProgramOutcome outcome = fit({"weber", "--csv", "a.csv", "--reference", "8"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = document(outcome.out);
  EXPECT_EQ(json["status"], "degenerate");
  EXPECT_TRUE(json["weber_fraction"].is_null());
  EXPECT_TRUE(json["reason"].is_string());
}

TEST_F(FitCommandTest, PowerPrintsTheKeysOfTheContract) {
  table("m.csv", "intensity,magnitude\n0,0\n1,2\n4,4\n9,6\n");
  const ProgramOutcome outcome = fit({"power", "--csv", "m.csv"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = document(outcome.out);
  for (const char* key :
       {"status", "k", "a", "k_standard_error", "a_standard_error", "r_squared", "excluded"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_NEAR(json["k"].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(json["a"].get<double>(), 0.5, 1e-9);
  EXPECT_TRUE(json["excluded"].empty());
  const auto log_log = document(fit({"power", "--csv", "m.csv", "--method", "loglog"}).out);
  EXPECT_EQ(log_log["excluded"].size(), 1U);
}

TEST_F(FitCommandTest, GroupsAreFittedOnTheirOwn) {
  table("m.csv", "who,intensity,magnitude\nx,1,2\nx,4,4\ny,1,3\ny,2,6\n");
  const auto json = document(fit({"power", "--csv", "m.csv", "--group-by", "who"}).out);
  ASSERT_EQ(json["groups"].size(), 2U);
  EXPECT_EQ(json["groups"][0]["group"]["who"], "x");
  EXPECT_NEAR(json["groups"][1]["a"].get<double>(), 1.0, 1e-9);
  EXPECT_TRUE(json["groups"][0]["k_standard_error"].is_null()) << "two rows";
}

TEST_F(FitCommandTest, BetweenThePublishedCurvesIsThePublishedCurve) {
  // Schmidt (2018), eq. D.3 to D.5: 0.5145 I^0.9021.
  const ProgramOutcome outcome =
      fit({"between", "--k1", "0.6663", "--a1", "0.6386", "--k2", "0.3761", "--a2", "1.206",
           "--intensities", "0,0.5,1,1.5,2,2.5,3,3.5,4"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = document(outcome.out);
  EXPECT_NEAR(json["k"].get<double>(), 0.5145, 0.01);
  EXPECT_NEAR(json["a"].get<double>(), 0.9021, 0.01);
}

TEST_F(FitCommandTest, BetweenRefusesWhatIsNoNumber) {
  for (const char* wrong : {"nan", "inf", "-inf"}) {
    const ProgramOutcome outcome = fit({"between", "--k1", "1", "--a1", "1", "--k2", "1",
                                        "--a2", wrong, "--intensities", "1,2"});
    EXPECT_EQ(outcome.exit_code, 2) << wrong;
    EXPECT_EQ(outcome.out, "") << wrong;
  }
}

TEST_F(FitCommandTest, TextSaysOpenEndsAndMissingIntervalsInWords) {
  table("one.csv", "intensity,num_yes,num_trials\n12,7,10\n");
  const std::string one = fit({"weber", "--csv", "one.csv", "--reference", "8"}, false).out;
  EXPECT_NE(one.find("1 level, 10 trials"), std::string::npos) << one;
  EXPECT_NE(one.find("not bounded by these data"), std::string::npos) << one;
  const std::string lsq =
      fit({"weber", "--csv", "one.csv", "--reference", "8", "--method", "lsq"}, false).out;
  EXPECT_NE(lsq.find("no interval: no degree of freedom is left"), std::string::npos) << lsq;
  EXPECT_EQ(lsq.find("standard error"), std::string::npos) << lsq;
  table("line.csv", "intensity,magnitude\n1,2\n2,4\n3,6\n4,8\n");
  const std::string line = fit({"power", "--csv", "line.csv"}, false).out;
  EXPECT_NE(line.find("no interval: the power law passes through every row"), std::string::npos)
      << line;
  table("three.csv", "intensity,magnitude\n1,-0.1\n2,2\n4,3\n");
  const std::string three = fit({"power", "--csv", "three.csv"}, false).out;
  EXPECT_NE(three.find("one degree of freedom is too few"), std::string::npos) << three;
  EXPECT_NE(three.find("below 0"), std::string::npos) << three;
}

TEST_F(FitCommandTest, AnEmptyGroupIsMarked) {
  table("m.csv", "who,intensity,magnitude\n,1,2\n,4,4\ny,1,3\ny,2,6\n");
  const std::string out = fit({"power", "--csv", "m.csv", "--group-by", "who"}, false).out;
  EXPECT_NE(out.find("who (empty)\n"), std::string::npos) << out;
}

TEST_F(FitCommandTest, HelpShowsListsAsTheyAreTakenAndWhatALapseRateIs) {
  const std::string weber = fit({"weber", "--help"}, false).out;
  EXPECT_EQ(weber.find("..."), std::string::npos) << weber;
  EXPECT_NE(weber.find("pse,lapse"), std::string::npos) << weber;
  EXPECT_NE(weber.find("lapse + (1 - 2 lapse) F"), std::string::npos) << weber;
  EXPECT_NE(weber.find("(x84.13 - pse) / pse"), std::string::npos) << weber;
  const std::string between = fit({"between", "--help"}, false).out;
  EXPECT_EQ(between.find("..."), std::string::npos) << between;
}

}  // namespace
}  // namespace jnd::app
