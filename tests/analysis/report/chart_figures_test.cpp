#include "analysis/report/chart_figures.h"

#include <gtest/gtest.h>

#include <set>

namespace jnd::analysis {
namespace chart_figures_test {

using Look = ChartSeries::Look;

/// Returns the charts of `num_people` people. Each person has a curve of three rows and answers
/// of two rows.
ChartSet set_of(int num_people) {
  ChartSet set{.section = "group_d",
               .panels = PanelFigures{.name = "people", .most_panels = 20},
               .tables = {{.name = "answers", .columns = {"series", "x", "y"}},
                          {.name = "curves", .columns = {"series", "x", "y"}}}};
  set.x.range = set.y.range = {0.0, 1.0};
  for (int series = 1; series <= num_people; ++series) {
    Chart chart{.who = "P" + std::to_string(series)};
    for (int row = 0; row < 2; ++row) set.tables[0].rows.push_back({series, row, 0.5});
    for (int row = 0; row < 3; ++row) set.tables[1].rows.push_back({series, row, 0.25});
    chart.series = {
        {.look = Look::kCurve, .table = 1, .series = series, .x = "x", .y = "y"},
        {.look = Look::kManyAnswers, .table = 0, .series = series, .x = "x", .y = "y"}};
    set.participants.push_back(std::move(chart));
  }
  return set;
}

std::set<double> series_in(const FigureTable& table) {
  std::set<double> series;
  for (const auto& row : table.rows) series.insert(row[0].number.value());
  return series;
}

TEST(ChartFigures, AFigureOfEverybodyReadsTheTablesOfTheSet) {
  const std::vector<Figure> figures = chart_figures({set_of(20)});
  ASSERT_EQ(figures.size(), 1U);
  ASSERT_EQ(figures[0].tables.size(), 2U);
  EXPECT_EQ(figures[0].tables[0].name, "answers");
  EXPECT_EQ(figures[0].tables[0].rows.size(), 40U);
  EXPECT_EQ(figures[0].plot.find(" every "), std::string::npos);
}

TEST(ChartFigures, EachOfManyFiguresReadsItsOwnPeopleOnly) {
  const std::vector<Figure> figures = chart_figures({set_of(45)});
  ASSERT_EQ(figures.size(), 3U);
  std::set<std::string> names;
  std::size_t num_rows = 0;
  for (const Figure& figure : figures) {
    ASSERT_EQ(figure.tables.size(), 2U);
    for (const FigureTable& table : figure.tables) {
      EXPECT_TRUE(names.insert(table.name).second) << table.name << " is written twice";
      num_rows += table.rows.size();
    }
    EXPECT_EQ(series_in(figure.tables[0]), series_in(figure.tables[1]));
  }
  EXPECT_EQ(num_rows, 45U * 5U) << "every row once";
  EXPECT_EQ(series_in(figures[0].tables[0]).size(), 20U);
  EXPECT_EQ(*series_in(figures[1].tables[0]).begin(), 21.0);
  EXPECT_EQ(series_in(figures[2].tables[0]), (std::set<double>{41, 42, 43, 44, 45}));
  EXPECT_EQ(figures[1].name, "people_2");
}

TEST(ChartFigures, APanelOfManyFiguresReadsTheRowsOfItsPerson) {
  const std::vector<Figure> figures = chart_figures({set_of(45)});
  // P42 is the second person of the third figure, with rows 3 to 5 of the curves, and 2 and 3
  // of the answers.
  EXPECT_NE(figures[2].plot.find("'curves_page_3.csv' every ::3::5 using 'x':'y'"),
            std::string::npos)
      << figures[2].plot;
  EXPECT_NE(figures[2].plot.find("'answers_page_3.csv' every ::2::3 using 'x':'y'"),
            std::string::npos);
}

TEST(ChartFigures, RowsThatDoNotStandTogetherAreLookedForInTheWholeTable) {
  ChartSet set = set_of(45);
  std::swap(set.tables[1].rows.front(), set.tables[1].rows.back());
  const std::vector<Figure> figures = chart_figures({set});
  EXPECT_EQ(figures[0].tables[1].name, "curves");
  EXPECT_EQ(figures[0].tables[1].rows.size(), 45U * 3U);
  EXPECT_EQ(figures[1].tables[1].name, "curves_page_2");
}

}  // namespace chart_figures_test
}  // namespace jnd::analysis
