#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/json_document.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/temporary_folder.h"

// Tests what `jnd fit` and `jnd compare` do with wrong files and words. They print one sentence
// that names the place, what was expected and what was found, and exit with the documented
// code.

namespace jnd::app {
namespace fit_bad_input_test {

struct Case {
  std::string name;
  std::string text;                ///< The content of t.csv.
  std::vector<std::string> words;  ///< The words after `jnd`.
  int exit_code = 1;
  std::vector<std::string> said;  ///< Parts of the one line on stderr.
};

const std::vector<std::string> kWeber = {"fit", "weber", "--csv", "t.csv", "--reference", "8"};
const std::vector<std::string> kPower = {"fit", "power", "--csv", "t.csv"};
const std::vector<std::string> kBetween = {"fit", "between", "--k1", "1", "--a1", "1"};
const std::vector<std::string> kPaired = {"compare", "--csv", "t.csv", "--test", "paired"};
constexpr char kHeader[] = "intensity,num_yes,num_trials\n";
constexpr char kGood[] = "intensity,num_yes,num_trials\n5,2,20\n12,17,20\n";

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<std::string> weber_at(const std::string& reference) {
  return {"fit", "weber", "--csv", "t.csv", "--reference", reference};
}

std::string row(const std::string& cells) { return kHeader + cells + "\n"; }

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases = {
      // Problems of the file.
      {"missing file",
       kGood,
       {"fit", "weber", "--csv", "no.csv", "--reference", "8"},
       1,
       {"no.csv: expected a CSV file", "no such file"}},
      {"folder",
       kGood,
       {"fit", "power", "--csv", "."},
       1,
       {".: expected a CSV file", "a folder"}},
      {"missing file to compare",
       kGood,
       {"compare", "--csv", "no.csv", "--test", "welch"},
       1,
       {"no.csv: expected a CSV file", "no such file"}},
      {"empty", "", kWeber, 1, {"t.csv:1: expected a header line", "an empty file"}},
      {"header only", kHeader, kWeber, 1, {"t.csv: expected", "found none: too few rows"}},
      {"header only, groups",
       kHeader,
       with(kWeber, {"--group-by", "num_yes"}),
       1,
       {"t.csv: expected rows below the header, found none"}},
      {"header only to compare", "a,b\n", kPaired, 1, {"t.csv: expected", "too few pairs"}},
      {"semicolons",
       "intensity;num_yes;num_trials\n1,5;1;2\n",
       kWeber,
       1,
       {"t.csv:1: expected commas", "found semicolons"}},
      {"binary",
       std::string("\x7f"
                   "ELF\0\0,\n\n,,\n",
                   12),
       kWeber,
       1,
       {"t.csv:1: expected text, found a binary file"}},
      {"open quote", row("5,\"2,20"), kWeber, 1, {"t.csv:2: expected a closing quote"}},
      {"letters after a quote",
       row("5,\"2\"x,20"),
       kWeber,
       1,
       {"t.csv:2: expected a comma", "after the closing quote", "found \"x\""}},
      {"a cell too few", row("5,2"), kWeber, 1, {"t.csv:2: expected 3 cells, found 2"}},
      {"a column twice",
       "a,a,b\n1,2,3\n",
       kPaired,
       1,
       {"t.csv:1: expected every column once", "\"a\""}},
      // Problems of the columns.
      {"missing column",
       "intensity,num_yes,trials\n1,1,2\n",
       kWeber,
       1,
       {"t.csv:1: num_trials: expected a column", "intensity, num_yes, trials",
        "rename \"trials\""}},
      {"another case",
       "Intensity,magnitude\n1,1\n",
       kPower,
       1,
       {"t.csv:1: intensity: expected a column", "rename \"Intensity\""}},
      {"missing column to compare",
       "a,c\n1,2\n",
       kPaired,
       1,
       {"t.csv:1: b: expected a column", "a, c"}},
      {"unknown grouping",
       kGood,
       with(kWeber, {"--group-by", "colour"}),
       1,
       {"t.csv:1: colour: expected a column", "num_trials"}},
      // Problems of single cells.
      {"text",
       row("5,many,20"),
       kWeber,
       1,
       {"t.csv:2: num_yes: expected a finite number, found \"many\""}},
      {"nan", row("nan,2,20"), kWeber, 1, {"t.csv:2: intensity: expected a finite number"}},
      {"inf", row("inf,2,20"), kWeber, 1, {"t.csv:2: intensity: expected a finite number"}},
      {"magnitude inf",
       "intensity,magnitude\n1,1\n2,-inf\n",
       kPower,
       1,
       {"t.csv:3: magnitude: expected a finite number, found \"-inf\""}},
      {"too large a number", "a,b\n1,1e999\n", kPaired, 1, {"t.csv:2: b: expected a finite"}},
      {"empty cell", "a,b\n1,2\n3,\n", kPaired, 1, {"t.csv:3: b:", "found an empty cell"}},
      {"decimal comma",
       row("\"5,5\",2,20"),
       kWeber,
       1,
       {"t.csv:2: intensity: expected a number with a point"}},
      {"negative intensity",
       row("-5,2,20"),
       kWeber,
       1,
       {"t.csv:2: intensity: expected a number >= 0, found \"-5\""}},
      {"more yes than trials",
       row("5,21,20"),
       kWeber,
       1,
       {"t.csv:2: num_yes: expected at most num_trials = 20, found \"21\""}},
      {"negative yes",
       row("5,-2,20"),
       kWeber,
       1,
       {"t.csv:2: num_yes: expected a whole number >= 0, found \"-2\""}},
      {"fractional count",
       row("5,1.5,20"),
       kWeber,
       1,
       {"t.csv:2: num_yes: expected a whole number >= 0, found \"1.5\""}},
      // Problems of the command's words.
      {"reference 0",
       kGood,
       weber_at("0"),
       2,
       {"--reference: expected a number > 0", "found 0"}},
      {"reference < 0", kGood, weber_at("-8"), 2, {"--reference: expected", "found -8"}},
      {"reference nan", kGood, weber_at("nan"), 2, {"--reference: expected", "found nan"}},
      {"reference inf", kGood, weber_at("inf"), 2, {"--reference: expected", "found inf"}},
      {"reference text", kGood, weber_at("eight"), 2, {"--reference", "expected", "eight"}},
      {"no reference", kGood, {"fit", "weber", "--csv", "t.csv"}, 2, {"--reference"}},
      {"no file", kGood, {"fit", "weber", "--reference", "8"}, 2, {"--csv"}},
      {"unknown free", kGood, with(kWeber, {"--free", "slope"}), 2, {"--free", "slope"}},
      {"guess of 1", kGood, with(kWeber, {"--guess", "1"}), 2, {"--guess", "below 1", "`1`"}},
      {"guess of 3/2", kGood, with(kWeber, {"--guess", "3/2"}), 2, {"--guess", "1/3", "`3/2`"}},
      {"guess nan", kGood, with(kWeber, {"--guess", "nan"}), 2, {"--guess", "`nan`"}},
      {"lapse word",
       kGood,
       with(kWeber, {"--lapse", "some"}),
       2,
       {"--lapse", "free", "`some`"}},
      {"two lapses",
       kGood,
       with(kWeber, {"--free", "lapse", "--lapse", "0.02"}),
       2,
       {"--free lapse, --lapse: expected one of them"}},
      {"symmetric alone",
       kGood,
       with(kWeber, {"--symmetric"}),
       2,
       {"--symmetric: expected with"}},
      {"no rise",
       kGood,
       with(kWeber, {"--guess", "1/2", "--lapse", "0.25", "--symmetric"}),
       2,
       {"--lapse: expected a rate that leaves", "found 0.25"}},
      {"overdispersion by least squares",
       kGood,
       with(kWeber, {"--method", "lsq", "--overdispersion", "scaled"}),
       2,
       {"--overdispersion scaled: expected with --method ml"}},
      {"calibration of least squares",
       kGood,
       with(kWeber, {"--method", "lsq", "--calibration", "500"}),
       2,
       {"--calibration 500: expected with --family weber and --method ml"}},
      {"calibration by too few redraws",
       kGood,
       with(kWeber, {"--free", "pse", "--calibration", "19"}),
       2,
       {"--calibration 19: expected 0, or 200 and more"}},
      {"calibration with lapses",
       kGood,
       with(kWeber, {"--free", "lapse", "--calibration", "500"}),
       2,
       {"--calibration 500: expected", "without lapses"}},
      {"unknown method", kGood, with(kWeber, {"--method", "mle"}), 2, {"--method", "mle"}},
      {"method of another fit", kGood, with(kPower, {"--method", "ml"}), 2, {"--method", "ml"}},
      {"unknown option", kGood, with(kWeber, {"--smooth"}), 2, {"--smooth"}},
      {"refits < 0", kGood, with(kWeber, {"--bootstrap", "-5"}), 2, {"--bootstrap", "-5"}},
      {"unknown test",
       kGood,
       {"compare", "--csv", "t.csv", "--test", "anova"},
       2,
       {"--test", "anova"}},
      {"unknown fit", kGood, {"fit", "line"}, 2, {"line"}},
      {"k 0",
       kGood,
       with(kBetween, {"--k2", "0", "--a2", "1", "--intensities", "1,2"}),
       2,
       {"--k2: expected numbers > 0, found 0"}},
      {"intensity < 0",
       kGood,
       with(kBetween, {"--k2", "1", "--a2", "1", "--intensities", "1,-2"}),
       2,
       {"--intensities: expected numbers >= 0, found -2"}},
      {"one intensity",
       kGood,
       with(kBetween, {"--k2", "1", "--a2", "1", "--intensities", "1"}),
       1,
       {"--intensities: expected", "too few rows"}},
      // Fits that do not exist.
      {"separated",
       row("5,0,20\n12,20,20"),
       kWeber,
       1,
       {"t.csv: expected answers that have a Weber fraction, found none: separated"}},
      {"a group without a fit",
       "who,intensity,magnitude\nx,1,2\nx,4,4\ny,1,3\n",
       with(kPower, {"--group-by", "who"}),
       1,
       {"t.csv: expected a power law in every group, found none in 1 of 2: too few rows"}},
      {"all alike", "a,b\n1,1\n2,2\n", kPaired, 1, {"t.csv: expected", "alike"}},
  };
  return kCases;
}

TEST(FitBadInput, EachIsOneSentenceWithItsPlaceAndTheExitCodeOfTheContract) {
  for (const bool json : {false, true}) {
    for (const Case& one : cases()) {
      SCOPED_TRACE(one.name + (json ? ", --json" : ""));
      const test_support::TemporaryFolder temporary;
      write_file(temporary.path() / "t.csv", one.text);
      const test_support::ProgramOutcome outcome =
          test_support::run_program(json ? with(one.words, {"--json"}) : one.words,
                                    {.folder = temporary.path(), .environment = {}});
      EXPECT_EQ(outcome.exit_code, one.exit_code) << outcome.err;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      for (const std::string& part : one.said) {
        EXPECT_NE(outcome.err.find(part), std::string::npos)
            << "expected: " << part << "\nfound: " << outcome.err;
      }
      if (outcome.exit_code == 2) {
        EXPECT_EQ(outcome.out, "");
      } else if (json) {
        EXPECT_TRUE(document(outcome.out).is_object());
      }
    }
  }
}

TEST(FitBadInput, AByteOrderMarkAndLineEndsOfWindowsAreNothingWrong) {
  const test_support::TemporaryFolder temporary;
  write_file(temporary.path() / "t.csv",
             "\xEF\xBB\xBFintensity,num_yes,num_trials\r\n5,2,20\r\n12,17,20\r\n");
  const test_support::ProgramOutcome outcome = test_support::run_program(
      with(kWeber, {"--json"}), {.folder = temporary.path(), .environment = {}});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(document(outcome.out)["num_levels"], 2);
}

}  // namespace fit_bad_input_test
}  // namespace jnd::app
