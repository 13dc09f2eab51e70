#include "app/gui/views/start_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/study_fixtures.h"

namespace jnd::app::gui {
namespace start_view_test {

namespace fs = std::filesystem;

class StartViewTest : public ::testing::Test {
 protected:
  StartViewTest() {
    model_.version = "0.1.0";
    model_.shipped = {{.name = "short_tour",
                       .title = "A short tour",
                       .purpose = "Five minutes to try the laboratory by hand.",
                       .length = "about 5 min · 18 trials"},
                      {.name = "viscosity_discrimination",
                       .title = "Discrimination of viscosities",
                       .purpose = "How small a difference in viscosity can be felt.",
                       .length = "about 50 min · 160 trials",
                       .citation = "A. Schmidt, Viscosity Perception, 2018."}};
    const StudyFolder study = some_study();
    model_.studies.push_back({study.folder, study, study.title, study.summary()});
    model_.studies.push_back(
        {"/data/draft.json", std::nullopt, "A draft", "draft · 2 problems in the study file"});
    model_.machine = {{.name = "Disk",
                       .status = PreflightLine::Status::kOk,
                       .found = "80 GB free, about 900 sessions"}};
  }

  /// Draws frames until nothing is left to do. Returns what any of them returned.
  StartViewResult draw(HeadlessUi& ui) {
    StartViewResult all;
    ui.frame([&](Ui& now) {
      const StartViewResult result = draw_start_view(
          now, model_,
          [this](const fs::path& folder) {
            ++num_listings_;
            return folder == "/data" ? entries_ : std::vector<FolderEntry>{};
          },
          state_);
      if (result.resume) all.resume = result.resume;
      if (result.open) all.open = result.open;
      if (result.create) all.create = result.create;
      all.start_tour |= result.start_tour;
      all.data |= result.data;
    });
    return all;
  }
  StartViewResult after_key(const Chord& key) {
    (void)draw(ui_);
    ui_.press(key);
    return draw(ui_);
  }

  StartModel model_;
  StartViewState state_;
  std::vector<FolderEntry> entries_ = {{"/data/honey.study", FolderEntry::Kind::kStudyFolder},
                                       {"/data/more", FolderEntry::Kind::kFolder},
                                       {"/data/x.json", FolderEntry::Kind::kStudyFile}};
  int num_listings_ = 0;
  HeadlessUi ui_;
};

TEST_F(StartViewTest, OffersToResumeFirstAndSaysWhatIsSafe) {
  (void)draw(ui_);
  const Drawn& drawn = ui_.drawn();
  EXPECT_TRUE(drawn.shows("P03 was interrupted in Group D, trial 23 of 40"));
  EXPECT_TRUE(drawn.shows("22 answers and 12 minutes of recording are safe on disk"));
  const StartViewResult result = after_key({Key::kEnter});
  ASSERT_TRUE(result.resume.has_value());
  EXPECT_EQ(result.resume->folder, "/data/honey.study");
  EXPECT_EQ(result.resume->session, 3);
}

TEST_F(StartViewTest, EveryStudyOpensByItsNumberAndByAClick) {
  EXPECT_EQ(after_key({letter('1')}).open, fs::path("/data/honey.study"));
  EXPECT_EQ(after_key({letter('2')}).open, fs::path("/data/draft.json"));
  ui_.click("study_2");
  EXPECT_EQ(draw(ui_).open, fs::path("/data/draft.json"));
  EXPECT_TRUE(ui_.drawn().shows("2 participants done, 1 open"));
}

TEST_F(StartViewTest, TheTourBeginsWithT) { EXPECT_TRUE(after_key({letter('T')}).start_tour); }

TEST_F(StartViewTest, OnesOwnDataOpenWithCAndByAClick) {
  EXPECT_TRUE(after_key({letter('C')}).data);
  ui_.click("open_data");
  EXPECT_TRUE(draw(ui_).data);
}

TEST_F(StartViewTest, WithoutAStudyItSaysWhatToDo) {
  model_.studies.clear();
  model_.machine.clear();
  (void)draw(ui_);
  EXPECT_TRUE(ui_.drawn().shows("No study was opened yet"));
  EXPECT_FALSE(after_key({Key::kEnter}).resume.has_value());
}

TEST_F(StartViewTest, TwoInterruptedSessionsHaveAKeyEachAndMoreAreCounted) {
  for (const std::int64_t session : {4, 5}) {
    InterruptedSession more = model_.studies[0].folder->interrupted[0];
    more.session = session;
    model_.studies[0].folder->interrupted.push_back(more);
  }
  EXPECT_EQ(after_key({.key = Key::kEnter, .control = true}).resume->session, 4);
  EXPECT_TRUE(ui_.drawn().shows("1 more session can be resumed"));
}

TEST_F(StartViewTest, ANewStudyIsOneOfTheShippedInAFolderThatIsProposed) {
  (void)after_key({.key = letter('N'), .control = true});
  EXPECT_NE(state_.new_folder.find("short_tour.study"), std::string::npos) << state_.new_folder;
  ui_.press({.key = letter('2'), .control = true});
  (void)draw(ui_);
  EXPECT_NE(state_.new_folder.find("viscosity_discrimination"), std::string::npos);
  ui_.press(Key::kEnter);
  const StartViewResult result = draw(ui_);
  ASSERT_TRUE(result.create.has_value());
  EXPECT_EQ(result.create->study, "viscosity_discrimination");
  EXPECT_EQ(result.create->folder, state_.new_folder);
  EXPECT_EQ(state_.dialog, StartViewState::Dialog::kNone);
}

TEST_F(StartViewTest, TheCardsOfANewStudySayWhatEachIsForHowLongItTakesAndWhomItFollows) {
  model_.drafts = {{.name = "/my/draft.json",
                    .file = "/my/draft.json",
                    .title = "My draft",
                    .is_draft = true,
                    .num_problems = 2}};
  (void)after_key({.key = letter('N'), .control = true});
  for (const char* words :
       {"My draft", "2 problems in the file", "Discrimination of viscosities",
        "about 50 min · 160 trials", "How small a difference", "A. Schmidt"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
  EXPECT_NE(ui_.drawn().find("draft_1"), nullptr);
  EXPECT_NE(ui_.drawn().find("shipped_short_tour"), nullptr);
}

TEST_F(StartViewTest, ArrowsGoThroughTheCardsThoughAFieldHasTheKeyboard) {
  (void)after_key({.key = letter('N'), .control = true});
  (void)after_key({Key::kDown});
  EXPECT_EQ(state_.chosen_card, 1U);
  (void)after_key({Key::kDown});
  EXPECT_EQ(state_.chosen_card, 1U) << "the last one";
  ui_.press(Key::kEnter);
  EXPECT_EQ(draw(ui_).create->study, "viscosity_discrimination");
}

TEST_F(StartViewTest, BrowsingFindsAStudyFileForTheNewStudy) {
  state_.opening.browsing = "/data";
  (void)after_key({.key = letter('N'), .control = true});
  (void)after_key({.key = letter('B'), .control = true});
  EXPECT_EQ(state_.dialog, StartViewState::Dialog::kBrowse);
  EXPECT_FALSE(ui_.drawn().shows("honey.study")) << "a folder of a study is no study file";
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDown});
  (void)after_key({Key::kEnter});
  EXPECT_EQ(state_.dialog, StartViewState::Dialog::kNew);
  EXPECT_EQ(state_.study_file, "/data/x.json");
  ui_.press(Key::kEnter);
  EXPECT_EQ(draw(ui_).create->study, "/data/x.json");
}

TEST_F(StartViewTest, WhatWasWrongStandsInTheDialogWithWhatWasTyped) {
  state_.opening.browsing = "/data";
  (void)after_key({.key = letter('O'), .control = true});
  ui_.type("/data/nowhere");
  ui_.press(Key::kEnter);
  EXPECT_EQ(draw(ui_).open, fs::path("/data/nowhere"));
  state_.dialog = StartViewState::Dialog::kOpen;
  go_on_with_file_dialog(state_.opening, "found nothing there");
  (void)draw(ui_);
  EXPECT_TRUE(ui_.drawn().shows("found nothing there"));
  EXPECT_EQ(state_.opening.open_path, "/data/nowhere");
  ui_.type("2");
  (void)draw(ui_);
  EXPECT_TRUE(state_.opening.open_path.ends_with("2"));
  EXPECT_FALSE(ui_.drawn().shows("found nothing there")) << "it may be right now";
}

TEST_F(StartViewTest, ArrowsGoThroughTheStudiesAndEnterOpensTheOneTheyCameTo) {
  EXPECT_TRUE(after_key({Key::kEnter}).resume.has_value());
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDown});
  ui_.press(Key::kEnter);
  const StartViewResult result = draw(ui_);
  EXPECT_FALSE(result.resume.has_value());
  EXPECT_EQ(result.open, fs::path("/data/draft.json"));
}

TEST_F(StartViewTest, ArrowsGoThroughAFolderAndEnterOpensTheEntry) {
  state_.opening.browsing = "/data";
  (void)after_key({.key = letter('O'), .control = true});
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDown});
  EXPECT_FALSE(after_key({Key::kEnter}).open.has_value()) << "a folder is gone into";
  EXPECT_EQ(state_.opening.browsing, "/data/more");
  (void)after_key({.key = Key::kUp, .control = true});
  (void)after_key({Key::kDown});
  ui_.press(Key::kEnter);
  EXPECT_EQ(draw(ui_).open, fs::path("/data/honey.study"));
}

TEST_F(StartViewTest, AStudyFileIsTypedAtOnceAndAFolderStaysAsItWasTyped) {
  (void)after_key({.key = letter('N'), .control = true});
  ui_.type("/my/honey.json");
  (void)draw(ui_);
  EXPECT_NE(state_.new_folder.find("honey.study"), std::string::npos) << state_.new_folder;
  state_.new_folder = "/elsewhere/x.study";
  ui_.type("2");
  (void)draw(ui_);
  EXPECT_EQ(state_.new_folder, "/elsewhere/x.study");
  ui_.press(Key::kEnter);
  const StartViewResult result = draw(ui_);
  EXPECT_EQ(result.create->study, "/my/honey.json2");
}

TEST_F(StartViewTest, ADialogIsLeftByF2AndKeepsKeysFromWhatIsBelow) {
  (void)after_key({.key = letter('N'), .control = true});
  ui_.type("t1");
  StartViewResult result = draw(ui_);
  EXPECT_FALSE(result.start_tour);
  EXPECT_FALSE(result.open.has_value());
  EXPECT_EQ(state_.study_file, "t1");
  ui_.press(Key::kF2);
  result = draw(ui_);
  EXPECT_FALSE(result.create.has_value());
  EXPECT_EQ(state_.dialog, StartViewState::Dialog::kNone);
}

TEST_F(StartViewTest, OpeningGoesThroughFoldersThatAreReadOnce) {
  state_.opening.browsing = "/data";
  (void)after_key({.key = letter('O'), .control = true});
  EXPECT_TRUE(ui_.drawn().shows("honey.study"));
  (void)draw(ui_);
  (void)draw(ui_);
  EXPECT_EQ(num_listings_, 1);
  ui_.press({.key = letter('2'), .control = true});
  EXPECT_FALSE(draw(ui_).open.has_value());
  EXPECT_EQ(state_.opening.browsing, "/data/more");
  EXPECT_TRUE(ui_.drawn().shows("There is no study and no folder here"));
  ui_.press({.key = Key::kUp, .control = true});
  (void)draw(ui_);
  EXPECT_EQ(state_.opening.browsing, "/data");
  ui_.click("entry_x.json");
  EXPECT_EQ(draw(ui_).open, fs::path("/data/x.json"));
}

TEST_F(StartViewTest, APathThatIsTypedOpensWithEnter) {
  (void)after_key({.key = letter('O'), .control = true});
  ui_.type("/data/y.study");
  ui_.press(Key::kEnter);
  EXPECT_EQ(draw(ui_).open, fs::path("/data/y.study"));
}

TEST_F(StartViewTest, NothingIsCutOffInASmallWindow) {
  HeadlessUi small(1280, 720);
  (void)draw(small);
  EXPECT_TRUE(all_on_screen(small.drawn(), 1280, 720));
  for (const char* name : {"resume_1", "new_study", "open_study", "start_tour", "open_data"}) {
    const Drawn::Widget* widget = small.drawn().find(name);
    ASSERT_NE(widget, nullptr) << name;
    EXPECT_GT(widget->place.height, 30) << name;
  }
}

}  // namespace start_view_test
}  // namespace jnd::app::gui
