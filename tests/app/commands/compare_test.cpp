#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/json_document.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace compare_test {

using test_support::ProgramOutcome;
using Words = std::vector<std::string>;

ProgramOutcome compared(const std::string& text, const char* test,
                        const std::vector<std::string>& more = {"--json"}) {
  const test_support::TemporaryFolder temporary;
  write_file(temporary.path() / "t.csv", text);
  std::vector<std::string> arguments = {"compare", "--csv", "t.csv", "--test", test};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test_support::run_program(arguments, {.folder = temporary.path(), .environment = {}});
}

constexpr char kPairs[] = "a,b\n1,0\n3,1\n4,3\n8,4\n";

TEST(CompareCommand, PrintsTheKeysOfTheContractForEveryTest) {
  for (const char* test : {"paired", "welch", "pearson", "wilcoxon", "ranksum"}) {
    const ProgramOutcome outcome = compared(kPairs, test);
    EXPECT_EQ(outcome.exit_code, 0) << test << outcome.err;
    const auto json = document(outcome.out);
    for (const char* key :
         {"status", "estimate", "ci95", "statistic", "degrees_of_freedom", "p_value"}) {
      EXPECT_TRUE(json.contains(key)) << test << ' ' << key;
    }
    EXPECT_EQ(json.contains("cohen_dz"), std::string(test) == "paired") << test;
    EXPECT_EQ(json["status"], "ok") << test;
  }
}

TEST(CompareCommand, PairedIsStudentsTOfTheDifferences) {
  // The differences are 1, 2, 1, 4. Their mean is 2, their sd sqrt 2, so t = 2 / (sqrt 2 / 2) =
  // 2.828.
  const auto json = document(compared(kPairs, "paired").out);
  EXPECT_NEAR(json["estimate"].get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(json["statistic"].get<double>(), 2.8284271247461903, 1e-9);
  EXPECT_EQ(json["degrees_of_freedom"], 3.0);
  EXPECT_NEAR(json["cohen_dz"].get<double>(), 1.4142135623730951, 1e-9);
}

constexpr char kLong[] =
    "who,fluid,w\nP1,thin,1\nP1,thick,0\nP2,thin,3\nP2,thick,1\nP3,thin,4\nP3,thick,3\n"
    "P4,thin,8\nP4,thick,4\nP5,thin,NA\nP5,thick,2\n";

TEST(CompareCommand, ATableInLongFormatGivesWhatItsColumnsWouldAndNamesWhoIsLeftOut) {
  const Words columns = {"--value", "w", "--by", "fluid", "--pair", "who"};
  Words words = columns;
  words.emplace_back("--json");
  const auto pairs = document(compared(kPairs, "paired").out);
  const auto json = document(compared(kLong, "paired", words).out);
  EXPECT_EQ(json["statistic"], pairs["statistic"]);
  EXPECT_EQ(json["conditions"], (std::vector<std::string>{"thin", "thick"}));
  EXPECT_EQ(json["incomplete"], (std::vector<std::string>{"P5"}));
  EXPECT_EQ(json["num_missing"], 1);
  words.insert(words.end(), {"--levels", "thick,thin"});
  EXPECT_EQ(document(compared(kLong, "paired", words).out)["estimate"], -2.0);
  // With two conditions, F is t squared.
  const auto anova = document(
      compared(kLong, "anova", {"--value", "w", "--by", "fluid", "--pair", "who", "--json"})
          .out);
  EXPECT_NEAR(anova["statistic"].get<double>(), 8.0, 1e-9);
  EXPECT_EQ(anova["p_value_greenhouse_geisser"], anova["p_value"]);
  const ProgramOutcome told = compared(kLong, "friedman", columns);
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_NE(told.out.find("left out, for they lack a condition: P5"), std::string::npos);
  EXPECT_NE(told.out.find("a cell is empty or NA: 1"), std::string::npos) << told.out;
}

TEST(CompareCommand, OptionsOfLongFormatThatDoNotFitAreToldInASentence) {
  for (const auto& [test, more, found] :
       {std::tuple{"anova", Words{}, "expected a table in long format, found no --value"},
        {"paired", {"--value", "w"}, "expected both or neither, found one"},
        {"paired",
         {"--value", "w", "--by", "fluid"},
         "says whose a value is with --test paired"},
        {"welch",
         {"--value", "w", "--by", "fluid", "--pair", "who"},
         "the groups are of different people with --test welch, found who"},
        {"sign", {"--levels", "thin,thick"}, "expected --value and --by with them"}}) {
    const ProgramOutcome outcome = compared(kLong, test, more);
    EXPECT_EQ(outcome.exit_code, 2) << test << outcome.err;
    EXPECT_NE(outcome.err.find(found), std::string::npos) << outcome.err;
  }
}

TEST(CompareCommand, TellsWhetherConditionsAreTheSameWithinAMargin) {
  // The differences are 1, 2, 1, 4. Their mean is 2 and its standard error sqrt(2) / 2. The 95
  // % quantile of t with 3 degrees of freedom is 2.3534.
  const auto within = document(
      compared(kPairs, "paired", {"--json", "--equivalence-margin", "4"}).out)["equivalence"];
  EXPECT_NEAR(within["estimate"].get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(within["ci90"][1].get<double>(), 2.0 + 2.3533634 * std::sqrt(0.5), 1e-6);
  EXPECT_EQ(within["is_equivalent"], true);
  const ProgramOutcome narrow = compared(kPairs, "paired", {"--equivalence-margin", "3"});
  EXPECT_EQ(narrow.exit_code, 0);
  EXPECT_NE(narrow.out.find("so that is not shown"), std::string::npos) << narrow.out;
  const ProgramOutcome zero = compared(kPairs, "paired", {"--equivalence-ratio", "2"});
  EXPECT_NE(zero.out.find("has no ratio"), std::string::npos) << zero.out;
  const ProgramOutcome ranks = compared(kPairs, "wilcoxon", {"--equivalence-margin", "3"});
  EXPECT_NE(ranks.exit_code, 0);
  EXPECT_NE(ranks.err.find("expected --test paired or welch"), std::string::npos) << ranks.err;
}

TEST(CompareCommand, ForWelchAnEmptyCellEndsTheShorterColumn) {
  const ProgramOutcome outcome = compared("a,b\n1,2\n2,4\n3,\n", "welch");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(document(outcome.out)["estimate"].get<double>(), -1.0, 1e-12);
  EXPECT_EQ(compared("a,b\n1,2\n2,4\n3,\n", "paired").exit_code, 1);
}

TEST(CompareCommand, WhatIsUndefinedIsDegenerateAndExit1NeverZeroOrNan) {
  for (const auto& [text, test] :
       std::vector<std::pair<const char*, const char*>>{{"a,b\n1,2\n", "paired"},
                                                        {"a,b\n1,1\n2,2\n", "paired"},
                                                        {"a,b\n1,2\n1,3\n1,4\n", "pearson"},
                                                        {"a,b\n1,1\n1,1\n", "welch"}}) {
    const ProgramOutcome outcome = compared(text, test);
    EXPECT_EQ(outcome.exit_code, 1) << test << text;
    const auto json = document(outcome.out);
    EXPECT_EQ(json["status"], "degenerate") << test << text;
    EXPECT_TRUE(json["p_value"].is_null()) << test << text;
  }
}

TEST(CompareCommand, GivesEffectSizesWithIntervalsThatHoldThem) {
  const auto inside = [](const nlohmann::json& json, const std::string& key) {
    const auto& ci95 = json[key + "_ci95"];
    return ci95[0] < json[key] && json[key] < ci95[1];
  };
  const auto paired = document(compared(kPairs, "paired").out);
  EXPECT_TRUE(inside(paired, "cohen_dz"));
  EXPECT_TRUE(inside(paired, "hedges_g"));
  EXPECT_TRUE(inside(document(compared(kPairs, "welch").out), "hedges_g"));
  const auto ranks = document(compared(kPairs, "ranksum").out);
  EXPECT_TRUE(ranks["rank_biserial"].is_number());
  EXPECT_TRUE(ranks["rank_biserial_ci95"].is_null()) << "the exact test has none";
  const auto spearman = document(compared("a,b\n1,0\n3,1\n4,3\n8,2\n9,9\n", "spearman").out);
  EXPECT_NEAR(spearman["estimate"].get<double>(), 0.9, 1e-12);
}

TEST(CompareCommand, TestsOfRanksNameTheirStatisticAndSayHowTheyCount) {
  const char* equal = "a,b\n2,1\n3,2\n4,3\n5,4\n6,5\n7,7\n";
  const auto json = document(compared(equal, "wilcoxon").out);
  EXPECT_EQ(json["statistic"], 0.0) << "the smaller sum, as the key always was";
  EXPECT_EQ(json["statistic_name"], "T");
  EXPECT_EQ(json["statistics"]["V"], 15.0);
  EXPECT_EQ(json["num_zeros"], 1);
  EXPECT_NEAR(json["p_value"].get<double>(), 0.0625, 1e-15);
  EXPECT_EQ(json["method"],
            "Wilcoxon's signed ranks, exact with ties, without 1 difference of 0");
  const ProgramOutcome people = compared(equal, "wilcoxon", {});
  for (const char* part : {"V, sum of ranks with a > b", "T, smaller sum of ranks", "0.0625",
                           "exact with ties, without 1 difference of 0"}) {
    EXPECT_NE(people.out.find(part), std::string::npos) << part << people.out;
  }
  const auto spearman = document(compared("a,b\n1,1\n2,8\n3,27\n4,64\n", "spearman").out);
  EXPECT_EQ(spearman["status"], "ok");
  EXPECT_EQ(spearman["statistic_name"], "S");
  EXPECT_NEAR(spearman["p_value"].get<double>(), 2.0 / 24.0, 1e-15);
  EXPECT_TRUE(spearman["degrees_of_freedom"].is_null());
}

constexpr char kGroups[] = "who,a,b\nx,1,0\ny,5,1\nx,3,1\ny,4,2\nx,4,3\ny,9,3\nx,8,4\n";

TEST(CompareCommand, GroupsAreTestedEachAndAdjustedByHolm) {
  const ProgramOutcome outcome = compared(kGroups, "paired", {"--group-by", "who", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  ASSERT_EQ(json["groups"].size(), 2U);
  const auto &x = json["groups"][0], &y = json["groups"][1];
  EXPECT_EQ(x["group"]["who"], "x");
  EXPECT_EQ(x["num_a"], 4);
  EXPECT_NEAR(x["statistic"].get<double>(), 2.8284271247461903, 1e-9) << "as by itself";
  EXPECT_EQ(y["num_a"], 3);
  const double smaller = std::min(x["p_value"].get<double>(), y["p_value"].get<double>());
  EXPECT_NEAR(std::min(x["p_value_holm"].get<double>(), y["p_value_holm"].get<double>()),
              2.0 * smaller, 1e-12);
  const ProgramOutcome people = compared(kGroups, "paired", {"--group-by", "who"});
  EXPECT_NE(people.out.find("who x"), std::string::npos) << people.out;
  EXPECT_NE(people.out.find("p adjusted by Holm"), std::string::npos) << people.out;
}

TEST(CompareCommand, OneGroupWithoutATestIsExit1AndLeavesTheOthers) {
  const ProgramOutcome outcome = compared("who,a,b\nx,1,0\nx,3,1\nx,4,1\ny,1,0\n", "paired",
                                          {"--group-by", "who", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("found none in 1 of 2"), std::string::npos) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["groups"][0]["status"], "ok");
  EXPECT_EQ(json["groups"][0]["p_value_holm"], json["groups"][0]["p_value"]);
  EXPECT_EQ(json["groups"][1]["status"], "degenerate");
  EXPECT_TRUE(json["groups"][1]["p_value_holm"].is_null());
}

TEST(CompareCommand, AnEmptyCellEndsAColumnOfItsGroupAlone) {
  const char* table = "who,a,b\nx,1,2\nx,2,4\nx,3,\ny,1,2\ny,,3\n";
  const auto json = document(compared(table, "welch", {"--group-by", "who", "--json"}).out);
  EXPECT_EQ(json["groups"][0]["num_a"], 3);
  EXPECT_EQ(json["groups"][0]["num_b"], 2);
  EXPECT_EQ(json["groups"][1]["num_a"], 1);
  const ProgramOutcome wrong =
      compared("who,a,b\nx,,2\nx,2,4\n", "welch", {"--group-by", "who", "--json"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find("t.csv:3"), std::string::npos) << wrong.err;
  const ProgramOutcome missing = compared(kPairs, "paired", {"--group-by", "who"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("who"), std::string::npos) << missing.err;
}

}  // namespace compare_test
}  // namespace jnd::app
