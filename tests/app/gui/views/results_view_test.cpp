#include "app/gui/views/results_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/hand_made_study.h"
#include "app/gui/headless_ui.h"
#include "app/gui/views/chart_plot.h"
#include "app/gui/views/results_parts.h"
#include "app/gui/views/study_fixtures.h"
#include "app/tiny_study.h"

namespace jnd::app::gui {
namespace results_view_test {

ResultsModel some_results() {
  analysis::HandMadeStudy study(kTinyStudy);
  for (const char* name : {"P01", "P02", "P03"}) {
    study.add(name);
    study.compare_ten("comparison", 6 + name[2] - '0');
    for (const double intensity : {1.0, 2.0, 4.0}) study.estimate(intensity, 50.0 * intensity);
    study.produce(100.0, 2.0);
    study.produce(200.0, 4.0 + name[2] - '0');
  }
  study.add("P04");
  study.compare_ten("comparison", 10);
  WorkControl control;
  return results_model(study.folder(), control);
}

class ResultsViewTest : public ::testing::Test {
 protected:
  ResultsViewResult draw(HeadlessUi& ui) {
    ResultsViewResult all;
    ui.frame([&](Ui& now) {
      const ResultsViewResult result = draw_results_view(now, model_, state_);
      if (result.tab != StudyTab::kNone) all.tab = result.tab;
      if (result.export_as) all.export_as = result.export_as;
      all.write_report |= result.write_report;
      if (result.save_picture) all.save_picture = result.save_picture;
      all.open |= result.open;
      all.cancel |= result.cancel;
      all.unblind |= result.unblind;
    });
    return all;
  }
  ResultsViewResult after_key(const Chord& key) {
    (void)draw(ui_);
    ui_.press(key);
    return draw(ui_);
  }

  static const ResultsModel& results() {
    static const ResultsModel kResults = some_results();
    return kResults;
  }
  /// Returns the charts of the block of comparisons.
  static const analysis::ChartSet& comparison() {
    return *std::ranges::find(results().charts, "comparison", &analysis::ChartSet::section);
  }
  StudyFolder study_ = some_study();
  ResultsViewModel model_{.study = study_, .results = &results()};
  ResultsViewState state_;
  HeadlessUi ui_;
};

TEST_F(ResultsViewTest, ShowsTheFractionWithItsIntervalAndTheTable) {
  (void)draw(ui_);
  EXPECT_TRUE(ui_.drawn().shows(comparison().everybody->value));
  EXPECT_TRUE(ui_.drawn().shows("median person"));
  EXPECT_TRUE(ui_.drawn().shows("curve through all answers 0."));
  for (const char* words : {"All participants", "P01", "P04", "pse (1 + w)"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
}

TEST_F(ResultsViewTest, ArrowsShowOneParticipantAfterTheOther) {
  (void)after_key({Key::kDown});
  EXPECT_EQ(shown_participant(results(), state_), "P01");
  const analysis::Chart& own = comparison().participants.front();
  EXPECT_TRUE(ui_.drawn().shows(own.value));
  EXPECT_TRUE(ui_.drawn().shows(own.detail));
  (void)after_key({Key::kUp});
  (void)after_key({Key::kUp});
  EXPECT_EQ(shown_participant(results(), state_), "P04");
  EXPECT_TRUE(ui_.drawn().shows("No value: ")) << all_texts(ui_.drawn());
  ui_.click("participant_2");
  (void)draw(ui_);
  EXPECT_EQ(shown_participant(results(), state_), "P02");
}

TEST_F(ResultsViewTest, EveryPageIsReachedByItsNumber) {
  const std::vector<ResultsPageLook> pages = pages_of(results());
  ASSERT_EQ(pages.size(), 4U);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    (void)after_key({letter(static_cast<char>('1' + i))});
    EXPECT_EQ(state_.page, i);
  }
  EXPECT_TRUE(ui_.drawn().shows("Weber fraction"));
  (void)after_key({letter('1')});
  EXPECT_TRUE(ui_.drawn().shows("Estimation and production")) << all_texts(ui_.drawn());
}

TEST_F(ResultsViewTest, EveryActionHasItsKey) {
  EXPECT_TRUE(after_key({.key = letter('R'), .control = true}).write_report);
  EXPECT_EQ(after_key({.key = letter('1'), .control = true}).tab, StudyTab::kSessions);
}

TEST_F(ResultsViewTest, AnExportAsksForItsFormat) {
  const char* const formats[] = {"csv", "bids", "hdf5", "xdf"};
  for (std::size_t i = 0; i < std::size(formats); ++i) {
    EXPECT_FALSE(after_key({.key = letter('E'), .control = true}).export_as);
    EXPECT_TRUE(ui_.drawn().shows("Export the study as …"));
    const auto chosen = after_key({letter(static_cast<char>('1' + i))}).export_as;
    ASSERT_TRUE(chosen) << formats[i];
    EXPECT_EQ(chosen->format, formats[i]);
    EXPECT_FALSE(chosen->recordings);
    EXPECT_FALSE(state_.asks_for_format);
  }
  (void)after_key({.key = letter('E'), .control = true});
  (void)after_key({letter('R')});
  ui_.click("export_bids");
  const auto with_samples = draw(ui_).export_as;
  ASSERT_TRUE(with_samples);
  EXPECT_TRUE(with_samples->recordings);
  (void)after_key({.key = letter('E'), .control = true});
  EXPECT_FALSE(after_key({Key::kF2}).export_as);
  EXPECT_FALSE(state_.asks_for_format);
}

TEST_F(ResultsViewTest, APictureIsOfTheFiguresOfItsPage) {
  using What = StudyFiguresRequest::What;
  const Chord save{.key = letter('S'), .control = true};
  EXPECT_EQ(after_key(save).save_picture, What::kCharts);
  (void)after_key({letter('2')});
  EXPECT_EQ(after_key(save).save_picture, What::kBoxes);
  (void)after_key({letter('3')});
  EXPECT_EQ(after_key(save).save_picture, std::nullopt) << "a page of words has none";
  EXPECT_FALSE(ui_.drawn().find("save_picture")->enabled);
}

TEST_F(ResultsViewTest, WhatWasWrittenIsOpenedByItsKey) {
  (void)draw(ui_);
  EXPECT_EQ(ui_.drawn().find("open_written"), nullptr) << "nothing was";
  model_.work.outcome = {.sentence = "report.html with 4 figures is in a-report",
                         .problems = {"no browser is installed"},
                         .opens = "a-report/report.html"};
  EXPECT_TRUE(after_key({.key = letter('O'), .control = true}).open);
  EXPECT_TRUE(ui_.drawn().shows("is in a-report · no browser is installed"));
  model_.work.running = "Exporting";
  (void)draw(ui_);
  EXPECT_EQ(ui_.drawn().find("open_written"), nullptr);
}

TEST_F(ResultsViewTest, WorkUnderWayIsShownAndKeepsTheButtonsAway) {
  model_.work = {.running = "Exporting", .progress = 0.5};
  (void)after_key({.key = letter('E'), .control = true});
  EXPECT_FALSE(state_.asks_for_format);
  EXPECT_TRUE(ui_.drawn().shows("Exporting · 50 %"));
  EXPECT_TRUE(after_key({Key::kF2}).cancel);
}

TEST_F(ResultsViewTest, WhileTheyAreComputedThereIsProgressAndNothingToExport) {
  model_.results = nullptr;
  (void)after_key({.key = letter('E'), .control = true});
  EXPECT_FALSE(state_.asks_for_format);
  EXPECT_TRUE(ui_.drawn().shows("Computing the results"));
}

TEST_F(ResultsViewTest, ABlindedStudyShowsTheSentenceAndUnblindsForAReasonAlone) {
  model_.results = nullptr;
  model_.is_blinded = true;
  model_.problem = "expected a study whose levels may be seen, found a double-blind one";
  (void)draw(ui_);
  EXPECT_TRUE(ui_.drawn().shows(model_.problem));
  (void)after_key({.key = letter('U'), .control = true});
  ui_.press(Key::kEnter);
  EXPECT_FALSE(draw(ui_).unblind) << "without a reason";
  ui_.type("paper");
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(ui_).unblind);
  EXPECT_EQ(state_.reason, "paper");
}

TEST_F(ResultsViewTest, AProblemThatIsNoBlindingHasNothingToUnblind) {
  model_.results = nullptr;
  model_.problem = "expected sessions with participants, found none to analyse";
  (void)draw(ui_);
  EXPECT_TRUE(ui_.drawn().shows(model_.problem));
  EXPECT_EQ(ui_.drawn().find("unblind"), nullptr);
}

TEST_F(ResultsViewTest, SimulatedDataAreMarkedOnEveryPageOfEveryWindow) {
  ResultsModel simulated = results();
  simulated.simulated = true;
  model_.results = &simulated;
  HeadlessUi small(1280, 720);
  for (std::size_t page = 0; page < pages_of(simulated).size(); ++page) {
    state_.page = page;
    (void)draw(small);
    EXPECT_TRUE(small.drawn().shows("simulated data")) << page;
    EXPECT_TRUE(all_on_screen(small.drawn(), 1280, 720)) << page;
    for (const ResultsPageLook& look : pages_of(simulated)) {
      ASSERT_NE(small.drawn().find(look.name), nullptr);
      EXPECT_GT(small.drawn().find(look.name)->place.width, 60) << look.name;
    }
  }
}

TEST_F(ResultsViewTest, APlotHoldsTheChartsPointsCurveBandAndLines) {
  const analysis::Chart& everybody = *comparison().everybody;
  const PlotModel plot = chart_plot(comparison(), everybody);
  EXPECT_EQ(plot.y.maximum, 100.0);
  EXPECT_EQ(plot.series.back().name, "each participant, fitted");
  const PlotSeries& points = plot.series[plot.series.size() - 2];
  ASSERT_EQ(points.x.size(), 2U);
  // Four people had 7, 8, 9 and 10 of ten answers right at 12.
  EXPECT_DOUBLE_EQ(points.y[1], 85.0);
  EXPECT_EQ(points.names[1], "34 of 40");
  ASSERT_EQ(plot.marks.size(), everybody.lines.size());
  EXPECT_DOUBLE_EQ(plot.marks[1].at, everybody.lines[1].at);
  EXPECT_NEAR(plot.marks[1].until.value(), 84.13, 0.01);
  const auto band =
      std::ranges::find(plot.series, PlotSeries::Style::kBand, &PlotSeries::style);
  ASSERT_NE(band, plot.series.end());
  EXPECT_EQ(band->low.size(), band->x.size());
  EXPECT_LE(band->high.back(), 100.0);
  EXPECT_GT(band->high.back(), 50.0);
}

TEST_F(ResultsViewTest, SpreadOfWhatWasSetLiesAlongX) {
  const analysis::ChartSet& production = results().charts[1];
  const PlotModel plot = chart_plot(production, *production.everybody);
  const PlotSeries& points = plot.series.back();
  EXPECT_TRUE(points.low.empty());
  const PlotSeries& spread = plot.series[plot.series.size() - 2];
  EXPECT_EQ(spread.style, PlotSeries::Style::kLine);
  ASSERT_EQ(spread.y.size(), 6U) << "two ends and a gap for each of two means";
  EXPECT_EQ(spread.y[0], spread.y[1]);
  EXPECT_LT(spread.x[3], spread.x[4]);
}

TEST_F(ResultsViewTest, ABoxIsDrawnUnderItsLabel) {
  const PlotModel boxes = box_plot(results().boxes.front());
  EXPECT_EQ(boxes.boxes.size(), results().boxes.front().boxes.size());
  EXPECT_EQ(boxes.x.ticks.front().label, results().boxes.front().boxes.front().label);
}

}  // namespace results_view_test
}  // namespace jnd::app::gui
