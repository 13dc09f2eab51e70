#include <gtest/gtest.h>

#include "app/json_document.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace {

using test_support::ProgramOutcome;

ProgramOutcome compared(const std::string& text, const char* test) {
  const test_support::TemporaryFolder temporary;
  write_file(temporary.path() / "t.csv", text);
  return test_support::run_program({"compare", "--csv", "t.csv", "--test", test, "--json"},
                                   {.folder = temporary.path(), .environment = {}});
}

constexpr char kPairs[] = "a,b\n1,0\n3,1\n4,3\n8,4\n";

TEST(CompareCommand, PrintsTheKeysOfTheContractForEveryTest) {
  for (const char* test : {"paired", "welch", "pearson", "wilcoxon"}) {
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
  // Differences 1, 2, 1, 4: mean 2, sd sqrt 2, t = 2 / (sqrt 2 / 2) = 2.828.
  const auto json = document(compared(kPairs, "paired").out);
  EXPECT_NEAR(json["estimate"].get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(json["statistic"].get<double>(), 2.8284271247461903, 1e-9);
  EXPECT_EQ(json["degrees_of_freedom"], 3.0);
  EXPECT_NEAR(json["cohen_dz"].get<double>(), 1.4142135623730951, 1e-9);
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

}  // namespace
}  // namespace jnd::app
