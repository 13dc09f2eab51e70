#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/sentence.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace wrong_usage_test {

using test_support::ProgramOutcome;

struct Case {
  std::vector<std::string> words;
  std::vector<std::string> parts;  ///< Parts of the printed sentence.
};

class WrongUsageTest : public ::testing::Test {
 protected:
  void expect_wrong(const std::vector<Case>& cases) {
    for (const Case& one : cases) {
      const ProgramOutcome outcome = test_support::run_program(
          one.words, {.folder = temporary_.path(), .environment = {}});
      EXPECT_EQ(outcome.exit_code, 2) << joined(one.words) << '\n' << outcome.err;
      EXPECT_EQ(outcome.out, "") << joined(one.words);
      EXPECT_EQ(sentence_flaw(outcome.err, one.parts), "") << joined(one.words);
    }
    EXPECT_TRUE(std::filesystem::is_empty(temporary_.path())) << "wrong usage leaves no files";
  }

  static std::vector<std::string> run_words(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"run",           "short_tour", "--study",   "s.study",
                                      "--participant", "P01",        "--headless"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static std::vector<std::string> simulate_words(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"simulate", "short_tour", "--study", "s.study"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  test_support::TemporaryFolder temporary_;
};

TEST_F(WrongUsageTest, AnOptionIsNoValueOfTheOneBefore) {
  expect_wrong({
      {{"run", "short_tour", "--study", "--headless", "--participant", "P01"},
       {"--study: expected a value, found the option `--headless`"}},
      {{"backup", ".", "--to", "--json"},
       {"--to: expected a value, found the option `--json`"}},
  });
}

TEST_F(WrongUsageTest, AMisspeltSubcommandIsToldTheNearest) {
  expect_wrong({
      {{"rnu"}, {"expected a subcommand", "`rnu`", "did you mean `run`?"}},
      {{"simluate", "short_tour"}, {"did you mean `simulate`?"}},
      {{"reusme", "a.study"}, {"did you mean `resume`?"}},
      {{"zzzzzz"}, {"expected a subcommand", "`zzzzzz`", "see `jnd --help`"}},
      {{"fit", "wiber"}, {"fit: expected a subcommand", "did you mean `weber`?"}},
      {{"fit"}, {"fit: expected ", "weber", "between", "found none"}},
  });
}

TEST_F(WrongUsageTest, AMisspeltOptionIsToldTheNearestBeforeWhatItLeavesOut) {
  expect_wrong({
      {{"simulate", "--partcipants", "3"},
       {"`--partcipants`", "did you mean `--participants`?"}},
      {{"run", "short_tour", "--particpant", "P01", "--study", "s.study", "--headless"},
       {"run: ", "`--particpant`", "did you mean `--participant`?"}},
      {{"plan", "short_tour", "--jsno"}, {"plan: ", "did you mean `--json`?"}},
      {{"--jsno"}, {"`--jsno`"}},
      {{"--json"}, {"`--json`"}},
      {{"fit", "weber", "--refrence", "1"}, {"fit weber: ", "did you mean `--reference`?"}},
  });
}

TEST_F(WrongUsageTest, NumbersWithJunkAreRefusedWithTheRange) {
  expect_wrong({
      {simulate_words({"--participants", "3x"}),
       {"--participants: expected a whole number from 1 to 100000, found `3x`"}},
      {simulate_words({"--participants", "0"}), {"from 1 to 100000", "`0`"}},
      {simulate_words({"--participants", "-3"}), {"`-3`"}},
      {simulate_words({"--participants", "1e3"}), {"`1e3`"}},
      {simulate_words({"--participants", "0x10"}), {"`0x10`"}},
      {simulate_words({"--participants", " 3"}), {"` 3`"}},
      {simulate_words({"--participants", ""}), {"simulate: "}},
      {simulate_words({"--participants", "3", "--seed", "-1"}),
       {"--seed: expected a whole number", "`-1`"}},
      {simulate_words({"--participants", "3", "--seed", "1.5"}), {"--seed: ", "`1.5`"}},
      {simulate_words({"--participants", "3", "--seed", "18446744073709551616"}),
       {"--seed: expected a whole number", "`18446744073709551616`"}},
      {simulate_words({"--participants", "3", "--jobs", "0"}), {"--jobs: ", "from 1", "`0`"}},
      {simulate_words({"--participants", "3", "--jobs", "two"}), {"--jobs: ", "`two`"}},
      {run_words({"--seed", "-1"}), {"run: --seed: ", "`-1`"}},
      {run_words({"--seed", "nan"}), {"--seed: ", "`nan`"}},
      {{"plan", "short_tour", "--speed-m-per-s", "nan"}, {"expected a number", "`nan`"}},
      {{"plan", "short_tour", "--speed-m-per-s", "inf"}, {"expected a number", "`inf`"}},
      {{"plan", "short_tour", "--speed-m-per-s", "1e999"}, {"expected a number", "`1e999`"}},
      {{"plan", "short_tour", "--speed-m-per-s", "0,5"}, {"expected a number", "`0,5`"}},
      {{"plan", "short_tour", "--participants", "3x"}, {"--participants: "}},
      {{"demo", "--jobs", "0"}, {"demo: --jobs: ", "`0`"}},
      {{"demo", "--seed", "99999999999999999999"}, {"demo: --seed: "}},
      {{"results", ".", "--resamples", "1"}, {"--resamples: ", "from 100"}},
      {{"resume", ".", "--session", "0"}, {"--session: ", "`0`"}},
      {{"resume", ".", "--session", "1x"}, {"--session: ", "`1x`"}},
      {{"loop", "--seconds", "0"}, {"--seconds"}},
      {{"loop", "--rate-hz", "nan"}, {"--rate-hz"}},
      {{"loop", "--cpu", "-1"}, {"--cpu"}},
      {{"force", "water", "--scale", "x"}, {"--scale: expected a number, found `x`"}},
  });
}

TEST_F(WrongUsageTest, WhatIsMissingIsNamed) {
  expect_wrong({
      {{"run", "short_tour", "--study", "s.study", "--headless"},
       {"run: expected --participant, found none", "see `jnd run --help`"}},
      {{"run", "--study", "s.study", "--participant", "P01", "--headless"},
       {"run: expected FILE, found none"}},
      {{"run", "short_tour", "--participant", "P01", "--headless"},
       {"run: expected --study, found none"}},
      {simulate_words({}), {"simulate: expected --participants, found none"}},
      {simulate_words({"--participants"}),
       {"--participants: expected a value after it, found none"}},
      {{"verify"}, {"verify: expected DIR"}},
      {{"resume"}, {"resume: expected DIR"}},
      {{"results"}, {"results: expected DIR"}},
      {{"export"}, {"export: expected FORMAT"}},
      {{"export", "csv"}, {"export: expected DIR"}},
      {{"export", "csv", "."}, {"export: expected --out"}},
      {{"plan"}, {"plan: expected FILE"}},
      {{"validate"}, {"validate: expected FILE"}},
      {{"new"}, {"new: expected NAME"}},
      {{"force"}, {"force: expected law"}},
      {{"compare"}, {"compare: expected --csv"}},
      {{"backup"}, {"backup: expected DIR"}},
      {{"backup", "."}, {"backup: expected --to"}},
      {{"withdraw", "."}, {"withdraw: expected --participant"}},
      {{"exclude", ".", "--reason", "x"}, {"exclude: expected --trial"}},
      {{"exclude", ".", "--trial", "1"}, {"exclude: expected --reason"}},
      {{"unblind", "."}, {"unblind: expected --reason"}},
      {{"fit", "weber"}, {"fit weber: expected --csv"}},
      {{"fit", "power"}, {"fit power: expected --csv"}},
      {{"fit", "between"}, {"fit between: expected --"}},
  });
}

TEST_F(WrongUsageTest, WhatDoesNotExistIsNamed) {
  expect_wrong({
      {{"verify", "missing.study"}, {"DIR: expected a folder", "`missing.study`"}},
      {{"verify", "missing.study", "--json"}, {"DIR: expected a folder", "`missing.study`"}},
      {{"results", "missing.study"}, {"results: DIR: expected a folder"}},
      {{"resume", "missing.study"}, {"resume: DIR: expected a folder"}},
      {{"export", "csv", "missing.study", "--out", "x"}, {"`missing.study`"}},
      {run_words({"--device", "nonsense"}), {"--device", "nonsense", "lumped"}},
      {{"plan", "short_tour", "--device", "nonsense"}, {"--device", "nonsense"}},
      {{"loop", "--device", "nonsense"}, {"device", "nonsense"}},
      {{"demo", "--device", "nonsense"}, {"--device", "nonsense"}},
      {{"resume", ".", "--choose", "repaet"},
       {"expected repeat, restart or end", "did you mean `repeat`?"}},
      {{"export", "xlsx", ".", "--out", "x"},
       {"FORMAT: expected csv, bids, hdf5 or xdf, found `xlsx`"}},
      {{"force", "honey"}, {"law: expected ", "viscous", "`honey`"}},
      {{"compare", "--csv", "/dev/null", "--test", "pared"}, {"did you mean `paired`?"}},
  });
}

TEST_F(WrongUsageTest, OptionsGivenTwiceAndWordsTooManyAreRefused) {
  expect_wrong({
      {simulate_words({"--participants", "3", "--participants", "4"}),
       {"--participants: expected it once, found it 2 times"}},
      {run_words({"--seed", "1", "--seed", "1"}), {"--seed: expected it once"}},
      {run_words({"--study", "t.study"}), {"--study: expected it once"}},
      {run_words({"verify"}), {"run: expected no further word, found `verify`"}},
      {{"schema", "extra"}, {"schema: expected no further word, found `extra`"}},
      {{"devices", "extra"}, {"`extra`"}},
      {{"doctor", "extra"}, {"`extra`"}},
      {{"verify", ".", "extra"}, {"`extra`"}},
      {{"verify", ".", "--json=maybe"}, {"--json", "`maybe`"}},
      {run_words({"--participant", ""}), {"--participant"}},
      {{"new", "Not-A-Name"}, {"NAME: expected", "`Not-A-Name`"}},
  });
}

TEST_F(WrongUsageTest, ParticipantsAreNoPaths) {
  for (const char* name : {"", "../P01", "P 01", "a\nb", "\xff", "P01;", "Ä"}) {
    expect_wrong(
        {{{"run", "short_tour", "--study", "s.study", "--headless", "--participant", name},
          {"--participant"}}});
  }
}

}  // namespace wrong_usage_test
}  // namespace jnd::app
