#include <gtest/gtest.h>

#include <cmath>

#include "analysis/charts/charts.h"
#include "analysis/felt_figures.h"

namespace jnd::analysis {
namespace threshold_charts_test {

using ThresholdChartsTest = FeltFiguresTest;

TEST_F(ThresholdChartsTest, AnswersHaveTheCurveAndTheThresholdOfTheResults) {
  titles_.stages["felt"] = "Felt";
  const std::vector<ChartSet> sets = threshold_charts(source());
  ASSERT_EQ(sets.size(), 1U);
  const ChartSet& set = sets.front();
  EXPECT_EQ(set.heading, "Felt");
  EXPECT_EQ(set.x.unit, "Pa s");
  EXPECT_TRUE(set.x.logarithmic);
  ASSERT_EQ(set.participants.size(), 2U);
  const Chart& own = set.participants[0];
  EXPECT_EQ(own.value, "0.200 Pa s");
  EXPECT_NE(own.detail.find("95 % "), std::string::npos);
  ASSERT_EQ(own.series.size(), 2U) << "the curve and the answers";
  EXPECT_EQ(own.series[1].look, ChartSeries::Look::kManyAnswers)
      << "a staircase has few answers a level";
  const FigureTable& answers = set.tables[own.series[1].table];
  const std::size_t ratio = answers.place_of("ratio");
  EXPECT_NEAR(answers.rows[2][ratio].number.value(), 0.8, 1e-12);
  // The line stands at the threshold and ends where the curve is at one half.
  ASSERT_EQ(own.lines.size(), 1U);
  EXPECT_NEAR(own.lines[0].at, 0.2, 1e-9);
  EXPECT_EQ(own.lines[0].until, 0.5);
  const Chart& without = set.participants[1];
  EXPECT_EQ(without.series.size(), 1U);
  EXPECT_EQ(without.value, "");
  EXPECT_NE(without.reason, "");
}

TEST_F(ThresholdChartsTest, EverybodysAnswersAreAddedUp) {
  const ChartSet set = threshold_charts(source()).front();
  const Chart* const everybody = set.chart_of(kEverybody);
  ASSERT_NE(everybody, nullptr);
  const FigureTable& table = set.tables[everybody->series.front().table];
  EXPECT_EQ(table.rows[0][table.place_of("num_trials")].number, 20.0);
  EXPECT_EQ(set.chart_of("P01"), &set.participants[0]);
  EXPECT_EQ(set.chart_of("P77"), nullptr);
}

TEST_F(ThresholdChartsTest, TracksHaveTheirReversalsAndTheirThreshold) {
  const std::vector<ChartSet> sets = track_charts(source());
  ASSERT_EQ(sets.size(), 1U);
  const ChartSet& set = sets.front();
  EXPECT_EQ(set.section, "felt_staircase");
  EXPECT_TRUE(set.y.logarithmic);
  ASSERT_EQ(set.participants.size(), 2U);
  const Chart& own = set.participants[0];
  EXPECT_EQ(own.value, "0.2000 Pa s");
  ASSERT_EQ(own.series.size(), 2U);
  EXPECT_EQ(own.series[0].look, ChartSeries::Look::kTrack);
  EXPECT_EQ(own.series[1].y, "reversal");
  const FigureTable& table = set.tables.front();
  EXPECT_EQ(table.rows.size(), 6U) << "three trials of each";
  EXPECT_FALSE(table.rows[0][table.place_of("reversal")].number);
  ASSERT_EQ(own.lines.size(), 1U);
  EXPECT_NEAR(own.lines[0].at, 0.2, 1e-12);
  EXPECT_EQ(set.everybody->value, "0.2000 Pa s");
}

TEST_F(ThresholdChartsTest, AllChartsStandInTheOrderOfTheReport) {
  const std::vector<ChartSet> sets = charts_of(source());
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[0].panels->name, "felt_participants");
  EXPECT_EQ(sets[1].panels->name, "felt_tracks");
}

}  // namespace threshold_charts_test
}  // namespace jnd::analysis
