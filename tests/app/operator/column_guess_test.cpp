#include "app/operator/column_guess.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace column_guess_test {

DataPreview preview_of(const std::string& text, const char* name = "a.csv") {
  const test_support::TemporaryFolder folder;
  test_support::write_file(folder.path() / name, text);
  WorkControl control;
  return read_preview(folder.path() / name, control);
}

CurveRequest guess_of(const std::string& text, const char* name = "a.csv") {
  return guessed_request(preview_of(text, name));
}

using Columns = std::vector<std::string>;

TEST(DataPreviewTest, HoldsTheFirstRowsAndWhatTheColumnsHold) {
  const DataPreview preview = preview_of("x;r;who\n0,5;1;A\n1,5;0;\n2;1;B\n");
  ASSERT_EQ(preview.columns.size(), 3U);
  EXPECT_EQ(preview.num_rows, 3);
  EXPECT_TRUE(preview.decimal_comma);
  EXPECT_EQ(preview.rows[1], (Columns{"1,5", "0", ""}));
  EXPECT_TRUE(preview.columns[0].is_numeric);
  EXPECT_FALSE(preview.columns[0].is_whole);
  EXPECT_TRUE(preview.columns[1].is_yes_or_no);
  EXPECT_FALSE(preview.columns[2].is_numeric);
  EXPECT_EQ(preview.columns[2].cells, (Columns{"A", "B"}));
  EXPECT_EQ(preview.columns[2].num_missing, 1);
  EXPECT_EQ(preview.place_of("who"), 2U);
  EXPECT_EQ(preview.place_of("nobody"), 3U);
}

TEST(DataPreviewTest, OfALongTableTheFirstRowsAloneAreKept) {
  std::string text = "x,r\n";
  for (int i = 0; i < 2000; ++i) text += std::to_string(i) + ",1\n";
  const DataPreview preview = preview_of(text);
  EXPECT_EQ(preview.num_rows, 2000);
  EXPECT_EQ(preview.rows.size(), DataPreview::kMostRows);
  EXPECT_EQ(preview.columns[0].cells.size(), PreviewColumn::kMost);
  EXPECT_TRUE(preview.columns[0].has_more_cells);
}

TEST(DataPreviewTest, WhatIsNoTableIsTheReadersSentence) {
  try {
    (void)preview_of("x,r\n1,2,3\n");
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.csv:2: expected 2 cells, found 3"),
              std::string::npos)
        << error.what();
  }
  EXPECT_THROW((void)preview_of(""), core::Error);
}

TEST(ColumnGuess, CountsAreToldFromLevelsByNamesAndByWhatTheyHold) {
  const CurveRequest request = guess_of(
      "condition,delay_ms,num_first,num_asked\nlight,-90,2,40\nlight,90,38,40\n"
      "sound,-90,1,40\nsound,90,37,40\n");
  EXPECT_EQ(request.intensity, "delay_ms");
  EXPECT_EQ(request.yes, "num_first");
  EXPECT_EQ(request.trials, "num_asked");
  EXPECT_EQ(request.group_by, Columns{"condition"});
  EXPECT_EQ(request.yes_value, "");
}

TEST(ColumnGuess, CountsWithoutTellingNamesAreToldByWhichIsNeverMore) {
  const CurveRequest request = guess_of("q,a,b\n10,40,2\n50,40,20\n90,40,38\n");
  EXPECT_EQ(request.intensity, "q");
  EXPECT_EQ(request.yes, "b");
  EXPECT_EQ(request.trials, "a");
}

TEST(ColumnGuess, TheNamesOfThisProgramAreKnown) {
  const CurveRequest request =
      guess_of("intensity,num_yes,num_trials\n1,2,10\n2,5,10\n3,9,10\n");
  EXPECT_EQ(request.intensity, "intensity");
  EXPECT_EQ(request.yes, "num_yes");
  EXPECT_EQ(request.trials, "num_trials");
  EXPECT_TRUE(request.group_by.empty());
}

TEST(ColumnGuess, ATrialARowOfSeveralPeople) {
  const CurveRequest request = guess_of(
      "participant,trial,contrast,correct,rt\nP1,1,0.1,0,0.51\nP1,2,0.2,1,0.62\n"
      "P2,1,0.3,1,0.43\nP2,2,0.1,0,0.74\n");
  EXPECT_EQ(request.intensity, "contrast");
  EXPECT_EQ(request.yes, "correct");
  EXPECT_EQ(request.trials, "");
  EXPECT_EQ(request.group_by, Columns{"participant"});
}

TEST(ColumnGuess, AnswersInWordsHaveACellThatIsAYes) {
  const CurveRequest request =
      guess_of("level,answer\n1,shorter\n2,longer\n3,longer\n1,shorter\n");
  EXPECT_EQ(request.yes, "answer");
  EXPECT_EQ(request.yes_value, "longer");
  EXPECT_EQ(request.intensity, "level");
}

TEST(ColumnGuess, OfTwoIntervalsTheSecondIsAYes) {
  const CurveRequest request = guess_of("difference,response\n-1,1\n0,2\n1,2\n-1,1\n");
  EXPECT_EQ(request.yes, "response");
  EXPECT_EQ(request.yes_value, "2");
  EXPECT_EQ(request.intensity, "difference");
  EXPECT_EQ(guessed_yes_value({.cells = {"a", "b", "c"}, .is_yes_or_no = false}), "");
}

TEST(ColumnGuess, InstructionsOfJsPsychTellNothingApart) {
  const CurveRequest request = guess_of(
      R"([{"trial_type": "instructions", "trial_index": 0, "rt": 900},
          {"trial_type": "key", "trial_index": 1, "rt": 512, "correct": true,
           "data": {"offset": -1.5}},
          {"trial_type": "key", "trial_index": 2, "rt": 430, "correct": false,
           "data": {"offset": 0.5}},
          {"trial_type": "key", "trial_index": 3, "rt": 610, "correct": true,
           "data": {"offset": 1.5}}])",
      "a.json");
  EXPECT_EQ(request.intensity, "data.offset");
  EXPECT_EQ(request.yes, "correct");
  EXPECT_TRUE(request.group_by.empty());
}

TEST(ColumnGuess, WhatCannotBeGuessedStaysOpen) {
  const CurveRequest request = guess_of("name,city\nAda,London\nEmmy,Erlangen\n");
  EXPECT_EQ(request.intensity, "");
  EXPECT_EQ(request.yes, "");
  EXPECT_TRUE(request.group_by.empty());
}

TEST(ColumnGuess, AllElseIsAsTheCommandHasItWhereNothingIsSaid) {
  CurveRequest request = guess_of("intensity,num_yes,num_trials\n1,2,10\n2,5,10\n3,9,10\n");
  request.csv = request.yes = request.trials = "";
  EXPECT_EQ(request, CurveRequest());
}

}  // namespace column_guess_test
}  // namespace jnd::app
