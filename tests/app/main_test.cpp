#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace main_test {

using test_support::ProgramOutcome;
using test_support::run_program;

class MainTest : public ::testing::Test {
 protected:
  ProgramOutcome jnd(const std::vector<std::string>& arguments) {
    return run_program(arguments, {.folder = temporary_.path(), .environment = {}});
  }
  test_support::TemporaryFolder temporary_;
};

TEST_F(MainTest, AloneWithoutADisplayItSaysSoInOneSentenceAndExitsWith3) {
  const ProgramOutcome outcome = jnd({});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  EXPECT_NE(outcome.err.find("display"), std::string::npos);
}

TEST_F(MainTest, HelpAndVersionAreNoErrors) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--help"}, {"--version"}, {"run", "--help"}, {"fit", "weber", "--help"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 0) << joined(words);
    EXPECT_NE(outcome.out, "") << joined(words);
    EXPECT_EQ(outcome.err, "") << joined(words);
  }
}

TEST_F(MainTest, ListsEverySubcommandInItsHelp) {
  const std::string help = jnd({"--help"}).out;
  for (const char* name :
       {"demo",    "validate", "schema",    "new",          "plan",
        "run",     "simulate", "resume",    "verify",       "results",
        "export",  "fit",      "compare",   "force",        "loop",
        "devices", "doctor",   "stability", "characterize", "device-simulator"}) {
    EXPECT_NE(help.find("\n  " + std::string(name) + " "), std::string::npos) << name;
    EXPECT_EQ(jnd({name, "--help"}).exit_code, 0) << name;
  }
}

TEST_F(MainTest, WithoutADisplayASessionNeedsToBeHeadless) {
  const ProgramOutcome outcome =
      jnd({"run", "short_tour", "--study", "s.study", "--participant", "P01"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("--headless"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(temporary_.path() / "s.study"));
}

TEST_F(MainTest, WhatIsAskedAboutHavingProblemsIsExit1AndStillPrintsOneDocument) {
  std::filesystem::create_directory(temporary_.path() / "empty.study");
  write_file(temporary_.path() / "broken.json", "{");
  const std::vector<std::vector<std::string>> kTroubled = {
      {"validate", "missing.json"},
      {"validate", "broken.json"},
      {"plan", "missing.json"},
      {"plan", "broken.json"},
      {"plan", "short_tour", "--study", "missing.study"},
      {"new", "missing/folder/name"},
      {"new", "name", "--from", "missing"},
      {"simulate", "broken.json", "--participants", "1", "--study", "s.study"},
      {"simulate", "short_tour", "--participants", "1", "--study", "s.study", "--laboratory",
       "missing"},
      {"verify", "empty.study"},
      {"results", "empty.study"},
      {"demo", "--laboratory", "missing", "--out", "d"},
  };
  for (std::vector<std::string> words : kTroubled) {
    const ProgramOutcome plain = jnd(words);
    EXPECT_EQ(plain.exit_code, 1) << joined(words);
    words.emplace_back("--json");
    const ProgramOutcome as_json = jnd(words);
    EXPECT_EQ(as_json.exit_code, 1) << joined(words);
    EXPECT_TRUE(document(as_json.out).is_object()) << joined(words);
  }
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"resume", "empty.study"}, {"export", "csv", "empty.study", "--out", "x"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words);
    EXPECT_EQ(outcome.out, "") << joined(words);
    EXPECT_NE(outcome.err.find("empty.study"), std::string::npos) << joined(words);
  }
}

TEST_F(MainTest, NamesThatAreNoUtf8AreNoFaultOfOurs) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"validate", "\xff.json", "--json"},
           {"plan", "\xff.json", "--json"},
           {"simulate", "\xff", "--participants", "1", "--study", "s.study", "--json"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words) << outcome.err;
    EXPECT_TRUE(document(outcome.out).is_object());
  }
}

TEST_F(MainTest, ALocaleWithDecimalCommasChangesNothing) {
  const auto in_locale = [&](const char* name, const std::vector<std::string>& words) {
    return run_program(words,
                       {.folder = temporary_.path(),
                        .environment = {{"LC_ALL", name}, {"LANG", name}, {"LANGUAGE", "de"}}});
  };
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"force", "water", "--scale", "0.5", "--velocity-m-per-s", "0.25,0,0", "--json"},
           {"fit", "between", "--k1", "0.6663", "--a1", "0.6386", "--k2", "0.3761", "--a2",
            "1.206", "--intensities", "0.5,1,2"},
           {"plan", "short_tour"},
           {"validate", "short_tour"}}) {
    const ProgramOutcome plain = in_locale("C", words);
    const ProgramOutcome german = in_locale("de_DE.UTF-8", words);
    EXPECT_EQ(plain.exit_code, 0) << joined(words) << plain.err;
    EXPECT_EQ(german.out, plain.out) << joined(words);
    EXPECT_EQ(german.exit_code, plain.exit_code) << joined(words);
  }
}

}  // namespace main_test
}  // namespace jnd::app
