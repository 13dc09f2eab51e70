#include "analysis/fits/fit_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace jnd::analysis {
namespace fit_data_test {

std::string refusal(const std::string& text) {
  try {
    (void)read_answer_counts(CsvTable::parse(text, "t.csv"));
  } catch (const core::Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(FitData, GroupsRowsInTheOrderOfTheirFirst) {
  const CsvTable table = CsvTable::parse(
      "who,group,intensity,num_yes,num_trials\n"
      "b,D,1.5,3,5\n"
      "a,D,1.5,4,5\n"
      "b,E,0.5,0,5\n"
      "b,D,0.5,1,5\n",
      "t.csv");
  const auto by_two = read_answer_counts(table, {"who", "group"});
  ASSERT_EQ(by_two.size(), 3U);
  EXPECT_EQ(by_two[0].key[0].second, "b");
  EXPECT_EQ(by_two[0].key[1].second, "D");
  ASSERT_EQ(by_two[0].rows.size(), 2U);
  EXPECT_EQ(by_two[0].rows[1].num_yes, 1);
  EXPECT_EQ(by_two[0].lines[1], 5);
  EXPECT_EQ(read_answer_counts(table, {"group"}).size(), 2U);
  const auto all = read_answer_counts(table);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].rows.size(), 4U);
  EXPECT_TRUE(all[0].key.empty());
}

TEST(FitData, CountsTheDifferentCellsOfAColumnAmongItsAnswers) {
  const CsvTable table = CsvTable::parse(
      "who,group,intensity,num_yes,num_trials\n"
      "b,D,1.5,3,5\n"
      "a,E,1.5,4,5\n"
      "b,D,0.5,0,5\n"
      "c,D,0.5,0,0\n"
      "a,D,0.5,1,5\n",
      "t.csv");
  const auto by_group = read_answer_counts(table, {"group"});
  EXPECT_EQ(different_cells(table, "who", by_group[0]).size(), 2U) << "c has no answers";
  EXPECT_EQ(different_cells(table, "who", by_group[1]).size(), 1U);
  EXPECT_EQ(different_cells(table, "participant", by_group[0]).size(), 0U);
}

TEST(FitData, ReportsEveryCountThatIsNone) {
  EXPECT_EQ(refusal("intensity,num_yes,num_trials\n"
                    "1,6,5\n"
                    "-1,2.5,5\n"
                    "2,-1,x\n"),
            "t.csv:2: num_yes: expected at most num_trials = 5, found \"6\"\n"
            "t.csv:3: intensity: expected a number >= 0, found \"-1\"\n"
            "t.csv:3: num_yes: expected a whole number >= 0, found \"2.5\"\n"
            "t.csv:4: num_yes: expected a whole number >= 0, found \"-1\"\n"
            "t.csv:4: num_trials: expected a finite number, found \"x\"");
}

TEST(FitData, NamesEveryMissingColumnTheGroupingOnesToo) {
  try {
    (void)read_magnitudes(CsvTable::parse("intensity\n1\n", "t.csv"), {"who"});
    FAIL() << "missing columns were accepted";
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(),
                 "t.csv:1: who: expected a column of this name, found the columns intensity\n"
                 "t.csv:1: magnitude: expected a column of this name, found the columns "
                 "intensity");
  }
}

TEST(FitData, ComparesNoCountsThatHaveBeenRefused) {
  try {
    (void)read_answer_counts(
        CsvTable::parse("intensity,num_yes,num_trials\n1,1e305,1e300\n1,1,-1\n", "t.csv"));
    FAIL() << "counts beyond every integer were accepted";
  } catch (const core::Error& error) {
    EXPECT_STREQ(
        error.what(),
        "t.csv:2: num_yes: expected a whole number of at most 1e15, found \"1e305\"\n"
        "t.csv:2: num_trials: expected a whole number of at most 1e15, found \"1e300\"\n"
        "t.csv:3: num_trials: expected a whole number >= 0, found \"-1\"");
  }
}

TEST(FitData, ATableWithoutRowsIsOneEmptyGroup) {
  const auto groups = read_magnitudes(CsvTable::parse("intensity,magnitude\n", "t.csv"));
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_TRUE(groups[0].rows.empty());
}

}  // namespace fit_data_test
}  // namespace jnd::analysis
