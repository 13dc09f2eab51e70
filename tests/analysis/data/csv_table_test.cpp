#include "analysis/data/csv_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "core/error.h"

namespace jnd::analysis {
namespace csv_table_test {

using testing::ElementsAre;
using testing::HasSubstr;

std::string message_of(const auto& act) {
  try {
    act();
  } catch (const core::Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

std::string refusal(const std::string& text) {
  return message_of([&] { (void)CsvTable::parse(text, "t.csv"); });
}

TEST(CsvTable, ReadsQuotesSpacesAndLineEndsOfEveryKind) {
  const CsvTable table = CsvTable::parse(
      "\xEF\xBB\xBF"
      "who, intensity ,note\r\n"
      "a,1.5,\"one, \"\"two\"\"\r\nthree\"\r\n"
      "\n"
      " b , +2e-1,\n"
      "c,3,last",
      "t.csv");
  EXPECT_THAT(table.columns(), ElementsAre("who", "intensity", "note"));
  ASSERT_EQ(table.num_rows(), 3U);
  EXPECT_EQ(table.cell(0, 2), "one, \"two\"\r\nthree");
  EXPECT_EQ(table.cell(1, 0), "b");
  EXPECT_EQ(table.cell(1, 2), "");
  EXPECT_EQ(table.cell(2, 2), "last");
  EXPECT_EQ(table.line(0), 2);
  EXPECT_EQ(table.line(1), 5);
  CsvReader reader(table);
  EXPECT_THAT(reader.numbers("intensity"), ElementsAre(1.5, 0.2, 3.0));
  EXPECT_NO_THROW(reader.throw_problems());
}

TEST(CsvTable, TellsWhatIsWrongWithItsForm) {
  EXPECT_EQ(refusal(""),
            "t.csv:1: expected a header line that names the columns, found an empty file");
  EXPECT_THAT(refusal("\n\r\n"), HasSubstr("found an empty file"));
  EXPECT_EQ(refusal("a;b\n1,5;2\n"),
            "t.csv:1: expected commas between the columns, found semicolons; decimals need a "
            "point");
  EXPECT_THAT(refusal("a\tb\n1\t2\n"), HasSubstr("found tabs"));
  EXPECT_EQ(refusal("a,b\n1\n1,2\n1,5,2\n"),
            "t.csv:2: expected 2 cells, found 1\n"
            "t.csv:4: expected 2 cells, found 3; decimals need a point, not a comma");
  EXPECT_EQ(refusal("a,a\n"), "t.csv:1: expected every column once, found \"a\" again");
  EXPECT_EQ(refusal("a,b\n1,\"2\n3,4\n"),
            "t.csv:2: expected a closing quote, found the end of the file");
}

TEST(CsvTable, RefusesWhatStandsBehindAClosingQuote) {
  EXPECT_EQ(refusal("a,b\n\"1\"5,2\n"),
            "t.csv:2: expected a comma or a line end after the closing quote of \"1\", found "
            "\"5\"");
  EXPECT_EQ(refusal("a,b\n\"1\" , 2\n"), "nothing was thrown");
}

TEST(CsvTable, ShowsCellsShortAndInUtf8WhateverTheyAre) {
  EXPECT_THAT(refusal("a\x1B[2J\xFF,a\x1B[2J\xFF\n"),
              HasSubstr("found \"a\\u001b[2J\xEF\xBF\xBD\" again"));
  EXPECT_THAT(refusal("\xC2\x9B\x7F,\xC2\x9B\x7F\n"), HasSubstr("found \"\\u009b\\u007f\""));
  EXPECT_THAT(refusal("\xC2\xB5,\xC2\xB5\n"), HasSubstr("found \"\xC2\xB5\" again"));
  const std::string long_name(1000000, 'x');
  EXPECT_LT(refusal(long_name + ',' + long_name + '\n').size(), 300U);
  const std::string zeros(1000000, '\0');
  EXPECT_LT(refusal(zeros + ',' + zeros + '\n').size(), 300U);
}

TEST(CsvTable, ReadsAHeaderOfVeryManyColumnsInReasonableTime) {
  std::string header = "a0";
  for (int i = 1; i < 200000; ++i) header += ",a" + std::to_string(i);
  const CsvTable table = CsvTable::parse(header + '\n', "t.csv");
  CsvReader reader(table);
  EXPECT_TRUE(reader.numbers("intensity").empty());
  const std::string message = message_of([&] { reader.throw_problems(); });
  EXPECT_LT(message.size(), 300U);
  EXPECT_THAT(message, HasSubstr("a1, a2,"));
  EXPECT_THAT(message, HasSubstr("... (200000 columns)"));
}

TEST(CsvTable, NamesTheFileItCannotRead) {
  EXPECT_THAT(message_of([] { (void)CsvTable::read("/nowhere/t.csv"); }),
              HasSubstr("/nowhere/t.csv: expected a CSV file"));
  EXPECT_THAT(message_of([] { (void)CsvTable::read("/tmp"); }), HasSubstr("/tmp: expected"));
}

TEST(CsvReader, CollectsEveryCellThatIsNoNumberInTheOrderOfTheFile) {
  const CsvTable table = CsvTable::parse(
      "x,y\n"
      "1,abc\n"
      "\"1,5\",2\n"
      "nan,3\n"
      "4,inf\n"
      "5 %,1e999\n"
      ",0x1p3\n"
      "+-5,\"\"\n",
      "t.csv");
  CsvReader reader(table);
  EXPECT_TRUE(std::isnan(reader.numbers("x")[2]));
  (void)reader.numbers("y");
  EXPECT_EQ(message_of([&] { reader.throw_problems(); }),
            "t.csv:2: y: expected a finite number, found \"abc\"\n"
            "t.csv:3: x: expected a number with a point for the decimals, found \"1,5\"\n"
            "t.csv:4: x: expected a finite number, found \"nan\"\n"
            "t.csv:5: y: expected a finite number, found \"inf\"\n"
            "t.csv:6: x: expected a finite number, found \"5 %\"\n"
            "t.csv:6: y: expected a finite number, found \"1e999\"\n"
            "t.csv:7: x: expected a finite number, found an empty cell\n"
            "t.csv:7: y: expected a finite number, found \"0x1p3\"\n"
            "t.csv:8: x: expected a finite number, found \"+-5\"\n"
            "t.csv:8: y: expected a finite number, found an empty cell");
}

TEST(CsvReader, NamesTheColumnsThereAreWhereOneIsMissing) {
  const CsvTable table = CsvTable::parse("Intensity,yes\n1,2\n", "t.csv");
  CsvReader reader(table);
  EXPECT_TRUE(reader.numbers("intensity").empty());
  EXPECT_EQ(message_of([&] { reader.throw_problems(); }),
            "t.csv:1: intensity: expected a column of this name, found the columns Intensity, "
            "yes; rename \"Intensity\" if that is meant");
}

TEST(CsvReader, AnEmptyCellEndsTheShorterColumnOnce) {
  const CsvTable table = CsvTable::parse("a,b\n1,2\n3,\n4,\n", "t.csv");
  CsvReader reader(table);
  EXPECT_THAT(reader.numbers_until_empty("a"), ElementsAre(1.0, 3.0, 4.0));
  EXPECT_THAT(reader.numbers_until_empty("b"), ElementsAre(2.0));
  EXPECT_NO_THROW(reader.throw_problems());

  const CsvTable broken = CsvTable::parse("a,b\n1,2\n3,\n4,5\n", "t.csv");
  CsvReader other(broken);
  (void)other.numbers_until_empty("b");
  EXPECT_THAT(message_of([&] { other.throw_problems(); }),
              HasSubstr("t.csv:4: b: expected an empty cell"));
}

TEST(CsvReader, ShowsTheFirstTwentyProblemsAndCountsTheRest) {
  std::string text = "x\n";
  for (int row = 0; row < 25; ++row) text += "no\n";
  const CsvTable table = CsvTable::parse(text, "t.csv");
  CsvReader reader(table);
  (void)reader.numbers("x");
  const std::string message = message_of([&] { reader.throw_problems(); });
  EXPECT_THAT(message, HasSubstr("t.csv:21:"));
  EXPECT_THAT(message, testing::Not(HasSubstr("t.csv:22:")));
  EXPECT_THAT(message, testing::EndsWith("... and 5 more"));
}

}  // namespace csv_table_test
}  // namespace jnd::analysis
