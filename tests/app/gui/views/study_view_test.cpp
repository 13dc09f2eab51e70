#include "app/gui/views/study_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/study_fixtures.h"
#include "app/tiny_study.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app::gui {
namespace study_view_test {

class StudyViewTest : public ::testing::Test {
 protected:
  StudyViewResult draw(const StudyViewModel& model) {
    StudyViewResult all;
    ui_.frame([&](Ui& now) {
      const StudyViewResult result = draw_study_view(now, model, state_);
      if (result.tab != StudyTab::kNone) all.tab = result.tab;
      all.orders_changed |= result.orders_changed;
      all.edit |= result.edit;
      all.begin |= result.begin;
    });
    return all;
  }
  StudyViewResult after_key(const StudyViewModel& model, const Chord& key) {
    (void)draw(model);
    ui_.press(key);
    return draw(model);
  }

  StudyFolder study_ = some_study();
  experiments::Study tiny_ = experiments::read_study_text(kTinyStudy, "tiny.json");
  StudyOutline outline_ = outline_of(tiny_);
  std::vector<PlannedOrder> orders_ = planned_orders(tiny_, {.num_participants = 2});
  StudyViewState state_{.num_participants = 2};
  HeadlessUi ui_;
};

TEST_F(StudyViewTest, ShowsStagesStimuliAndOrders) {
  (void)draw({.study = &study_, .outline = outline_, .orders = orders_});
  for (const char* words : {"Estimation", "Magnitude estimation · 2 stimuli, 2 times: 4 trials",
                            "water, scale 0.5, 2", "line 14", "P02", "Comparison: "}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
}

TEST_F(StudyViewTest, EveryProblemStandsAtItsPlace) {
  const StudyOutline wrong{
      .file = "/data/wrong.json",
      .problems = {{"wrong.json", 15, 35, "/stages/3/scale/0", "expected a number, found -1"},
                   {"wrong.json", 0, 0, "", "expected a file, found none"}}};
  (void)draw({.outline = wrong, .orders = {}});
  for (const char* words : {"2 problems in the file", "line 15, column 35", "/stages/3/scale/0",
                            "expected a number, found -1", "the file as a whole",
                            "expected a file", "wrong.json"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
  EXPECT_EQ(ui_.drawn().find("more_participants"), nullptr);
}

TEST_F(StudyViewTest, AProblemStandsInTheTextAroundItAndArrowsGoOn) {
  StudyOutline wrong{.file = "/data/wrong.json"};
  std::vector<std::string> lines;
  for (int i = 1; i <= 60; ++i) lines.push_back("  \"line\": " + std::to_string(i) + ",");
  for (int line = 2; line <= 60; line += 4) {
    wrong.problems.push_back({"wrong.json", line, 11, "/line", "expected a word"});
    wrong.excerpts.push_back(excerpt_at(lines, line, 11));
  }
  const StudyViewModel model{.outline = wrong, .orders = {}};
  (void)draw(model);
  EXPECT_TRUE(ui_.drawn().shows("\"line\": 4,")) << "two lines on";
  (void)after_key(model, {Key::kUp});
  EXPECT_EQ(state_.problem, 14U);
  (void)draw(model);
  EXPECT_GT(ui_.drawn().find("problem_15")->place.height, 100);
  EXPECT_TRUE(after_key(model, {letter('E')}).edit);
  EXPECT_FALSE(ui_.drawn().find("begin_study")->enabled) << "not with problems";
}

TEST_F(StudyViewTest, ASoundFileBeginsAStudyInAFolderThatIsProposed) {
  const StudyViewModel model{
      .outline = outline_, .orders = orders_, .proposed_folder = "/data/tiny.study"};
  (void)after_key(model, {letter('N')});
  EXPECT_EQ(state_.new_folder, "/data/tiny.study");
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(model).begin);
  EXPECT_FALSE(state_.asks_for_folder);
}

TEST_F(StudyViewTest, WhatASoundFileMayNotMeanIsTold) {
  outline_.doubts = {{"tiny.json", 14, 5, "/stages/3", "levels are out of order"}};
  (void)draw({.study = &study_, .outline = outline_, .orders = orders_});
  EXPECT_TRUE(ui_.drawn().shows("1 thing to look at once more"));
  EXPECT_TRUE(ui_.drawn().shows("line 14, column 5: levels are out of order"));
  EXPECT_TRUE(ui_.drawn().shows("Estimation")) << "its stages stand below";
}

TEST_F(StudyViewTest, MoreAndFewerParticipantsArePlannedWithinReason) {
  const StudyViewModel model{.study = &study_, .outline = outline_, .orders = orders_};
  EXPECT_TRUE(after_key(model, {Key::kPlus}).orders_changed);
  EXPECT_EQ(state_.num_participants, 3);
  (void)after_key(model, {Key::kMinus});
  (void)after_key(model, {Key::kMinus});
  EXPECT_FALSE(after_key(model, {Key::kMinus}).orders_changed);
  EXPECT_EQ(state_.num_participants, 1);
}

TEST_F(StudyViewTest, AFileAloneHasNoSessionsAndNoResults) {
  const StudyViewModel model{.outline = outline_, .orders = orders_};
  (void)draw(model);
  EXPECT_EQ(ui_.drawn().find("tab_sessions"), nullptr);
  EXPECT_EQ(after_key(model, {.key = letter('0'), .control = true}).tab, StudyTab::kStart);
}

TEST_F(StudyViewTest, SaysWhenTheFileWasReadAgain) {
  (void)draw({.study = &study_,
              .outline = outline_,
              .orders = orders_,
              .num_reloads = 2,
              .since_reload_s = 3.2});
  EXPECT_TRUE(ui_.drawn().shows("Read again 3 s ago"));
}

TEST_F(StudyViewTest, OfADoubleBlindStudyNoLevelAndNoOrderIsDrawn) {
  const experiments::Study blind = experiments::read_study_text(
      replaced(kTinyStudy, R"("languages")", R"("blinding": "double", "languages")"), "t.json");
  const StudyOutline outline = outline_of(blind);
  const std::vector<PlannedOrder> orders = planned_orders(blind, {});
  (void)draw({.outline = outline,
              .orders = orders,
              .orders_problem = "The study is double-blind: its orders are hidden."});
  const std::string texts = all_texts(ui_.drawn());
  for (const char* word : {"0.5", "16", "Pa s", "scale", "Comparison"}) {
    EXPECT_EQ(texts.find(word), std::string::npos) << word << "\n" << texts;
  }
  EXPECT_TRUE(ui_.drawn().shows("its orders are hidden"));
}

}  // namespace study_view_test
}  // namespace jnd::app::gui
