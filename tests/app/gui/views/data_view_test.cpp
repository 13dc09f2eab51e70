#include "app/gui/views/data_view.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <string>

#include "app/gui/headless_ui.h"
#include "app/gui/views/data_parts.h"
#include "app/gui/views/study_fixtures.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app::gui {
namespace data_view_test {

namespace fs = std::filesystem;

constexpr char kOrder[] =
    "condition,delay_ms,num_first,num_asked\nlight,-90,2,40\nlight,-60,5,40\nlight,-30,12,40\n"
    "light,0,20,40\nlight,30,30,40\nlight,60,36,40\nlight,90,38,40\nsound,-90,1,40\n"
    "sound,-60,2,40\nsound,-30,5,40\nsound,0,12,40\nsound,30,22,40\nsound,60,32,40\n"
    "sound,90,37,40\n";

/// Draws the view of the real model, and does at once what the view requests.
class DataViewTest : public ::testing::Test {
 protected:
  void open(const std::string& text) {
    file_ = test_support::write_file(folder_.path() / "order.csv", text);
    data_.open(file_);
    data_.wait();
    draw();
  }
  void draw() { draw_on(ui_); }
  void draw_on(HeadlessUi& ui) {
    ui.frame([this](Ui& now) {
      const DataViewResult result = draw_data_view(
          now, data_.view(), [this](const fs::path&) { return entries_; }, state_);
      if (result.tab != StudyTab::kNone) tab_ = result.tab;
      if (result.open) opened_ = *result.open;
      if (result.save_picture) picture_ = *result.save_picture;
      if (result.save_table) table_ = *result.save_table;
      if (result.compare) data_.compare();
      if (result.request) data_.ask(*result.request);
      data_.wait();
    });
  }
  void after(const Chord& key) {
    ui_.press(key);
    draw();
  }
  void after_click(const char* widget) {
    ui_.click(widget);
    draw();
  }
  [[nodiscard]] const CurveRequest& request() const { return data_.view().request; }

  test_support::TemporaryFolder folder_;
  fs::path file_;
  OpenData data_;
  DataViewState state_;
  std::vector<FolderEntry> entries_ = {{"/data/a.csv", FolderEntry::Kind::kTable}};
  StudyTab tab_ = StudyTab::kNone;
  fs::path opened_, picture_, table_;
  HeadlessUi ui_;
};

TEST_F(DataViewTest, WithoutAFileItSaysWhatToDo) {
  draw();
  EXPECT_TRUE(ui_.drawn().shows("Open a table of answers"));
  EXPECT_TRUE(ui_.drawn().shows("never changed"));
  after({Key::kEnter});
  EXPECT_NE(ui_.drawn().find("open_path"), nullptr);
  after({.key = letter('1'), .control = true});
  EXPECT_EQ(opened_, "/data/a.csv");
  EXPECT_EQ(state_.dialog, DataViewState::Dialog::kNone);
  after({.key = letter('0'), .control = true});
  EXPECT_EQ(tab_, StudyTab::kStart);
}

TEST_F(DataViewTest, AFileThatIsNoTableSaysWhy) {
  open("a,b\n1,2,3\n");
  EXPECT_TRUE(ui_.drawn().shows("This file cannot be read"));
  EXPECT_TRUE(ui_.drawn().shows("expected 2 cells, found 3"));
  EXPECT_NE(ui_.drawn().find("open_file"), nullptr);
}

TEST_F(DataViewTest, ShowsTheFirstRowsWithWhatItsColumnsAre) {
  open(kOrder);
  for (const char* words : {"order.csv", "delay_ms", "intensity", "num_first", "answers",
                            "num_asked", "trials", "condition", "-90", "14 rows"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
  EXPECT_NE(ui_.drawn().find("column_4"), nullptr);
}

TEST_F(DataViewTest, AClickOnAHeadSaysWhatTheColumnIs) {
  open(kOrder);
  after_click("column_1");
  EXPECT_TRUE(ui_.drawn().shows("What is “condition”?"));
  after({letter('6')});
  EXPECT_TRUE(request().group_by.empty());
  EXPECT_EQ(state_.dialog, DataViewState::Dialog::kNone);
  after_click("column_4");
  after_click("choice_1");
  EXPECT_EQ(request().intensity, "num_asked");
  EXPECT_EQ(request().trials, "");
}

TEST_F(DataViewTest, EveryColumnIsChosenByKeysAlone) {
  open(kOrder);
  after({letter('I')});
  EXPECT_TRUE(ui_.drawn().shows("Which column has the intensities?"));
  after({letter('4')});
  EXPECT_EQ(request().intensity, "num_asked");
  after({letter('I')});
  after({letter('2')});
  after({letter('Y')});
  after({letter('3')});
  after({letter('N')});
  EXPECT_TRUE(ui_.drawn().shows("Each row is one trial"));
  after({letter('5')});
  EXPECT_EQ(request().intensity, "delay_ms");
  EXPECT_EQ(request().yes, "num_first");
  EXPECT_EQ(request().trials, "num_asked");
  // The person chooses one column of groups after the other, until F2.
  after({letter('G')});
  after({letter('1')});
  EXPECT_TRUE(request().group_by.empty());
  EXPECT_EQ(state_.dialog, DataViewState::Dialog::kGroups);
  after({letter('1')});
  EXPECT_EQ(request().group_by, std::vector<std::string>{"condition"});
  after({Key::kF2});
  EXPECT_EQ(state_.dialog, DataViewState::Dialog::kNone);
}

TEST_F(DataViewTest, RowsAreFilteredByACellAndTheFilterIsTakenAway) {
  open(kOrder);
  after({letter('W')});
  after({letter('1')});
  EXPECT_TRUE(ui_.drawn().shows("Rows in which “condition” is …"));
  after({letter('2')});
  EXPECT_EQ(request().where, std::vector<std::string>{"condition=sound"});
  EXPECT_TRUE(ui_.drawn().shows("condition = sound"));
  after({letter('W')});
  after({letter('1')});
  EXPECT_TRUE(request().where.empty());
}

TEST_F(DataViewTest, TheCurveIsChosenAndRatesAndLevelsAreTyped) {
  open(kOrder);
  after({letter('F')});
  after({letter('2')});
  EXPECT_EQ(request().family, "logistic");
  after({letter('X')});
  EXPECT_EQ(request().axis, "log");
  after({letter('X')});
  after({letter('L')});
  ui_.type("2");
  after({Key::kEnter});
  EXPECT_TRUE(ui_.drawn().shows("expected a rate from 0 to below 1"));
  EXPECT_EQ(request().lapse, "0");
  after({.key = letter('5'), .control = true});
  EXPECT_EQ(request().lapse, "free");
  after({letter('A')});
  ui_.press({.key = letter('A'), .control = true});
  ui_.type("0.5, 0.75");
  after({Key::kEnter});
  EXPECT_EQ(request().at, (std::vector{0.5, 0.75}));
  after({letter('T')});
  after({.key = letter('2'), .control = true});
  EXPECT_EQ(request().task, "mafc:2");
  EXPECT_TRUE(ui_.drawn().shows("right ones among 2"));
}

TEST_F(DataViewTest, IntervalsAndGoodnessOfFitAreChosenByKeys) {
  open(kOrder);
  after({letter('2')});
  EXPECT_TRUE(ui_.drawn().shows("Fits, with 95 % by the likelihood ratio"));
  after({letter('B')});
  EXPECT_TRUE(ui_.drawn().shows("Which 95 % intervals?"));
  after({letter('2')});
  EXPECT_EQ(request().num_bootstrap, 1000);
  EXPECT_TRUE(ui_.drawn().shows("Fits, with 95 % by the bootstrap"));
  EXPECT_TRUE(ui_.drawn().shows("Bootstrap from the curve"));
  after({letter('B')});
  after({letter('4')});
  EXPECT_EQ(request().num_bootstrap, 0);
  EXPECT_TRUE(request().posterior);
  EXPECT_TRUE(ui_.drawn().shows("Fits, with 95 % of the posterior"));
  after({letter('D')});
  after({letter('2')});
  EXPECT_EQ(request().num_goodness, 1000);
  EXPECT_TRUE(ui_.drawn().shows("goodness of fit, p"));
}

TEST_F(DataViewTest, TheCurvesStandWithTheirTableAndEveryNumber) {
  open(kOrder);
  after({letter('2')});
  const std::string pse = data_.view().results->groups[1].pse.value;
  for (const char* words : {"condition light", "condition sound", "PSE", "JND", "location",
                            "scale", "deviance", "log-likelihood", "rising curve"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
  EXPECT_TRUE(ui_.drawn().shows(pse));
  EXPECT_EQ(state_.group, 0U);
  after({Key::kDown});
  EXPECT_EQ(state_.group, 1U);
  after_click("group_1");
  EXPECT_EQ(state_.group, 0U);
}

TEST_F(DataViewTest, TwoCurvesAreComparedOnAPageOfTheirOwn) {
  open(kOrder);
  after({letter('3')});
  for (const char* words : {"The location differs", "condition sound less condition light",
                            "different location, same scale", "p (Holm)"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
  after({letter('G')});
  after({letter('1')});
  after({Key::kF2});
  EXPECT_EQ(ui_.drawn().find("page_comparison"), nullptr);
  EXPECT_EQ(state_.page, DataViewState::Page::kCurves);
}

TEST_F(DataViewTest, TheCommandIsCopied) {
  open(kOrder);
  after({letter('4')});
  EXPECT_TRUE(ui_.drawn().shows("jnd fit psychometric --csv "));
  after({.key = letter('C'), .control = true});
  EXPECT_STREQ(ImGui::GetClipboardText(), data_.view().command.c_str());
  EXPECT_TRUE(ui_.drawn().shows("The command is on the clipboard."));
}

TEST_F(DataViewTest, WhatIsSavedHasAFormatAndANameThatIsFree) {
  open(kOrder);
  after({.key = letter('S'), .control = true});
  EXPECT_EQ(state_.typed, (folder_.path() / "order-curves.svg").string());
  after({.key = letter('2'), .control = true});
  EXPECT_EQ(state_.typed, (folder_.path() / "order-curves.pdf").string());
  after({Key::kEnter});
  EXPECT_EQ(picture_, folder_.path() / "order-curves.pdf");
  EXPECT_EQ(state_.dialog, DataViewState::Dialog::kNone);
  after({.key = letter('E'), .control = true});
  after({Key::kEnter});
  EXPECT_EQ(table_, folder_.path() / "order-curves.csv");
}

TEST_F(DataViewTest, WhatTheTaskWasIsAskedWhereItMatters) {
  open("intensity,num_yes,num_trials\n1,52,100\n2,58,100\n3,75,100\n4,92,100\n5,99,100\n");
  after({letter('2')});
  EXPECT_TRUE(ui_.drawn().shows("What were the answers?"));
  EXPECT_EQ(ui_.drawn().find("save_picture"), nullptr);
  after_click("task_right");
  EXPECT_EQ(request().task, "mafc:2");
  EXPECT_TRUE(ui_.drawn().shows("chance"));
  EXPECT_NE(ui_.drawn().find("save_picture"), nullptr);
}

TEST_F(DataViewTest, WithoutAColumnOfAnswersItAsksForOne) {
  open("name,city\nAda,London\nEmmy,Erlangen\n");
  after({letter('2')});
  EXPECT_TRUE(ui_.drawn().shows("Choose the column of the intensities"));
  EXPECT_TRUE(ui_.drawn().shows("choose a column"));
  EXPECT_EQ(ui_.drawn().find("page_command"), nullptr);
}

TEST_F(DataViewTest, ManyColumnsAreGoneThrough) {
  std::string header = "x,k", row = "1,1", other = "2,0";
  for (int i = 0; i < 40; ++i) {
    header += ",a_long_name_" + std::to_string(i);
    row += ",0.25";
    other += ",0.5";
  }
  open(header + "\n" + row + "\n" + other + "\n");
  EXPECT_EQ(ui_.drawn().find("column_42"), nullptr);
  for (int i = 0; i < 20; ++i) after({Key::kRight});
  EXPECT_NE(ui_.drawn().find("column_42"), nullptr);
  EXPECT_EQ(ui_.drawn().find("column_1"), nullptr);
  for (int i = 0; i < 20; ++i) after({Key::kLeft});
  EXPECT_NE(ui_.drawn().find("column_1"), nullptr);
}

TEST_F(DataViewTest, NothingIsCutOffInASmallWindow) {
  open(kOrder);
  HeadlessUi small(1280, 720);
  for (const auto page : {DataViewState::Page::kTable, DataViewState::Page::kCurves,
                          DataViewState::Page::kComparison, DataViewState::Page::kCommand}) {
    state_.page = page;
    draw_on(small);
    draw_on(small);
    EXPECT_TRUE(all_on_screen(small.drawn(), 1280, 720));
    for (const char* name : {"set_intensity", "set_goodness", "save_picture", "save_table",
                             "page_table", "page_command", "open_another", "tab_start"}) {
      const Drawn::Widget* widget = small.drawn().find(name);
      ASSERT_NE(widget, nullptr) << name;
      EXPECT_GT(widget->place.height, 30) << name;
      EXPECT_GT(widget->place.width, 80) << name;
    }
  }
}

TEST(DataPlot, SixCurvesHaveAColourEachAndOfMoreOneStandsOut) {
  const auto results_of = [](std::size_t count) {
    DataResults results{.groups = std::vector<DataGroup>(count)};
    results.tables = {
        {.name = "answers",
         .columns = {"series", "intensity", "proportion", "low", "high", "trials"}},
        {.name = "curves", .columns = {"series", "intensity", "proportion"}},
        {.name = "thresholds",
         .columns = {"series", "at", "intensity", "proportion", "low", "high"}}};
    for (std::size_t i = 0; i < count; ++i) {
      const auto series = static_cast<int>(i + 1);
      results.tables[0].rows.push_back({series, 1.0, 0.3, 0.18, 0.45, 40});
      results.tables[1].rows.push_back({series, 0.0, 0.1});
      results.tables[1].rows.push_back({series, 10.0, 0.9});
      results.tables[2].rows.push_back({series, 0.5, 5.0, 0.5, 4.0, 6.0});
    }
    return results;
  };
  const PlotModel two = data_plot(results_of(2), 0);
  ASSERT_EQ(two.series.size(), 6U);
  EXPECT_NE(two.series[0].colour, two.series[3].colour);
  EXPECT_EQ(two.series[2].names[0], "12 of 40");
  EXPECT_DOUBLE_EQ(two.series[2].y[0], 30.0);
  EXPECT_DOUBLE_EQ(two.series[1].x[3], 4.0);
  EXPECT_DOUBLE_EQ(two.series[1].x[4], 6.0);
  EXPECT_EQ(two.x.minimum, 0.0);
  EXPECT_EQ(two.x.maximum, 10.0);
  const PlotModel seven = data_plot(results_of(7), 3);
  EXPECT_EQ(seven.series.size(), 6U + 3U);
}

}  // namespace data_view_test
}  // namespace jnd::app::gui
