#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/charts/charts.h"
#include "analysis/felt_figures.h"
#include "analysis/report/chart_figures.h"
#include "analysis/report/report_results.h"
#include "analysis/report/threshold_methods.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace threshold_report_test {

using ThresholdReportTest = FeltFiguresTest;

TEST_F(ThresholdReportTest, DrawsEveryonesAnswersAndTheCurvesThatExist) {
  const std::vector<Figure> figures = chart_figures(threshold_charts(source()));
  ASSERT_EQ(figures.size(), 1U);
  const Figure& figure = figures.front();
  EXPECT_EQ(figure.name, "felt_participants");
  EXPECT_EQ(figure.section, "felt");
  ASSERT_EQ(figure.tables.size(), 2U);
  EXPECT_EQ(figure.tables[0].rows.size(), 6U);
  EXPECT_NE(figure.plot.find("P01   0.200 Pa s"), std::string::npos) << figure.plot;
  EXPECT_NE(figure.plot.find("P02   no value"), std::string::npos);
  for (const auto& row : figure.tables[1].rows) EXPECT_EQ(row[1].text, "P01");
  EXPECT_EQ(figure.plot.find("yerrorbars"), std::string::npos) << "levels of a staircase";
}

TEST_F(ThresholdReportTest, DrawsStaircasesWithTheirReversals) {
  const std::vector<Figure> figures = chart_figures(track_charts(source()));
  ASSERT_EQ(figures.size(), 1U);
  const Figure& figure = figures.front();
  EXPECT_EQ(figure.name, "felt_tracks");
  EXPECT_EQ(figure.section, "felt_staircase");
  EXPECT_NE(figure.caption.find("1 up, 2 down"), std::string::npos);
  const FigureTable& table = figure.tables.front();
  ASSERT_EQ(table.rows.size(), 6U);
  const std::size_t reversal = 6;
  EXPECT_EQ(table.columns[reversal], "reversal");
  EXPECT_FALSE(table.rows[0][reversal].number.has_value());
  EXPECT_EQ(table.rows[1][reversal].number, 0.2);
  EXPECT_EQ(table.rows[3][0].number, 2.0) << "a series a track, over all participants";
  EXPECT_NE(figure.plot.find("set ytics (0.2, 0.3, 0.5)"), std::string::npos) << figure.plot;
}

TEST_F(ThresholdReportTest, ANumberThatMayBeWrongSaysSoBesideIt) {
  ResultsSection section{.name = "felt"};
  section.estimates = {{.name = "felt.threshold",
                        .value = 0.2,
                        .meaning = "the level felt in 50 %",
                        .primary = true,
                        .cautions = {"few answers"}},
                       {.name = "felt.spread_ln", .value = 0.5, .meaning = "its spread"}};
  section.participants = {{"P01", "felt.threshold", 0.2, {}, "", {"one answer"}},
                          {"P02", "felt.threshold", 0.3, {}, "", {"one answer"}}};
  HtmlText html;
  write_section(html, data_, results_, {}, section);
  const auto has = [&](const std::string& part) {
    return html.text().find(part) != std::string::npos;
  };
  EXPECT_TRUE(has("the level felt in 50 %. Caution: few answers")) << html.text();
  EXPECT_FALSE(has("its spread. Caution"));
  EXPECT_TRUE(has(">0.2000 §<"));
  EXPECT_TRUE(has("§ P02, felt.threshold: one answer"));
  HtmlText glance;
  StudyResults results{.study = "by_hand", .sections = {section}};
  write_at_a_glance(glance, results, {});
  EXPECT_NE(glance.text().find(". Caution: few answers"), std::string::npos);
}

TEST_F(ThresholdReportTest, TheFirstPageTellsNoValueThatItsOwnFitRejects) {
  ResultsSection section{.name = "group"};
  section.estimates = {{.name = "group.weber_fraction_median_person",
                        .value = 0.2468,
                        .ci95 = {0.1357, 0.3579},
                        .meaning = "median person's w",
                        .primary = true,
                        .is_rejected_by_fit = true}};
  const StudyResults results{.study = "by_hand", .sections = {section}};
  HtmlText glance, supplement;
  write_at_a_glance(glance, results, {});
  for (const char* number : {"0.2468", "0.1357", "0.3579"}) {
    EXPECT_EQ(glance.text().find(number), std::string::npos) << number;
  }
  EXPECT_NE(glance.text().find("its own goodness of fit rejects"), std::string::npos);
  write_section(supplement, data_, results, {}, section);
  EXPECT_NE(supplement.text().find("0.2468"), std::string::npos);
}

TEST_F(ThresholdReportTest, SectionsOfAProcedureAreTitledByIt) {
  StudyTitles titles;
  titles.stages["felt"] = "Least viscosity";
  EXPECT_EQ(section_title(titles, "felt_staircase"), "Least viscosity: staircases");
  EXPECT_EQ(section_title(titles, "felt_intervals"), "Least viscosity: order of the intervals");
  titles.stages["felt_limits"] = "A block of its own";
  EXPECT_EQ(section_title(titles, "felt_limits"), "A block of its own");
}

TEST_F(ThresholdReportTest, SectionsOfTheWholeStudyAreTitledInTheReportsLanguage) {
  StudyTitles titles;
  titles.stages["movement"] = "Movement";
  EXPECT_EQ(section_title(titles, "response_times"), "Response times");
  speak({.code = "xx", .words = [](const char*) { return "translated"; }});
  const std::string whole = section_title(titles, "response_times");
  const std::string own = section_title(titles, "movement");
  speak({});
  EXPECT_EQ(whole, "translated");
  EXPECT_EQ(own, "Movement") << "a study's own title stays as it is";
}

TEST_F(ThresholdReportTest, MethodsTellWhatTheStudyHasAndNothingElse) {
  std::string all;
  add_threshold_methods(
      data_, [](const std::string& work) { return work; },
      [&](const std::string& topic, const std::string& text) { all += topic + text; });
  for (const char* part :
       {"felt in 50 %", "Levitt 1971", "Kaernbach 1991", "Geometric means"}) {
    EXPECT_NE(all.find(part), std::string::npos) << part;
  }
  for (const char* part : {"Watson", "Gescheider", "differencing", "Hautus", "interval bias"}) {
    EXPECT_EQ(all.find(part), std::string::npos) << part;
  }
}

}  // namespace threshold_report_test
}  // namespace jnd::analysis
