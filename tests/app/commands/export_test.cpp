#include <gtest/gtest.h>

#include <algorithm>

#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

TEST(ExportCommand, WritesTheTablesAndRefusesAFolderThatIsNotEmpty) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const test_support::ProgramOptions options{.folder = temporary.path(), .environment = {}};
  write_file(temporary.path() / "tiny.json", kTinyStudy);
  ASSERT_EQ(test_support::run_program(
                {"simulate", "tiny.json", "--participants", "1", "--study", "a.study"}, options)
                .exit_code,
            0);
  const std::vector<std::string> words = {"export", "csv",        "a.study",
                                          "--out",  "out/of/way", "--recordings"};
  const ProgramOutcome outcome = test_support::run_program(words, options);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name : {"sessions.csv", "trials.csv", "presentations.csv", "events.csv",
                           "answers.csv", "codebook.csv", "recordings/0001.csv"}) {
    EXPECT_TRUE(fs::exists(temporary.path() / "out/of/way" / name)) << name;
  }
  const std::string before = read_file(temporary.path() / "out/of/way/trials.csv");
  const ProgramOutcome again = test_support::run_program(words, options);
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.err.find("nothing is overwritten"), std::string::npos);
  EXPECT_EQ(read_file(temporary.path() / "out/of/way/trials.csv"), before);
}

TEST(ExportCommand, CarriesOneRowAnAnsweredTrial) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const test_support::ProgramOptions options{.folder = temporary.path(), .environment = {}};
  write_file(temporary.path() / "tiny.json", kTinyStudy);
  ASSERT_EQ(test_support::run_program({"simulate", "tiny.json", "--participants", "3",
                                       "--study", "a.study", "--fast"},
                                      options)
                .exit_code,
            0);
  ASSERT_EQ(
      test_support::run_program({"export", "csv", "a.study", "--out", "o"}, options).exit_code,
      0);
  const std::string trials = read_file(temporary.path() / "o/trials.csv");
  EXPECT_EQ(std::count(trials.begin(), trials.end(), '\n'), 1 + 3 * kTinyTrials);
}

}  // namespace
}  // namespace jnd::app
