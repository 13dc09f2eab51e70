#include <gtest/gtest.h>

#include "app/json_document.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace {

using test_support::ProgramOutcome;

class FitGroupCommandTest : public ::testing::Test {
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

constexpr char kGroup[] =
    "participant,condition,intensity,num_yes,num_trials\n"
    "A,d,5,2,10\nA,d,7,4,10\nA,d,10,7,10\nA,d,14,9,10\n"
    "A,e,5,1,10\nA,e,7,3,10\nA,e,10,8,10\nA,e,14,10,10\n"
    "B,d,5,3,10\nB,d,7,4,10\nB,d,10,6,10\nB,d,14,8,10\n"
    "B,e,5,1,10\nB,e,7,4,10\nB,e,10,6,10\nB,e,14,10,10\n"
    "C,d,5,1,10\nC,d,7,4,10\nC,d,10,7,10\nC,d,14,10,10\n"
    "C,e,5,0,10\nC,e,7,2,10\nC,e,10,8,10\nC,e,14,10,10\n";

TEST_F(FitGroupCommandTest, HierarchicalPrintsTheMedianPersonOfEachConditionAndTheDifference) {
  table("g.csv", kGroup);
  const ProgramOutcome outcome = fit({"hierarchical", "--csv", "g.csv", "--reference", "8"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["estimand"], "median person");
  EXPECT_EQ(json["num_participants"], 3);
  ASSERT_EQ(json["conditions"].size(), 2U);
  EXPECT_EQ(json["conditions"][0]["condition"], "d");
  EXPECT_GT(json["conditions"][0]["weber_fraction"], json["conditions"][1]["weber_fraction"]);
  ASSERT_EQ(json["differences"].size(), 1U);
  EXPECT_LT(json["differences"][0]["estimate"], 0.0);
  EXPECT_EQ(json["participants"].size(), 6U);
}

TEST_F(FitGroupCommandTest, ALapseRateIsFreeOnRequest) {
  table("g.csv", kGroup);
  const std::vector<std::string> fixed = {"hierarchical", "--csv", "g.csv", "--reference", "8"};
  EXPECT_TRUE(document(fit(fixed).out)["lapse_rate"].is_null());
  std::vector<std::string> free = fixed;
  free.insert(free.end(), {"--free", "lapse"});
  const auto json = document(fit(free).out);
  EXPECT_GE(json["lapse_rate"], 0.0);
  EXPECT_LT(json["lapse_rate"], 0.1);
  EXPECT_NE(json["method"].get<std::string>().find("lapse rate"), std::string::npos);
  EXPECT_NE(fit(free, /*as_json=*/false).out.find("lapse rate"), std::string::npos);
}

TEST_F(FitGroupCommandTest, AColumnReferenceGoesBeforeTheOption) {
  table("g.csv",
        "participant,reference,intensity,num_yes,num_trials\n"
        "A,8,5,2,10\nA,8,7,4,10\nA,8,10,7,10\nA,8,14,9,10\n"
        "B,8,5,3,10\nB,8,7,4,10\nB,8,10,6,10\nB,8,14,8,10\n");
  const auto with_column = document(fit({"hierarchical", "--csv", "g.csv"}).out);
  EXPECT_EQ(with_column["status"], "ok");
  EXPECT_NEAR(with_column["conditions"][0]["pse"].get<double>(), 8.0, 2.0);
}

TEST_F(FitGroupCommandTest, WithoutAnyReferenceItSaysSo) {
  table("g.csv", kGroup);
  const ProgramOutcome outcome = fit({"hierarchical", "--csv", "g.csv"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("--reference"), std::string::npos) << outcome.err;
  EXPECT_EQ(fit({"hierarchical", "--csv", "g.csv", "--reference", "0"}).exit_code, 2);
}

TEST_F(FitGroupCommandTest, OnePersonIsDegenerateWithTheReasonInJsonAndOnStderr) {
  table("g.csv", "participant,intensity,num_yes,num_trials\nA,5,2,10\nA,10,7,10\n");
  const ProgramOutcome outcome = fit({"hierarchical", "--csv", "g.csv", "--reference", "8"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(document(outcome.out)["status"], "degenerate");
  EXPECT_NE(outcome.err.find("fewer than two participants"), std::string::npos);
}

TEST_F(FitGroupCommandTest, EffectsOfTrialAndIntervalOrderComeWhereTheTableHasThem) {
  std::string text = "intensity,num_yes,num_trials,trial,test_first\n";
  const double intensities[] = {5, 7, 10, 14};
  for (int trial = 1; trial <= 40; ++trial) {
    const double x = intensities[trial % 4];
    const bool yes = (trial * 7 + static_cast<int>(x)) % 10 < (x > 8 ? 8 : 3);
    text += std::to_string(x) + (yes ? ",1,1," : ",0,1,") + std::to_string(trial) +
            (trial % 3 == 0 ? ",1\n" : ",0\n");
  }
  table("t.csv", text);
  const ProgramOutcome outcome = fit({"effects", "--csv", "t.csv", "--reference", "8"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  ASSERT_EQ(json["effects"].size(), 4U);
  EXPECT_EQ(json["effects"][1]["name"], "interval_order");
  EXPECT_TRUE(json["effects"][3]["p_value"].is_number());
  EXPECT_EQ(json["ci95_method"], "Wald");
  EXPECT_EQ(json["p_value_method"], "likelihood ratio");
}

constexpr char kAnswers[] =
    "intensity,num_yes,num_trials\n5,2,20\n8,10,20\n12,17,20\n20,20,20\n";

TEST_F(FitGroupCommandTest, WeberTakesOtherFamilies) {
  table("a.csv", kAnswers);
  const auto gauss =
      document(fit({"weber", "--csv", "a.csv", "--reference", "8", "--family", "gauss"}).out);
  EXPECT_EQ(gauss["family"], "gauss");
  EXPECT_NEAR(gauss["parameters"]["standard_deviation"].get<double>(),
              gauss["pse"].get<double>() * gauss["weber_fraction"].get<double>(), 1e-9);
  EXPECT_NE(gauss["weber_fraction_meaning"].get<std::string>().find("(x84.13 - pse) / pse"),
            std::string::npos);
  EXPECT_TRUE(gauss["pse_ci95"].is_array());
  const auto weibull =
      document(fit({"weber", "--csv", "a.csv", "--reference", "8", "--family", "weibull"}).out);
  EXPECT_GT(weibull["parameters"]["shape"], 1.0);
  EXPECT_EQ(fit({"weber", "--csv", "a.csv", "--reference", "8", "--family", "x"}).exit_code, 2);
}

TEST_F(FitGroupCommandTest, WeberTellsGoodnessPosteriorAndCorrectedBootstrap) {
  table("a.csv", kAnswers);
  const auto json =
      document(fit({"weber", "--csv", "a.csv", "--reference", "8", "--bootstrap", "200",
                    "--bootstrap-kind", "nonparametric", "--goodness", "100", "--posterior"})
                   .out);
  EXPECT_EQ(json["bootstrap"]["method"], "nonparametric, percentile");
  EXPECT_TRUE(json["bootstrap"]["bca_ci95"].is_array());
  EXPECT_EQ(json["goodness_of_fit"]["n"], 100);
  EXPECT_EQ(json["goodness_of_fit"]["residuals"].size(), 4U);
  EXPECT_EQ(json["posterior"]["status"], "ok");
  EXPECT_NE(json["posterior"]["priors"].get<std::string>().find("uniform"), std::string::npos);
  EXPECT_TRUE(json["warnings"].is_array());
}

}  // namespace
}  // namespace jnd::app
