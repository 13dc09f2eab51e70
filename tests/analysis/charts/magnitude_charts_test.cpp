#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/charts/charts.h"
#include "analysis/hand_made_study.h"
#include "analysis/results/number_words.h"

namespace jnd::analysis {
namespace magnitude_charts_test {

using Look = ChartSeries::Look;

class MagnitudeChartsTest : public ::testing::Test {
 protected:
  /// One estimates 2 I and the other 8 I, in percent of hundreds. They set 2 and 8 for 100 %, 4
  /// and 16 for 200 %.
  void add_two_estimators() {
    for (const auto& [name, k] : {std::pair{"P01", 2.0}, {"P02", 8.0}}) {
      study_.add(name);
      for (const double intensity : {1.0, 2.0}) {
        study_.estimate(intensity, 50.0 * k * intensity, 1);
        study_.estimate(intensity, 150.0 * k * intensity, 2);
      }
      study_.produce(100.0, k);
      study_.produce(200.0, 2.0 * k);
    }
  }
  const std::vector<ChartSet>& sets() {
    data_ = load_study(study_.store());
    results_ = results_of(data_, {}, {.num_resamples = 50});
    sets_ = magnitude_charts({.data = data_, .results = results_, .titles = titles_});
    return sets_;
  }

  HandMadeStudy study_;
  StudyData data_;
  StudyResults results_;
  StudyTitles titles_;
  std::vector<ChartSet> sets_;
};

const ChartSeries& series_of(const Chart& chart, Look look) {
  const auto found = std::ranges::find(chart.series, look, &ChartSeries::look);
  EXPECT_NE(found, chart.series.end());
  return *found;
}

std::vector<double> column_of(const ChartSet& set, const ChartSeries& series,
                              const std::string& column) {
  const FigureTable& table = set.tables[series.table];
  std::vector<double> numbers;
  for (const auto& row : table.rows) {
    if (series.series && row[table.place_of(series.series_column)].number != *series.series) {
      continue;
    }
    numbers.push_back(row[table.place_of(column)].number.value_or(NAN));
  }
  return numbers;
}

TEST_F(MagnitudeChartsTest, EverybodysMeansHaveTheSpreadBetweenPeople) {
  add_two_estimators();
  const std::vector<ChartSet>& all = sets();
  ASSERT_EQ(all.size(), 3U) << "estimation, production, and the laws";
  const ChartSeries& means = series_of(*all[0].everybody, Look::kAnswers);
  EXPECT_FALSE(means.has_bars_along_x);
  // The participants' means at intensity 1 are 2 and 8, with mean 5 and sd 3 sqrt 2.
  EXPECT_EQ(column_of(all[0], means, "intensity"), (std::vector<double>{1.0, 2.0}));
  EXPECT_NEAR(column_of(all[0], means, "magnitude")[0], 5.0, 1e-12);
  EXPECT_NEAR(column_of(all[0], means, "high")[0], 5.0 + 3.0 * std::sqrt(2.0), 1e-12);
  const ChartSeries& produced = series_of(*all[1].everybody, Look::kAnswers);
  EXPECT_TRUE(produced.has_bars_along_x) << "intensities were set";
  EXPECT_EQ(column_of(all[1], produced, "magnitude"), (std::vector<double>{1.0, 2.0}));
  EXPECT_NEAR(column_of(all[1], produced, "intensity")[1], 10.0, 1e-12);
}

TEST_F(MagnitudeChartsTest, AParticipantsMeansHaveTheSpreadOfTheirOwnAnswers) {
  add_two_estimators();
  const ChartSet& estimation = sets()[0];
  ASSERT_EQ(estimation.participants.size(), 2U);
  const ChartSeries& means = series_of(estimation.participants[0], Look::kAnswers);
  // P01 said 1 and 3 at intensity 1, so the mean is 2 and the sd sqrt 2.
  EXPECT_NEAR(column_of(estimation, means, "magnitude")[0], 2.0, 1e-12);
  EXPECT_NEAR(column_of(estimation, means, "low")[0], 2.0 - std::sqrt(2.0), 1e-12);
  // Each production has one answer.
  const ChartSet& production = sets_[1];
  const ChartSeries& produced = series_of(production.participants[0], Look::kAnswers);
  EXPECT_TRUE(std::isnan(column_of(production, produced, "low")[0]));
}

TEST_F(MagnitudeChartsTest, PowerLawsAreThoseOfTheResults) {
  add_two_estimators();
  const ChartSet& estimation = sets()[0];
  const Estimate& k = *results_.find("estimation.k");
  const Estimate& a = *results_.find("estimation.a");
  EXPECT_EQ(estimation.everybody->value,
            "k = " + number_words(k.value, 3) + ", a = " + number_words(a.value, 3));
  EXPECT_EQ(estimation.participants[1].value, "k = 8.000, a = 1.000");
  const ChartSeries& curve = series_of(*estimation.everybody, Look::kCurve);
  const std::vector<double> x = column_of(estimation, curve, "intensity");
  const std::vector<double> y = column_of(estimation, curve, "magnitude");
  ASSERT_GT(x.size(), 100U);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(y[i], 5.0 * x[i], 1e-5);
}

TEST_F(MagnitudeChartsTest, TheLawBetweenBothStandsInAChartOfItsOwnOnLogarithmicAxes) {
  add_two_estimators();
  const ChartSet& laws = sets()[2];
  EXPECT_EQ(laws.section, "combined");
  EXPECT_TRUE(laws.x.logarithmic && laws.y.logarithmic);
  const Estimate& k = *results_.find("combined.k");
  EXPECT_TRUE(laws.everybody->value.starts_with("k = " + number_words(k.value, 3)));
  // The measured intensities reach from 1 to 10. The line beyond them is dotted.
  const ChartSeries& beyond = series_of(*laws.everybody, Look::kBeyond);
  for (const double x : column_of(laws, beyond, "intensity")) {
    EXPECT_TRUE(x < 1.0 || x > 2.0) << x << ", estimation went from 1 to 2";
  }
  ASSERT_EQ(laws.participants.size(), 2U);
  EXPECT_EQ(laws.participants[0].value,
            "estimation k = 2.000, a = 1.000 · production k = 0.500, a = 1.000");
}

TEST_F(MagnitudeChartsTest, APowerLawThatDoesNotExistSaysWhy) {
  study_.add("P01");
  study_.estimate(1.0, 100.0);
  const std::vector<ChartSet>& all = sets();
  ASSERT_EQ(all.size(), 1U);
  for (const Chart* chart : {&*all[0].everybody, &all[0].participants[0]}) {
    EXPECT_EQ(chart->value, "");
    EXPECT_NE(chart->reason, "");
    EXPECT_EQ(std::ranges::count(chart->series, Look::kCurve, &ChartSeries::look), 0);
  }
}

}  // namespace magnitude_charts_test
}  // namespace jnd::analysis
