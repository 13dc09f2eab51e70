#include "analysis/data/trial_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace jnd::analysis {
namespace trial_table_test {

constexpr char kTrials[] =
    "participant,u,answer,session\n"
    "P2,1.5,yes,1\n"
    "P1,-2,no,1\n"
    ",0,yes,1\n"
    "P1,NA,yes,1\n"
    "P1,1.5,1,2\n";

TEST(TrialTable, KeepsTheRowsInTheirOrderAndEachCellOnce) {
  const TrialTable table =
      parse_trial_table(kTrials, "t.csv",
                        {.answers = {.yes = "answer", .yes_value = {}, .trials = {}},
                         .variables = {"u", "participant"},
                         .where = {}});
  ASSERT_EQ(table.num_rows(), 3U);
  EXPECT_EQ(table.num_rows_in_file, 5);
  EXPECT_EQ(table.num_missing.at("participant"), 1);
  EXPECT_EQ(table.num_missing.at("u"), 1);
  EXPECT_EQ(table.num_yes, (std::vector<double>{1.0, 0.0, 1.0}));
  EXPECT_EQ(table.num_trials, (std::vector<double>{1.0, 1.0, 1.0}));
  const TrialVariable& u = *table.find("u");
  EXPECT_TRUE(u.is_numeric());
  EXPECT_EQ(u.cells.size(), 2U);
  EXPECT_EQ(u.number(0), 1.5);
  EXPECT_EQ(u.number(1), -2.0);
  EXPECT_EQ(u.number(2), 1.5);
  const TrialVariable& people = *table.find("participant");
  EXPECT_FALSE(people.is_numeric());
  EXPECT_EQ(people.cell(0), "P2");
  EXPECT_EQ(people.cell(2), "P1");
  EXPECT_EQ(table.find("session"), nullptr);
}

TEST(TrialTable, ReadsCountsDecimalCommasAndWhere) {
  const TrialTable table =
      parse_trial_table("x;k;n;group\n0,5;3;8;a\n1,5;8;8;a\n0,5;1;8;b\n2,5;0;0;a\n", "t.csv",
                        {.answers = {.yes = "k", .yes_value = {}, .trials = "n"},
                         .variables = {"x"},
                         .where = {{"group", "a"}}});
  ASSERT_EQ(table.num_rows(), 2U);
  EXPECT_EQ(table.num_elsewhere, 1);
  EXPECT_EQ(table.num_without_trials, 1);
  EXPECT_EQ(table.find("x")->number(1), 1.5);
  EXPECT_EQ(table.num_yes[0], 3.0);
}

TEST(TrialTable, NoneIsTheNameOfAConditionAndNoNumber) {
  const TrialTable table =
      parse_trial_table("drug,u,r\nnone,1,1\nlow,2,0\nhigh,None,1\nlow,3,0\n", "t.csv",
                        {.answers = {.yes = "r", .yes_value = {}, .trials = {}},
                         .variables = {"drug", "u"},
                         .where = {}});
  ASSERT_EQ(table.num_rows(), 3U);
  EXPECT_EQ(table.num_missing.at("u"), 1);
  EXPECT_EQ(table.find("drug")->cells, (std::vector<std::string>{"none", "low"}));
  EXPECT_TRUE(table.find("u")->is_numeric());
  EXPECT_EQ(table.find("u")->number(2), 3.0);
  EXPECT_EQ(table.find("drug")->cell(2), "low");
  EXPECT_EQ(table.num_yes, (std::vector<double>{1, 0, 0}));
}

TEST(TrialTable, NamesAColumnThatIsNotThere) {
  const TrialColumns columns = {.answers = {.yes = "answer", .yes_value = {}, .trials = {}},
                                .variables = {"v"},
                                .where = {}};
  try {
    static_cast<void>(parse_trial_table(kTrials, "t.csv", columns));
    FAIL() << "no error";
  } catch (const UnknownColumn& unknown) {
    EXPECT_EQ(unknown.column, "v");
    EXPECT_EQ(unknown.known, "participant, u, answer, session");
  }
}

TEST(TrialTable, TellsEveryAnswerThatIsNone) {
  try {
    static_cast<void>(
        parse_trial_table("u,k,n\n1,9,8\n2,x,8\n", "t.csv",
                          {.answers = {.yes = "k", .yes_value = {}, .trials = "n"},
                           .variables = {"u"},
                           .where = {}}));
    FAIL() << "no error";
  } catch (const core::Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("t.csv:2: k: expected a whole number from 0 to the 8 of n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("t.csv:3: k:"), std::string::npos) << text;
  }
}

}  // namespace trial_table_test
}  // namespace jnd::analysis
