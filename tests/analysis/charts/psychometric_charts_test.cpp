#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/charts/chart_parts.h"
#include "analysis/charts/charts.h"
#include "analysis/hand_made_study.h"
#include "analysis/results/number_words.h"

namespace jnd::analysis {
namespace psychometric_charts_test {

using Look = ChartSeries::Look;

/// People who compared 4 and 12 Pa s with 8 Pa s, ten times each.
class PsychometricChartsTest : public ::testing::Test {
 protected:
  /// Adds a person for each number, which says how many of ten answers are right at either
  /// level.
  void add_people(const std::vector<int>& nums_right) {
    for (const int num_right : nums_right) {
      study_.add("P0" + std::to_string(++num_people_));
      study_.compare_ten("thicker", num_right);
    }
  }
  /// Returns the charts of the block, made from what the study contains by then.
  const ChartSet& set() {
    data_ = load_study(study_.store());
    results_ = results_of(data_, {}, {.num_resamples = 50});
    titles_.stages["thicker"] = "Thicker: a title";
    sets_ = psychometric_charts(source());
    return sets_.at(0);
  }
  [[nodiscard]] FigureSource source() const {
    return {.data = data_, .results = results_, .titles = titles_};
  }
  const Estimate& found(const std::string& name) { return *results_.find("thicker." + name); }
  const ParticipantEstimate& own(const std::string& who, const std::string& name) {
    return *source().own("thicker", who, "thicker." + name);
  }

  HandMadeStudy study_;
  StudyData data_;
  StudyResults results_;
  StudyTitles titles_;
  std::vector<ChartSet> sets_;
  int num_people_ = 0;
};

const ChartSeries* series_of(const Chart& chart, Look look) {
  const auto found = std::ranges::find(chart.series, look, &ChartSeries::look);
  return found == chart.series.end() ? nullptr : &*found;
}

struct Row {
  double x = 0.0, y = 0.0;
  std::optional<double> low, high;
};
std::vector<Row> rows_of(const ChartSet& set, const ChartSeries& series) {
  const FigureTable& table = set.tables[series.table];
  std::vector<Row> rows;
  for (const auto& row : table.rows) {
    if (series.series && row[table.place_of("series")].number != *series.series) continue;
    rows.push_back({row[table.place_of(series.x)].number.value(),
                    row[table.place_of(series.y)].number.value()});
    if (table.place_of(series.low) == table.columns.size()) continue;
    rows.back().low = row[table.place_of(series.low)].number;
    rows.back().high = row[table.place_of(series.high)].number;
  }
  return rows;
}

double y_at(const std::vector<Row>& curve, double x) {
  const auto next =
      std::find_if(curve.begin(), curve.end(), [x](const Row& row) { return row.x >= x; });
  if (next == curve.begin() || next == curve.end()) return NAN;
  const Row& before = *std::prev(next);
  return before.y + (next->y - before.y) * (x - before.x) / (next->x - before.x);
}

std::string fraction_words(double value) { return "w = " + number_words(value, 2); }

TEST_F(PsychometricChartsTest, ValuesAreThoseOfTheResults) {
  add_people({7, 8, 9, 8, 7, 9});
  const ChartSet& charts = set();
  EXPECT_EQ(charts.section, "thicker");
  EXPECT_EQ(charts.heading, "Thicker: a title");
  EXPECT_EQ(charts.x.unit, "Pa s");
  const Chart& everybody = charts.everybody.value();
  const Estimate& person = found("weber_fraction_median_person");
  ASSERT_TRUE(person.primary && person.value);
  EXPECT_EQ(everybody.value, fraction_words(*person.value));
  EXPECT_TRUE(everybody.detail.starts_with("95 % " + interval_words(person.ci95, person.value)))
      << everybody.detail;
  EXPECT_NE(everybody.detail.find("median person · curve through all answers 0."),
            std::string::npos)
      << everybody.detail;
  ASSERT_EQ(charts.participants.size(), 6U);
  for (const Chart& chart : charts.participants) {
    const ParticipantEstimate& primary = own(chart.who, "weber_fraction_free_pse");
    ASSERT_TRUE(primary.primary && primary.value);
    EXPECT_EQ(chart.value, fraction_words(*primary.value));
  }
}

TEST_F(PsychometricChartsTest, EverybodysPointsAreMeansWithTheSpreadBetweenPeople) {
  add_people({10, 10, 9, 5});
  const ChartSet& charts = set();
  const ChartSeries& points = charts.everybody->series.back();
  EXPECT_EQ(points.look, Look::kAnswers);
  const std::vector<Row> rows = rows_of(charts, points);
  ASSERT_EQ(rows.size(), 2U);
  // At 12, 10, 10, 9 and 5 of 10 answers are "more". The mean is 0.85 and the variance 0.17 /
  // 3.
  EXPECT_EQ(rows[1].x, 12.0);
  EXPECT_NEAR(rows[1].y, 0.85, 1e-12);
  EXPECT_NEAR(rows[1].low.value(), 0.85 - std::sqrt(0.17 / 3.0), 1e-12);
  EXPECT_EQ(rows[1].high, 1.0) << "cut: 0.85 + 0.238 is more than all";
  EXPECT_EQ(rows[0].low, 0.0);
  const FigureTable& table = charts.tables[points.table];
  EXPECT_EQ(table.rows[1][table.place_of("num_yes")].number, 34.0);
  EXPECT_EQ(table.rows[1][table.place_of("num_trials")].number, 40.0);
}

TEST_F(PsychometricChartsTest, ManyPeoplesCurvesAreABand) {
  std::vector<int> nums_right;
  for (std::size_t i = 0; i <= kMostLines; ++i)
    nums_right.push_back(7 + static_cast<int>(i % 3));
  add_people(nums_right);
  const ChartSet& charts = set();
  const Chart& everybody = charts.everybody.value();
  EXPECT_EQ(series_of(everybody, Look::kFaintCurve), nullptr);
  const ChartSeries* const spread = series_of(everybody, Look::kSpread);
  ASSERT_NE(spread, nullptr);
  EXPECT_EQ(spread->legend, "middle 90 % of the participants’ own curves");
  EXPECT_NE(charts.whole->caption.find("own curves, of which there are 41 (maximum"),
            std::string::npos)
      << charts.whole->caption;
  // The ends of the band are the flattest and the steepest curve, each of which a third of the
  // people have.
  const FigureTable& table = charts.tables[spread->table];
  ASSERT_FALSE(table.rows.empty());
  std::vector<std::vector<Row>> curves;
  for (const Chart& chart : charts.participants) {
    curves.push_back(rows_of(charts, *series_of(chart, Look::kCurve)));
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    double lowest = 1.0, highest = 0.0;
    for (const std::vector<Row>& curve : curves) {
      ASSERT_EQ(curve[i].x, table.rows[i][0].number);
      lowest = std::min(lowest, curve[i].y);
      highest = std::max(highest, curve[i].y);
    }
    EXPECT_NEAR(table.rows[i][2].number.value(), lowest, 1e-9);
    EXPECT_NEAR(table.rows[i][3].number.value(), highest, 1e-9);
  }
}

TEST_F(PsychometricChartsTest, OnePersonHasNoSpreadBetweenPeople) {
  add_people({8});
  const ChartSet& charts = set();
  const std::vector<Row> rows = rows_of(charts, charts.everybody->series.back());
  EXPECT_EQ(rows[1].y, 0.8);
  EXPECT_FALSE(rows[1].low || rows[1].high);
}

TEST_F(PsychometricChartsTest, LevelsThatAnswersLedToAreAddedUp) {
  for (const char* name : {"P01", "P02"}) {
    study_.add(name);
    for (const double response : {1.0, 0.0, 1.0}) {
      (void)study_.answer({.block = "thicker",
                           .procedure = "staircase",
                           .quantity = "viscosity_pa_s",
                           .repetition = 1,
                           .intensity = 9.0,
                           .reference_intensity = 8.0,
                           .response = response});
    }
  }
  const ChartSet& charts = set();
  const ChartSeries& points = charts.everybody->series.back();
  EXPECT_EQ(points.look, Look::kManyAnswers);
  const std::vector<Row> rows = rows_of(charts, points);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(rows[0].y, 4.0 / 6.0, 1e-12);
  EXPECT_EQ(series_of(charts.participants[0], Look::kAnswers), nullptr);
}

TEST_F(PsychometricChartsTest, CurvesAreHalfAtThePseAndEightyFourPercentAtTheLine) {
  add_people({9, 9, 9, 9, 8, 9});
  const ChartSet& charts = set();
  const Chart& everybody = *charts.everybody;
  const std::vector<Row> person = rows_of(charts, *series_of(everybody, Look::kCurve));
  const double pse = found("pse_median_person").value.value();
  const double w = found("weber_fraction_median_person").value.value();
  EXPECT_NEAR(y_at(person, pse), 0.5, 1e-3);
  ASSERT_EQ(everybody.lines.size(), 2U);
  EXPECT_EQ(everybody.lines[0].at, 8.0) << "the reference";
  EXPECT_DOUBLE_EQ(everybody.lines[1].at, pse * (1.0 + w));
  EXPECT_NEAR(everybody.lines[1].until.value(), 0.8413447, 1e-6);
  const Chart& steep = charts.participants[2];
  const std::vector<Row> own_curve = rows_of(charts, *series_of(steep, Look::kCurve));
  EXPECT_NEAR(y_at(own_curve, steep.lines[1].at), 0.8413, 1e-3);
  // The other curve is fitted to everybody's answers, of which 53 of 60 are right at 1.5 times
  // the reference.
  const std::vector<Row> group = rows_of(charts, *series_of(everybody, Look::kOtherCurve));
  EXPECT_NEAR(y_at(group, 12.0), 53.0 / 60.0, 1e-3);
  EXPECT_EQ(std::ranges::count(everybody.series, Look::kFaintCurve, &ChartSeries::look), 6);
}

TEST_F(PsychometricChartsTest, AWeberLineBeyondTheStimuliIsLeftOut) {
  add_people({6, 6, 6, 7, 6, 7});
  const ChartSet& charts = set();
  const double w = own("P01", "weber_fraction_free_pse").value.value();
  ASSERT_GT(8.0 * (1.0 + w), charts.x.range.high) << "or this says nothing";
  EXPECT_EQ(charts.participants[0].lines.size(), 1U);
}

TEST_F(PsychometricChartsTest, TheBandLiesBetweenTheCurvesOfTheIntervalsEnds) {
  add_people({7, 8, 9, 8, 7, 9});
  const ChartSet& charts = set();
  for (const Chart* chart : {&*charts.everybody, &charts.participants[0]}) {
    const std::vector<Row> band = rows_of(charts, *series_of(*chart, Look::kBand));
    for (const Row& row : band) {
      EXPECT_LE(row.low.value(), row.y + 1e-12);
      EXPECT_GE(row.high.value(), row.y - 1e-12);
    }
  }
  // The steep end is worked out by hand from the interval of P01.
  const double w = own("P01", "weber_fraction_free_pse").ci95.low.value();
  const double pse = own("P01", "pse").value.value();
  const Row last = rows_of(charts, *series_of(charts.participants[0], Look::kBand)).back();
  const double z = std::log(last.x / pse) / std::log1p(w);
  EXPECT_NEAR(last.high.value(), 0.5 * std::erfc(-z / std::sqrt(2.0)), 1e-12);
}

TEST_F(PsychometricChartsTest, AnOpenEndOfTheBandIsAFlatLine) {
  add_people({6});
  const ChartSet& charts = set();
  ASSERT_FALSE(own("P01", "weber_fraction").ci95.high.has_value());
  const ChartSeries* const band = series_of(charts.participants[0], Look::kBand);
  ASSERT_NE(band, nullptr);
  EXPECT_EQ(rows_of(charts, *band).back().low, 0.5);
  EXPECT_EQ(series_of(*charts.everybody, Look::kBand), nullptr)
      << "one participant says nothing of others";
}

TEST_F(PsychometricChartsTest, AFitThatDoesNotExistSaysWhyInPlainWords) {
  add_people({10});
  const ChartSet& charts = set();
  for (const Chart* chart : {&*charts.everybody, &charts.participants[0]}) {
    EXPECT_EQ(chart->value, "");
    EXPECT_NE(chart->reason, "");
    EXPECT_EQ(series_of(*chart, Look::kCurve), nullptr);
    EXPECT_EQ(rows_of(charts, chart->series.back()).size(), 2U);
  }
  EXPECT_TRUE(charts.participants[0].reason.starts_with("every answer fell on its side of "))
      << charts.participants[0].reason;
}

TEST_F(PsychometricChartsTest, AParticipantHasTheFractionOfThePrimaryPseAndTheOtherBeside) {
  add_people({9, 8});
  for (int answered = 0; answered < 10; ++answered) {
    study_.compare("thicker", 9.0, 8.0, answered < 2);
  }
  const ChartSet& charts = set();
  const double free = own("P02", "weber_fraction_free_pse").value.value();
  const double fixed = own("P02", "weber_fraction").value.value();
  ASSERT_GT(std::fabs(free - fixed), 0.02) << "or this says nothing";
  const Chart& chart = charts.participants[1];
  EXPECT_EQ(chart.value, fraction_words(free));
  EXPECT_TRUE(chart.detail.ends_with("with the pse at the reference " + number_words(fixed, 2)))
      << chart.detail;
  const double pse = own("P02", "pse").value.value();
  EXPECT_NEAR(y_at(rows_of(charts, *series_of(chart, Look::kCurve)), pse), 0.5, 1e-3);
  EXPECT_NEAR(y_at(rows_of(charts, *series_of(chart, Look::kOtherCurve)), 8.0), 0.5, 1e-3);
}

TEST_F(PsychometricChartsTest, CautionsOfTheValueStandBesideTheChart) {
  add_people({8, 9, 8, 9, 1});
  EXPECT_NE(set().everybody->caution.find("P05"), std::string::npos);
}

}  // namespace psychometric_charts_test
}  // namespace jnd::analysis
