#include "analysis/export/csv_table_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {
namespace {

class CsvTableWriterTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string written() const {
    std::ifstream stream(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
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
  CsvTableWriter table("/dev/full", {{"a", "", ""}});
  for (int row = 0; row < 100000; ++row) table.cell("0123456789").end_row();
  EXPECT_THROW(table.finish(), core::Error);
}

}  // namespace
}  // namespace jnd::analysis
