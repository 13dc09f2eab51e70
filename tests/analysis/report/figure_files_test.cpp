#include "analysis/report/figure_files.h"

#include <gtest/gtest.h>

#include "analysis/report/plot_parts.h"
#include "analysis/report/run_tool.h"
#include "core/error.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::analysis {
namespace figure_files_test {

namespace fs = std::filesystem;
using test_support::read_file;

Figure small_figure(const std::string& title = "Small") {
  Figure figure{.name = "small", .title = title, .width_in = 2.0, .height_in = 1.5};
  figure.tables = {{.name = "points",
                    .columns = {"series", "who", "x", "y"},
                    .rows = {{1, "a, \"b\"", 1.0, 0.1},
                             {1, "c", 2.0, std::optional<double>()},
                             {2, "d", 3.0, 0.3}}}};
  figure.plot = "  plot " + from_table(figure.tables[0]) + "'x':'y' with points title " +
                gnuplot_quoted(title) + "\n";
  return figure;
}

TEST(FigureFiles, TheScriptAndTheTableLieBesideTheFigureAndTellThatItIsSimulated) {
  const test_support::TemporaryFolder temporary;
  const auto drawn = write_figures({small_figure()}, temporary.path(), {.simulated = true});
  EXPECT_EQ(read_file(temporary.path() / "points.csv"),
            "series,who,x,y,simulated\n1,\"a, \"\"b\"\"\",1,0.1,1\n1,c,2,,1\n2,d,3,0.3,1\n");
  const std::string script = read_file(temporary.path() / "small.gp");
  EXPECT_NE(script.find("# Small (SIMULATED data)\n"), std::string::npos);
  EXPECT_NE(script.find("'SIMULATED' at screen"), std::string::npos);
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_EQ(drawn[0].problem, "gnuplot is not installed");
  EXPECT_EQ(read_file(temporary.path() / "small.gp").find("/"), std::string::npos)
      << "no path of a machine in a script";
}

TEST(FigureFiles, ATextOfAStudyIsATextInTheScript) {
  EXPECT_EQ(gnuplot_quoted("it's `date` \"x\"\nset y"), "'it''s `date` \"x\" set y'");
  EXPECT_EQ(file_word("../a b'c"), "___a_b_c");
  EXPECT_EQ(plot_number(3.0), "3.0");
  EXPECT_EQ(plot_number(1e300 * 1e300), "NaN");
}

TEST(FigureFiles, APdfGetsItsDateAndKeepsItsLength) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "a.pdf";
  const std::string before =
      "%PDF\n/CreationDate (D:20261120190123Z)\n/ModDate (D:20261120190123+00'00')\n%%EOF\n";
  write_text_file(file, before);
  set_pdf_dates(file, 1'542'000'000'000'000'000);
  EXPECT_EQ(read_file(file),
            "%PDF\n/CreationDate (D:20181112052000Z)\n/ModDate (D:20181112052000+00'00')\n"
            "%%EOF\n");
}

TEST(FigureFiles, WhatCannotBeWrittenIsAnErrorWithItsName) {
  const test_support::TemporaryFolder temporary;
  try {
    write_text_file(temporary.path() / "none" / "x", "text");
    FAIL() << "expected an error";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("none/x: expected to write"), std::string::npos);
  }
  EXPECT_THROW(write_text_file("/dev/full", "text"), core::Error);
}

/// These tests need gnuplot itself.
class DrawnFigureTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (gnuplot_.empty()) GTEST_SKIP() << "gnuplot is not installed";
  }
  fs::path gnuplot_ = find_tool({"gnuplot"});
};

TEST_F(DrawnFigureTest, TheSameFigureGivesTheSameBytesWheneverItIsDrawn) {
  const test_support::TemporaryFolder first;
  const test_support::TemporaryFolder second;
  const std::vector<Figure> figures = {small_figure("It's {a} `brace` \"and\" quote")};
  const auto a = write_figures(figures, first.path(), {.simulated = true, .gnuplot = gnuplot_});
  ASSERT_EQ(a[0].problem, "");
  // The pictures must not depend on the clock, and so not on the day on which they are drawn.
  std::string pdf = read_file(first.path() / "small.pdf");
  EXPECT_NE(pdf.find("/CreationDate (D:19700101000000"), std::string::npos);
  const auto b = write_figures(figures, second.path(),
                               {.simulated = true, .jobs = 3, .gnuplot = gnuplot_});
  EXPECT_EQ(read_file(first.path() / "small.svg"), read_file(second.path() / "small.svg"));
  EXPECT_EQ(pdf, read_file(second.path() / "small.pdf"));
  EXPECT_NE(a[0].svg.find("It's {a} `brace`"), std::string::npos);
  EXPECT_NE(a[0].svg.find("SIMULATED"), std::string::npos);
}

TEST_F(DrawnFigureTest, BarsWithoutAMarkLeaveNothingThatCannotBeInverted) {
  const test_support::TemporaryFolder temporary;
  Figure figure = small_figure("Bars");
  figure.plot =
      "  plot " + from_table(figure.tables[0]) + "'x':'y':(0.1) with yerrorbars pt 7 ps 0\n";
  const auto drawn = write_figures({figure}, temporary.path(), {.gnuplot = gnuplot_});
  ASSERT_EQ(drawn[0].problem, "");
  EXPECT_EQ(drawn[0].svg.find("scale(0.00)"), std::string::npos);
  EXPECT_NE(drawn[0].svg.find("</svg>"), std::string::npos);
  EXPECT_NE(drawn[0].svg.find("<path"), std::string::npos) << "the bars stay";
}

TEST_F(DrawnFigureTest, AFigureThatCannotBeDrawnDoesNotKeepTheOthers) {
  const test_support::TemporaryFolder temporary;
  Figure broken = small_figure();
  broken.name = "broken";
  broken.plot = "  plot 'no_such_file.csv' using 1:2\n";
  const auto drawn =
      write_figures({broken, small_figure()}, temporary.path(), {.gnuplot = gnuplot_});
  EXPECT_NE(drawn[0].problem, "");
  EXPECT_FALSE(fs::exists(temporary.path() / "broken.svg"));
  EXPECT_FALSE(fs::exists(temporary.path() / "broken.pdf"));
  EXPECT_EQ(drawn[1].problem, "");
  EXPECT_TRUE(fs::exists(temporary.path() / "small.pdf"));
}

}  // namespace figure_files_test
}  // namespace jnd::analysis
