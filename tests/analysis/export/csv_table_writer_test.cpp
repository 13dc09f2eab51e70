#include "analysis/export/csv_table_writer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {
namespace csv_table_writer_test {

class CsvTableWriterTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string written() const { return test_support::read_file(file_); }
  test_support::TemporaryFolder temporary_;
  std::filesystem::path file_ = temporary_.path() / "t.csv";
};

TEST_F(CsvTableWriterTest, QuotesWhatNeedsItAndLeavesEmptyWhatIsNot) {
  CsvTableWriter table(file_, {{"text", "", ""}, {"number", "", ""}});
  table.cell("plain").cell(0.1).end_row();
  table.cell("a,b").cell(std::int64_t{-7}).end_row();
  table.cell("say \"x\"").cell(NAN).end_row();
  table.cell("two\nlines").cell(std::optional<double>()).end_row();
  table.cell("").cell(INFINITY).end_row();
  table.finish();
  EXPECT_EQ(written(),
            "text,number\nplain,0.1\n\"a,b\",-7\n\"say \"\"x\"\"\",\n\"two\nlines\",\n,\n");
}

TEST_F(CsvTableWriterTest, RefusesARowOfAnotherLength) {
  CsvTableWriter table(file_, {{"a", "", ""}, {"b", "", ""}});
  table.cell("alone");
  EXPECT_THROW(table.end_row(), core::Error);
}

TEST_F(CsvTableWriterTest, NamesAFileThatCannotBeWritten) {
  EXPECT_THROW(
      {
        CsvTableWriter table(temporary_.path() / "none" / "t.csv", {{"a", "", ""}});
        table.finish();
      },
      core::Error);
}

TEST_F(CsvTableWriterTest, AFullDiskIsAnErrorNotATruncatedTable) {
  EXPECT_THROW(
      {
        CsvTableWriter table("/dev/full", {{"a", "", ""}});
        for (int row = 0; row < 100000; ++row) table.cell("0123456789").end_row();
        table.finish();
      },
      core::Error);
  EXPECT_THROW(
      {
        CsvTableWriter table("/dev/full", {{"a", "", ""}});
        table.finish();
      },
      core::Error)
      << "also of a table that fits the buffer";
}

TEST_F(CsvTableWriterTest, WritesStoredStepsAsTheDecimalFractionTheyAre) {
  CsvTableWriter table(file_, {{"number", "", ""}});
  for (const double number : {0.0, -0.0, 3 * 1e-7, -1234567 * 1e-7, 12.0, -0.05 + 0.0499999}) {
    table.fixed_cell(number, 7).end_row();
  }
  table.fixed_cell(1.0 / 3.0, 7).end_row();
  table.fixed_cell(1e300, 7).end_row();
  table.fixed_cell(NAN, 7).end_row();
  table.fixed_cell(31.0, 0).end_row();
  table.fixed_cell(1.5708F, 6).end_row();
  table.fixed_cell(1.5708F, 6, 0.5).end_row();
  table.finish();
  EXPECT_EQ(written(),
            "number\n0\n0\n0.0000003\n-0.1234567\n12\n-0.0000001\n0.3333333333333333\n"
            "1e+300\n\n31\n1.5707999467849731\n1.5708\n");
}

TEST_F(CsvTableWriterTest, WritesTabsAndWhatThereIsNotAsBidsWantsIt) {
  const std::vector<CsvColumn> columns = {{"text", "", ""}, {"number", "", ""}};
  CsvTableWriter table(file_, columns, TableStyle::kBids);
  table.cell("a\tb\r\nc, \"d\"").cell(NAN).end_row();
  table.cell("").cell(std::optional<std::int64_t>()).end_row();
  table.finish();
  EXPECT_EQ(written(), "text\tnumber\na b  c, \"d\"\tn/a\nn/a\tn/a\n");
  CsvTableWriter bare(file_, columns, TableStyle::kBidsWithoutNames);
  bare.cell("a").cell(0.5).end_row();
  bare.finish();
  EXPECT_EQ(written(), "a\t0.5\n");
}

TEST_F(CsvTableWriterTest, NoTextIsAFormulaToASpreadsheetAndNumbersStayAsTheyAre) {
  CsvTableWriter table(file_, {{"text", "", ""}});
  for (const char* text : {"=1+1", "+49 30 1", "-",    "- no", "-3,2",  "@sum",
                           "\tx",  "\rx",      "'=1",  "''-2", "'-2",   "=HYPERLINK(\"x\")",
                           "-inf", "-0x10",    "-3.2", "+4",   "-1e-6", "+.5",
                           "'tis", "'",        "a=b",  " =1",  "'n'"}) {
    table.cell(text).end_row();
  }
  table.cell(-3.2).end_row();
  table.cell(std::int64_t{-3}).end_row();
  table.fixed_cell(-0.5, 1).end_row();
  table.finish();
  EXPECT_EQ(written(),
            "text\n'=1+1\n'+49 30 1\n'-\n'- no\n\"'-3,2\"\n'@sum\n'\tx\n\"'\rx\"\n''=1\n'"
            "''-2\n''-2\n\"'=HYPERLINK(\"\"x\"\")\"\n'-inf\n'-0x10\n-3.2\n+4\n-1e-6\n+.5\n"
            "'tis\n'\na=b\n =1\n'n'\n-3.2\n-3\n-0.5\n");
}

TEST_F(CsvTableWriterTest, NoTextOfABidsTableIsAFormulaEither) {
  const std::vector<CsvColumn> columns = {{"text", "", ""}};
  CsvTableWriter table(file_, columns, TableStyle::kBids);
  for (const char* text : {"=1+1", "\t=1+1", "\r=1", "-3.2", "-x", "n/a"}) {
    table.cell(text).end_row();
  }
  table.finish();
  EXPECT_EQ(written(), "text\n'=1+1\n' =1+1\n' =1\n-3.2\n'-x\nn/a\n");
}

}  // namespace csv_table_writer_test
}  // namespace jnd::analysis
