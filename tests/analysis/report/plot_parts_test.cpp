#include "analysis/report/plot_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace jnd::analysis {
namespace plot_parts_test {

TEST(LogTics, AreRoundNumbersWithinAndNoFewerThanThree) {
  EXPECT_EQ(log_tics("y", {2.4, 7.9}), "  set ytics (3.0, 5.0, 7.0)\n");
  EXPECT_EQ(log_tics("x", {0.9, 11.0}, /*small=*/true),
            "  set xtics (1.0, 3.0, 10.0) font small\n");
  EXPECT_EQ(log_tics("y", {0.09, 0.31}), "  set ytics (0.1, 0.15, 0.2, 0.3)\n");
  EXPECT_EQ(log_tics("y", {0.5, 2000.0}), "  set ytics (1.0, 10.0, 100.0, 1000.0)\n");
}

TEST(LogTics, OfManyDecadesAreNotTooMany) {
  const std::string tics = log_tics("y", {1e-9, 1e9});
  EXPECT_LE(std::count(tics.begin(), tics.end(), ','), 6) << tics;
}

TEST(LogTics, OfANarrowRangeAreEqualSteps) {
  // On a logarithmic axis gnuplot takes a single step for a factor, so each tic is listed.
  EXPECT_EQ(log_tics("y", {8.1, 9.4}), "  set ytics (8.5, 9.0)\n");
  EXPECT_EQ(log_tics("y", {2.4, 6.0}), "  set ytics (3.0, 4.0, 5.0, 6.0)\n");
}

TEST(LogTics, OfASmallPanelAreFewEnoughToBeRead) {
  EXPECT_EQ(log_tics("x", {120.0, 720.0}, /*small=*/true),
            "  set xtics (150.0, 300.0, 700.0) font small\n");
}

TEST(LogTics, OfARangeThatIsNoneAreLeftToGnuplot) {
  EXPECT_EQ(log_tics("y", {0.0, 2.0}), "  set ytics autofreq\n");
  EXPECT_EQ(log_tics("y", {2.0, 2.0}), "  set ytics autofreq\n");
}

TEST(PanelTitle, ThatIsTooLongStandsOnTwoLinesBrokenBetweenWords) {
  EXPECT_EQ(on_two_lines("P01", 20), "P01");
  EXPECT_EQ(on_two_lines("participant P01, condition thin", 20),
            "participant P01,\ncondition thin");
  EXPECT_EQ(on_two_lines("a\nb that is broken already by hand", 10),
            "a\nb that is broken already by hand");
  EXPECT_EQ(on_two_lines("participant P01, condition with priming before", 20),
            "participant P01,\ncondition with prim\u2026");
  EXPECT_EQ(on_two_lines("Donaudampfschifffahrt", 10), "Donaudamp\u2026");
}

TEST(PanelTitle, CountsLettersAndNotBytes) {
  EXPECT_EQ(num_letters_of("Z\u00e4higkeit"), 9U);
  EXPECT_EQ(shortened("\u00e4\u00f6\u00fc\u00df", 3), "\u00e4\u00f6\u2026");
  EXPECT_EQ(shortened("\u00e4\u00f6\u00fc", 3), "\u00e4\u00f6\u00fc");
}

TEST(PanelTitle, OfTwoLinesRunsNothingOfWhatSomebodyCalledAGroup) {
  const PanelGrid grid{.num_columns = 4};
  const std::string script = grid_plot(
      grid,
      {{.title = "group `touch here`, another condition", .before = "", .plot = "plot x"}}, 6.6,
      2.0);
  EXPECT_NE(script.find("set title 'group `touch here`,'.\"\\n\".'another condition'"),
            std::string::npos)
      << script;
}

}  // namespace plot_parts_test
}  // namespace jnd::analysis
