#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "app/commands/fit_fixture.h"
#include "app/json_document.h"
#include "support/program.h"

namespace jnd::app {
namespace fit_group_test {

using test_support::ProgramOutcome;

class FitGroupCommandTest : public FitFixture {};

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

std::vector<std::string> with(std::vector<std::string> arguments,
                              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

const std::vector<std::string> kHierarchical = {"hierarchical", "--csv", "g.csv", "--reference",
                                                "8"};

TEST_F(FitGroupCommandTest, ALapseRateIsFreeUnlessItIsGiven) {
  table("g.csv", kGroup);
  const auto json = document(fit(kHierarchical).out);
  EXPECT_GE(json["lapse_rate"], 0.0);
  EXPECT_LT(json["lapse_rate"], 0.1);
  EXPECT_GT(json["lapse_rate_ci95"][1], json["lapse_rate"]);
  EXPECT_LE(json["lapse_rate_with_prior_ci95"][1], json["lapse_rate_ci95"][1]);
  EXPECT_GE(json["lapse_rate_without_prior"], json["lapse_rate"]);
  EXPECT_TRUE(json["conditions"][0]["weber_fraction_without_prior"].is_number());
  EXPECT_NE(json["method"].get<std::string>().find("lapse rate"), std::string::npos);
  const std::string text = fit(kHierarchical, /*as_json=*/false).out;
  EXPECT_NE(text.find("lapse rate"), std::string::npos) << text;
  EXPECT_NE(text.find("without its prior"), std::string::npos) << text;
  for (const char* lapse : {"free", "lapse"}) {
    const char* option = lapse == std::string("lapse") ? "--free" : "--lapse";
    EXPECT_EQ(document(fit(with(kHierarchical, {option, lapse})).out), json) << lapse;
  }
  const auto none = document(fit(with(kHierarchical, {"--lapse", "none"})).out);
  EXPECT_EQ(none["lapse_rate"], 0.0);
  EXPECT_TRUE(none["lapse_rate_ci95"][1].is_null());
  EXPECT_TRUE(none["conditions"][0]["weber_fraction_without_prior"].is_null());
  const auto some = document(fit(with(kHierarchical, {"--lapse", "0.05"})).out);
  EXPECT_EQ(some["lapse_rate"], 0.05);
  EXPECT_LT(some["conditions"][0]["weber_fraction"], none["conditions"][0]["weber_fraction"])
      << "with lapses the same answers are of steeper curves";
  EXPECT_EQ(fit(with(kHierarchical, {"--lapse", "0.5"})).exit_code, 2);
  EXPECT_EQ(fit(with(kHierarchical, {"--lapse", "some"})).exit_code, 2);
  EXPECT_EQ(fit(with(kHierarchical, {"--lapse", "none", "--free", "lapse"})).exit_code, 2);
}

TEST_F(FitGroupCommandTest, LevelsTooHardToTellLapsesAreACaution) {
  std::string hard = "participant,intensity,num_yes,num_trials\n";
  for (const char* person : {"A", "B", "C", "D"}) {
    for (const auto& [level, num_yes] : {std::pair{6, 14}, {7, 17}, {9, 22}, {10, 25}}) {
      hard += std::string(person) + "," + std::to_string(level) + "," +
              std::to_string(num_yes) + ",40\n";
    }
  }
  table("g.csv", hard);
  const auto json = document(fit(kHierarchical).out);
  ASSERT_EQ(json["conditions"][0]["cautions"].size(), 1U) << json;
  const std::string caution = json["conditions"][0]["cautions"][0];
  EXPECT_NE(caution.find("too hard"), std::string::npos) << caution;
  EXPECT_NE(caution.find("0.03"), std::string::npos) << caution;
  EXPECT_EQ(json["conditions"][0]["easy_ratio"], 0.0);
  EXPECT_NE(fit(kHierarchical, /*as_json=*/false).out.find("CAUTION: the levels are too hard"),
            std::string::npos);
  table("g.csv", kGroup);
  EXPECT_TRUE(document(fit(kHierarchical).out)["conditions"][0]["cautions"].empty());
}

TEST_F(FitGroupCommandTest, AGuessRateIsThatOfAForcedChoice) {
  // Right answers with two alternatives: half of what is not felt is right by guessing.
  std::string right = "participant,intensity,num_yes,num_trials\n";
  for (const auto& [person, shift] : {std::pair{"A", 0}, {"B", 2}, {"C", -2}}) {
    for (const auto& [level, num] : {std::pair{2, 21}, {4, 24}, {8, 30}, {16, 37}, {32, 40}}) {
      right += std::string(person) + "," + std::to_string(level) + "," +
               std::to_string(std::min(40, num + shift)) + ",40\n";
    }
  }
  table("g.csv", right);
  const auto half = document(fit(with(kHierarchical, {"--guess", "1/2"})).out);
  EXPECT_EQ(half["guess_rate"], 0.5);
  EXPECT_NEAR(half["conditions"][0]["pse"].get<double>(), 8.0, 1.5) << "three quarters right";
  const auto none = document(fit(kHierarchical).out);
  EXPECT_LT(none["conditions"][0]["pse"], 4.0) << "half right";
  ASSERT_EQ(none["warnings"].size(), 1U) << "no level lies below a half";
  EXPECT_NE(none["warnings"][0].get<std::string>().find("--guess"), std::string::npos);
  EXPECT_TRUE(half["warnings"].empty());
  EXPECT_NE(fit(kHierarchical, /*as_json=*/false).out.find("--guess"), std::string::npos);
  EXPECT_EQ(fit(with(kHierarchical, {"--guess", "1"})).exit_code, 2);
  table("g.csv", kGroup);
  EXPECT_TRUE(document(fit(kHierarchical).out)["warnings"].empty()) << "of yes and no";
}

TEST_F(FitGroupCommandTest, WhoAnswersTheWrongWayRoundIsNamed) {
  std::string text = kGroup;
  text += "D,d,5,9,10\nD,d,7,6,10\nD,d,10,4,10\nD,d,14,1,10\n";
  table("g.csv", text);
  const auto json = document(fit(kHierarchical).out);
  ASSERT_EQ(json["warnings"].size(), 1U) << json["warnings"];
  const std::string warning = json["warnings"][0];
  EXPECT_TRUE(warning.starts_with("D in d (p < 0.001) answers the wrong way round")) << warning;
  EXPECT_NE(fit(kHierarchical, /*as_json=*/false).out.find("note: D in d (p < 0.001)"),
            std::string::npos);
  for (const auto& one : json["participants"]) {
    const bool is_large = one["weber_fraction"] > 14.0 / 8.0 - 1.0;
    EXPECT_EQ(one["cautions"].size(), is_large ? 1U : 0U) << one;
    EXPECT_TRUE(is_large || one["participant"] != "D") << one;
    EXPECT_TRUE(one["reason"].is_null());
  }
}

TEST_F(FitGroupCommandTest, AColumnReferenceGoesBeforeTheOption) {
  table("g.csv",
        "participant,reference,intensity,num_yes,num_trials\n"
        "A,8,5,2,10\nA,8,7,4,10\nA,8,10,7,10\nA,8,14,9,10\n"
        "B,8,5,3,10\nB,8,7,4,10\nB,8,10,6,10\nB,8,14,8,10\n");
  const auto with_column = document(fit({"hierarchical", "--csv", "g.csv"}).out);
  EXPECT_EQ(with_column["status"], "ok");
  EXPECT_TRUE(with_column["warnings"].empty()) << with_column["warnings"];
  const auto beside = document(fit({"hierarchical", "--csv", "g.csv", "--reference", "9"}).out);
  ASSERT_EQ(beside["warnings"].size(), 1U);
  EXPECT_EQ(beside["warnings"][0],
            "the table's column reference is used, and --reference 9 is not");
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

/// Sessions of three people. The criterion of the first moves by whole standard deviations, and
/// the two others keep theirs.
constexpr char kSessions[] =
    "participant,session,intensity,num_yes,num_trials\n"
    "A,1,5,0,20\nA,1,7,0,20\nA,1,10,1,20\nA,1,14,5,20\n"
    "A,2,5,14,20\nA,2,7,19,20\nA,2,10,20,20\nA,2,14,20,20\n"
    "A,3,5,12,20\nA,3,7,18,20\nA,3,10,20,20\nA,3,14,20,20\n"
    "B,1,5,4,20\nB,1,7,8,20\nB,1,10,14,20\nB,1,14,18,20\n"
    "C,1,5,2,20\nC,1,7,7,20\nC,1,10,13,20\nC,1,14,19,20\n";

TEST_F(FitGroupCommandTest, SessionsThatScatterAreWarnedOf) {
  table("g.csv", kSessions);
  const auto json = document(fit({"hierarchical", "--csv", "g.csv", "--reference", "8"}).out);
  ASSERT_EQ(json["warnings"].size(), 1U) << json["warnings"];
  const std::string warning = json["warnings"][0];
  EXPECT_NE(warning.find("rows of the same person and level scatter"), std::string::npos);
  EXPECT_NE(warning.find("most of all those of A)"), std::string::npos) << warning;
}

TEST_F(FitGroupCommandTest, EffectsOfSessionsThatScatterAreWarnedOf) {
  table("g.csv", kSessions);
  const auto json = document(fit({"effects", "--csv", "g.csv", "--reference", "8"}).out);
  ASSERT_EQ(json["warnings"].size(), 1U) << json["warnings"];
  const std::string warning = json["warnings"][0];
  EXPECT_NE(warning.find("scatter more than independent"), std::string::npos) << warning;
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
  EXPECT_GT(json["slope"], json["slope_ci95"][0]);
  EXPECT_TRUE(json["warnings"].empty());
  const std::vector<std::string> far = {"effects", "--csv", "t.csv", "--reference", "2"};
  EXPECT_EQ(document(fit(far).out)["warnings"].size(), 1U);
  const std::string words = fit(far, /*as_json=*/false).out;
  EXPECT_TRUE(words.starts_with("  slope ")) << words;
  EXPECT_NE(words.find("note: the reference 2 lies outside the levels"), std::string::npos);
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

TEST_F(FitGroupCommandTest, FewAnswersWithAFreePseAreWidenedByACalibration) {
  table("few.csv", "intensity,num_yes,num_trials\n4,0,5\n6,1,5\n8,3,5\n11,4,5\n14,5,5\n");
  const auto few_told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"weber", "--csv",  "few.csv", "--reference",
                                      "8",     "--free", "pse"};
    words.insert(words.end(), more.begin(), more.end());
    return document(fit(words).out);
  };
  const auto plain = few_told({}), wider = few_told({"--calibration", "500"});
  EXPECT_NE(plain["warnings"].dump().find("--calibration 1000 widens them"), std::string::npos)
      << plain["warnings"];
  EXPECT_EQ(wider["warnings"].dump().find("--calibration"), std::string::npos);
  EXPECT_EQ(wider["weber_fraction"], plain["weber_fraction"]);
  EXPECT_TRUE(plain["calibration"].is_null());
  EXPECT_EQ(wider["calibration"]["n"], 500);
  EXPECT_GT(wider["calibration"]["weber_fraction_drop"], 1.93);
  EXPECT_GT(wider["weber_fraction_ci95"][1], plain["weber_fraction_ci95"][1]);
  EXPECT_LT(wider["weber_fraction_ci95"][0], plain["weber_fraction_ci95"][0]);
}

TEST_F(FitGroupCommandTest, AnEffectThatIsBeyondEveryNumberIsNoCertainty) {
  table("many.csv",
        "intensity,num_yes,num_trials\n1,170000,200000\n1.5,180000,200000\n"
        "2,190000,200000\n3,199000,200000\n");
  const ProgramOutcome outcome =
      fit({"effects", "--csv", "many.csv", "--reference", "2"}, false);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("p < 1e-300"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("p = 0:"), std::string::npos) << outcome.out;
}

TEST_F(FitGroupCommandTest, AnOrderOfTheIntervalsThatIsNotFittedIsWarnedOf) {
  table("o.csv",
        "participant,intensity,num_yes,num_trials,test_first\n"
        "A,5,2,10,1\nA,10,9,10,1\nA,5,0,10,0\nA,10,7,10,0\n"
        "B,5,3,10,1\nB,10,9,10,1\nB,5,1,10,0\nB,10,6,10,0\n");
  for (const std::string command : {"hierarchical", "weber"}) {
    const auto json = document(fit({command, "--csv", "o.csv", "--reference", "7"}).out);
    EXPECT_NE(json["warnings"].dump().find("jnd fit effects tells the effect of the order"),
              std::string::npos)
        << command << json["warnings"].dump();
  }
}

TEST_F(FitGroupCommandTest, AnOrderThatIsTheSameInAllAnswersOfAPersonIsNotWarnedOf) {
  table("o.csv",
        "participant,intensity,num_yes,num_trials,test_first\n"
        "A,5,2,10,1\nA,10,9,10,1\nB,5,1,10,0\nB,10,6,10,0\n");
  const auto json = document(fit({"hierarchical", "--csv", "o.csv", "--reference", "7"}).out);
  EXPECT_EQ(json["warnings"].dump().find("test_first"), std::string::npos)
      << json["warnings"].dump();
}

}  // namespace fit_group_test
}  // namespace jnd::app
