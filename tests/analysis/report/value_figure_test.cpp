#include "analysis/report/value_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/report/power_law_figure.h"
#include "core/error.h"

namespace jnd::analysis {
namespace value_figure_test {

double number(const FigureTable& table, std::size_t row, const char* column) {
  return table.rows.at(row).at(table.place_of(column)).number.value();
}

const FigureTable& table_of(const Figure& figure, const std::string& name) {
  for (const FigureTable& table : figure.tables) {
    if (table.name == name) return table;
  }
  throw core::Error("no table " + name);
}

// By hand: 1, 2, 3 have the mean 2 and the standard deviation 1, so the interval is 2 -+ 4.3027
// / sqrt(3).
TEST(ValueFigure, DrawsMeansWithStudentsInterval) {
  const Figure figure = value_figure(
      {{.name = "", .conditions = {"a", "b"}, .values = {{1, 2, 3}, {4, 4}}}}, "x");
  const FigureTable& means = table_of(figure, "means");
  ASSERT_EQ(means.rows.size(), 2U);
  EXPECT_DOUBLE_EQ(number(means, 0, "mean"), 2.0);
  EXPECT_NEAR(number(means, 0, "low"), 2.0 - 4.302652729749 / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(number(means, 0, "high"), 2.0 + 4.302652729749 / std::sqrt(3.0), 1e-9);
  EXPECT_EQ(number(means, 1, "num_values"), 2.0);
  EXPECT_TRUE(table_of(figure, "pairs").rows.empty());
}

TEST(ValueFigure, JoinsTheValuesOfAPersonAndNobodyElses) {
  const Figure figure = value_figure({{.name = "",
                                       .conditions = {"a", "b", "c"},
                                       .values = {{1, 2}, {3, 5}, {4, 9}},
                                       .are_paired = true}},
                                     "x");
  const FigureTable& pairs = table_of(figure, "pairs");
  ASSERT_EQ(pairs.rows.size(), 4U);  // The rows are two people with two steps each.
  EXPECT_EQ(number(pairs, 3, "value"), 5.0);
  EXPECT_EQ(number(pairs, 3, "next"), 4.0);  // The step is from 5 to 9.
}

TEST(ValueFigure, PutsEqualValuesBesideOneAnother) {
  const FigureTable values =
      table_of(value_figure({{.name = "", .conditions = {"a"}, .values = {{5, 5, 5, 9}}}}, "x"),
               "values");
  EXPECT_EQ(number(values, 0, "place"), 1.0);
  EXPECT_GT(number(values, 1, "place"), 1.0);
  EXPECT_LT(number(values, 2, "place"), 1.0);
  EXPECT_EQ(number(values, 3, "place"), 1.0);
}

TEST(ValueFigure, DrawsTheLineOfLeastSquares) {
  const std::vector<ComparedValues> groups = {
      {.name = "", .conditions = {"a", "b"}, .values = {{0, 1, 2}, {1, 2, 6}}}};
  // By hand: the slope is 5 / 2, through the means 1 and 3.
  const Figure figure = scatter_figure(groups, /*has_line=*/true);
  const FigureTable& lines = table_of(figure, "lines");
  EXPECT_DOUBLE_EQ(number(lines, 0, "second"), 0.5);
  EXPECT_DOUBLE_EQ(number(lines, 1, "second"), 5.5);
  EXPECT_EQ(scatter_figure(groups, /*has_line=*/false).tables.size(), 1U);
}

TEST(ValueFigure, WithoutValuesThereIsNothingToDraw) {
  EXPECT_THROW((void)value_figure({{.name = "", .conditions = {"a"}, .values = {{}}}}, "x"),
               core::Error);
  EXPECT_THROW((void)power_law_figure({{.name = "", .rows = {}, .k = {}, .a = {}}}),
               core::Error);
}

TEST(PowerLawFigure, DrawsTheLawWithItsThresholdAndOffset) {
  const Figure figure = power_law_figure({{.name = "",
                                           .rows = {{1.0, 2.0}, {9.0, 20.0}},
                                           .k = 2.0,
                                           .a = 2.0,
                                           .intensity_threshold = 1.0,
                                           .magnitude_offset = 0.5}});
  const FigureTable& laws = table_of(figure, "laws");
  ASSERT_FALSE(laws.rows.empty());
  for (std::size_t row = 0; row < laws.rows.size(); ++row) {
    const double x = number(laws, row, "intensity");
    ASSERT_GT(x, 1.0);  // The law says nothing below its threshold.
    EXPECT_DOUBLE_EQ(number(laws, row, "magnitude"), 0.5 + 2.0 * (x - 1.0) * (x - 1.0));
  }
}

TEST(PowerLawFigure, HasLinearAxesWhereAMagnitudeIsBelowZero) {
  const auto plot = [](double magnitude) {
    return power_law_figure(
               {{.name = "", .rows = {{1.0, magnitude}, {2.0, 3.0}}, .k = {}, .a = {}}})
        .plot;
  };
  EXPECT_NE(plot(1.0).find("logscale"), std::string::npos);
  EXPECT_EQ(plot(-1.0).find("logscale"), std::string::npos);
}

}  // namespace value_figure_test
}  // namespace jnd::analysis
