#include "app/gui/views/chart_plot.h"

#include <gtest/gtest.h>

namespace jnd::app::gui {
namespace chart_plot_test {

using analysis::Chart;
using analysis::ChartSeries;
using analysis::ChartSet;

ChartSet two_series() {
  ChartSet set{.heading = "Felt",
               .x = {.label = "test viscosity", .unit = "Pa s", .logarithmic = true},
               .y = {.label = "“yes” in percent", .is_proportion = true}};
  set.tables = {{.name = "answers",
                 .columns = {"series", "intensity", "num_yes", "num_trials", "ratio", "low"},
                 .rows = {{1, 0.1, 2.0, 10.0, 0.2, 0.1},
                          {2, 0.1, 9.0, 10.0, 0.9, {}},
                          {1, 0.4, 8.0, 10.0, 0.8, {}}}}};
  return set;
}

TEST(ChartPlot, ShowsTheRowsOfItsSeriesInPercent) {
  const ChartSet set = two_series();
  const Chart chart{.series = {{.look = ChartSeries::Look::kAnswers,
                                .series = 1,
                                .x = "intensity",
                                .y = "ratio",
                                .low = "low",
                                .high = "none"}},
                    .lines = {{.at = 0.2, .until = 0.5}}};
  const PlotModel plot = chart_plot(set, chart);
  EXPECT_EQ(plot.title, "Felt");
  EXPECT_EQ(plot.unit, "“yes” in percent");
  EXPECT_EQ(plot.x.label, "test viscosity");
  EXPECT_TRUE(plot.x.logarithmic);
  EXPECT_EQ(plot.y.maximum, 100.0);
  ASSERT_EQ(plot.series.size(), 1U);
  const PlotSeries& points = plot.series[0];
  EXPECT_EQ(points.x, (std::vector<double>{0.1, 0.4}));
  EXPECT_EQ(points.y, (std::vector<double>{20.0, 80.0}));
  EXPECT_EQ(points.low, (std::vector<double>{10.0, 80.0})) << "a point without a bar";
  EXPECT_EQ(points.names, (std::vector<std::string>{"2 of 10", "8 of 10"}));
  ASSERT_EQ(plot.marks.size(), 1U);
  EXPECT_EQ(plot.marks[0].at, 0.2);
  EXPECT_EQ(plot.marks[0].until, 50.0);
}

TEST(ChartPlot, MoreAnswersMakeALargerPointAndAllRowsAreASeries) {
  ChartSet set = two_series();
  set.tables[0].rows[2][3] = 40.0;
  const Chart chart{.series = {{.look = ChartSeries::Look::kManyAnswers,
                                .x = "intensity",
                                .y = "ratio",
                                .size = "num_trials"}}};
  const PlotModel plot = chart_plot(set, chart);
  ASSERT_EQ(plot.series[0].radii.size(), 3U);
  EXPECT_GT(plot.series[0].radii[2], plot.series[0].radii[0]);
  EXPECT_TRUE(plot.series[0].low.empty());
}

TEST(ChartPlot, AnIdentityReachesAsFarAsBothAxes) {
  ChartSet set = two_series();
  set.x.range = {1.0, 10.0};
  set.y = {.label = "Match: viscosity", .unit = "Pa s", .range = {2.0, 20.0}};
  const PlotModel plot = chart_plot(set, {.series = {{.look = ChartSeries::Look::kIdentity}}});
  EXPECT_EQ(plot.series[0].x, (std::vector<double>{2.0, 10.0}));
  EXPECT_TRUE(plot.series[0].dashed);
}

}  // namespace chart_plot_test
}  // namespace jnd::app::gui
