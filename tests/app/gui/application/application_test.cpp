#include "app/gui/application/application.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "app/environment.h"
#include "app/gui/headless_ui.h"
#include "app/gui/views/study_tabs.h"
#include "app/tiny_study.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app::gui {
namespace application_test {

namespace fs = std::filesystem;

/// The window without its pixels, on a study without sessions.
class ApplicationTest : public ::testing::Test {
 protected:
  ApplicationTest() {
    write_file(file_, kTinyStudy);
    create_study_folder(file_, folder_);
  }
  void open(WindowRequest request) {
    application_ = std::make_unique<Application>(std::move(request), [] {});
    draw();
  }
  void draw() {
    ui_.frame([this](Ui& ui) {
      ui.set_view(application_->view_name());
      application_->draw(ui);
    });
  }
  std::string after(const Chord& key) {
    ui_.press(key);
    draw();
    return application_->view_name();
  }

  test_support::TemporaryFolder temporary_;
  EnvironmentVariable state_{"XDG_STATE_HOME", temporary_.path().c_str()};
  fs::path file_ = temporary_.path() / "tiny.json";
  fs::path folder_ = temporary_.path() / "tiny.study";
  HeadlessUi ui_;
  std::unique_ptr<Application> application_;
};

TEST_F(ApplicationTest, EveryTabOfAStudyOpensItsScreen) {
  open({.study_folder = folder_});
  EXPECT_STREQ(application_->view_name(), "sessions");
  EXPECT_EQ(after({letter('3'), true}), "study");
  EXPECT_EQ(after({letter('2'), true}), "results");
  EXPECT_EQ(after({letter('1'), true}), "sessions");
  EXPECT_EQ(after({letter('4'), true}), "device");
  EXPECT_EQ(after({letter('0'), true}), "start");
}

TEST_F(ApplicationTest, EveryNameThatTheProgramGoesToIsAScreen) {
  open({.study_folder = folder_});
  std::vector<StudyTab> names = {StudyTab::kStart,   StudyTab::kSessions, StudyTab::kResults,
                                 StudyTab::kStudy,   StudyTab::kDevice,   StudyTab::kData,
                                 StudyTab::kOverview};
  for (const StudyTabLook& tab : study_tabs()) names.push_back(tab.tab);
  for (const StudyTab& name : names) {
    application_->go_to(name);
    EXPECT_EQ(application_->view_name(), name.screen);
  }
}

TEST_F(ApplicationTest, AScreenThatIsNotThereIsToldAndTheOldOneStays) {
  open({.study_folder = folder_});
  application_->go_to({"sesions"});
  draw();
  EXPECT_STREQ(application_->view_name(), "sessions");
  EXPECT_TRUE(ui_.drawn().shows("The view cannot be opened"));
  EXPECT_TRUE(ui_.drawn().shows("sesions"));
}

TEST_F(ApplicationTest, NoScreenIsWhereTheWindowStays) {
  open({.study_folder = folder_});
  application_->go_to(StudyTab::kNone);
  draw();
  EXPECT_FALSE(ui_.drawn().shows("The view cannot be opened"));
}

TEST_F(ApplicationTest, TheDeviceIsThereWithoutAStudy) {
  open({});
  EXPECT_EQ(after({letter('D')}), "device");
  EXPECT_TRUE(ui_.drawn().shows("lumped"));
  application_->escape();
  while (application_->works()) std::this_thread::yield();
  draw();
  EXPECT_TRUE(ui_.drawn().shows("The emergency stop is pressed."));
  application_->ask_to_close();
  EXPECT_TRUE(application_->closed());
}

TEST_F(ApplicationTest, DataAreOpenedFromTheStartAndStayWhileOthersStandThere) {
  const fs::path table = temporary_.path() / "a.csv";
  write_file(table, "x,k,n\n0,10,40\n10,30,40\n");
  open({});
  EXPECT_EQ(after({letter('C')}), "data");
  EXPECT_NE(ui_.drawn().find("open_path"), nullptr);
  ui_.type(table.string());
  EXPECT_EQ(after({Key::kEnter}), "data");
  const auto finish = [this] {
    do {
      std::this_thread::yield();
      draw();
    } while (application_->works());
  };
  finish();
  EXPECT_TRUE(ui_.drawn().shows("2 rows"));
  // A failure to save is reported.
  after({letter('E'), true});
  ui_.press({letter('A'), true});
  ui_.type(table.string());
  after({Key::kEnter});
  finish();
  EXPECT_TRUE(ui_.drawn().shows("It cannot be saved"));
  EXPECT_TRUE(ui_.drawn().shows("there already"));
  after({Key::kEnter});
  EXPECT_EQ(after({letter('0'), true}), "start");
  EXPECT_EQ(after({letter('C')}), "data");
  EXPECT_TRUE(ui_.drawn().shows("a.csv"));
  EXPECT_EQ(ui_.drawn().find("open_path"), nullptr);
}

TEST_F(ApplicationTest, WhatIsDroppedIsATableOrAStudy) {
  const fs::path table = temporary_.path() / "a.json";
  write_file(table, R"([{"x": 1, "correct": true}, {"x": 2, "correct": false}])");
  open({});
  application_->dropped(file_);
  EXPECT_STREQ(application_->view_name(), "study");
  application_->dropped(table);
  EXPECT_STREQ(application_->view_name(), "data");
  application_->dropped(folder_);
  EXPECT_STREQ(application_->view_name(), "sessions");
  fs::remove_all(folder_ / "study.sqlite");
  application_->dropped(folder_);
  draw();
  EXPECT_STREQ(application_->view_name(), "sessions");
  EXPECT_TRUE(ui_.drawn().shows("What was dropped cannot be opened"));
}

TEST_F(ApplicationTest, AStudyFileIsShownWithoutAFolder) {
  open({.study_folder = file_});
  EXPECT_STREQ(application_->view_name(), "study");
  EXPECT_TRUE(ui_.drawn().shows("Tiny"));
  EXPECT_EQ(after({letter('0'), true}), "start");
}

TEST_F(ApplicationTest, APathThatIsWrongStaysInItsFieldWithWhatIsWrong) {
  open({});
  after({letter('O'), true});
  const std::string wrong = (temporary_.path() / "nowhere.study").string();
  ui_.type(wrong);
  EXPECT_EQ(after({Key::kEnter}), "start");
  ASSERT_NE(ui_.drawn().find("open_path"), nullptr);
  EXPECT_EQ(ui_.drawn().find("open_path")->label, wrong);
  EXPECT_TRUE(ui_.drawn().shows("found nothing there"));
  after({Key::kF2});
  after({letter('N'), true});
  ui_.type((temporary_.path() / "nowhere.json").string());
  EXPECT_EQ(after({Key::kEnter}), "start");
  ASSERT_NE(ui_.drawn().find("study_file"), nullptr);
  EXPECT_TRUE(ui_.drawn().shows("expected a study file, found none there"));
}

TEST_F(ApplicationTest, AFaultyDraftOpensWithItsProblemsAndBeginsAStudyOnceItIsMended) {
  const fs::path draft = temporary_.path() / "draft.json";
  write_file(draft, replaced(kTinyStudy, R"("repetitions": 2)", R"("repetitons": 2)"));
  open({});
  after({letter('N'), true});
  ui_.type(draft.string());
  EXPECT_EQ(after({Key::kEnter}), "study");
  EXPECT_TRUE(ui_.drawn().shows("problem"));
  EXPECT_TRUE(ui_.drawn().shows("repetitons"));
  EXPECT_TRUE(ui_.drawn().shows("line 1")) << "where it is";
  write_file(draft, kTinyStudy);
  for (int i = 0; i < 100 && !application_->look_beside(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  draw();
  EXPECT_FALSE(ui_.drawn().shows("repetitons"));
  EnvironmentVariable data("XDG_DATA_HOME", temporary_.path().c_str());
  after({letter('N')});
  after({letter('A'), true});
  ui_.type((temporary_.path() / "begun.study").string());
  EXPECT_EQ(after({Key::kEnter}), "sessions");
  EXPECT_TRUE(fs::exists(temporary_.path() / "begun.study" / "study.sqlite"));
}

TEST_F(ApplicationTest, TheOverviewIsReachedFromTheSessionsAndPreparesWhoComesNext) {
  open({.study_folder = folder_});
  const auto finish = [this] {
    do {
      std::this_thread::yield();
      draw();
    } while (application_->works());
    draw();
  };
  EXPECT_EQ(after({letter('O')}), "overview");
  finish();
  EXPECT_TRUE(ui_.drawn().shows("No session yet"));
  after({letter('A')});
  ui_.press({letter('A'), true});
  ui_.type("P12");
  EXPECT_EQ(after({Key::kEnter}), "overview");
  finish();
  EXPECT_TRUE(ui_.drawn().shows("tomorrow at 10:00"));
  EXPECT_EQ(after({letter('N')}), "prepare");
  EXPECT_EQ(ui_.drawn().find("participant")->label, "P12");
  EXPECT_EQ(after({letter('1'), true}), "sessions");
}

TEST_F(ApplicationTest, ASessionThatIsChosenShowsItself) {
  {
    core::StudyStore store(folder_, core::StudyStore::Mode::kReadWrite);
    store.add_session({.participant = "P01",
                       .protocol_sha256 = store.protocols()[0].sha256,
                       .device = "lumped",
                       .rate_hz = 1000.0});
  }
  open({.study_folder = folder_});
  after({Key::kDown});
  EXPECT_EQ(after({Key::kEnter}), "record");
  do {
    std::this_thread::yield();
    draw();
  } while (application_->works());
  draw();
  EXPECT_TRUE(ui_.drawn().shows("Nothing has happened in this session yet"));
  EXPECT_EQ(after({Key::kBackspace}), "sessions");
}

TEST_F(ApplicationTest, ATabThatCannotBeOpenedLeavesThePreparationAsItWas) {
  open({.study_folder = folder_, .participant = "P01"});
  EXPECT_STREQ(application_->view_name(), "prepare");
  fs::remove(file_);
  EXPECT_EQ(after({letter('3'), true}), "prepare");
  EXPECT_TRUE(ui_.drawn().shows("expected its study file"));
  EXPECT_EQ(after({Key::kEnter}), "prepare");
  EXPECT_NE(ui_.drawn().find("start_session"), nullptr);
}

TEST_F(ApplicationTest, ASessionWhoseFolderIsGoneIsNotResumedAndTheStartStays) {
  open({.study_folder = temporary_.path() / "gone.study", .resume_session = 1});
  EXPECT_STREQ(application_->view_name(), "start");
  EXPECT_TRUE(ui_.drawn().shows("The session cannot be resumed"));
  EXPECT_TRUE(ui_.drawn().shows("gone.study"));
}

TEST_F(ApplicationTest, WhatCannotBeOpenedIsToldAndTheStartStays) {
  fs::create_directory(temporary_.path() / "no.study");
  write_file(temporary_.path() / "no.study" / "study.sqlite", "not a database");
  open({.study_folder = temporary_.path() / "no.study"});
  EXPECT_STREQ(application_->view_name(), "start");
  EXPECT_NE(ui_.drawn().find("message_close"), nullptr);
  EXPECT_FALSE(application_->is_live());
  application_->ask_to_close();
  EXPECT_TRUE(application_->closed());
}

TEST_F(ApplicationTest, FromTheKeysThePageOfTheManualAboutTheViewOpens) {
  // A desktop of the test's own, which records what its xdg-open was given.
  const fs::path opened = temporary_.path() / "opened";
  fs::create_directory(temporary_.path() / "bin");
  const fs::path program = temporary_.path() / "bin" / "xdg-open";
  write_file(program, "#!/bin/sh\nprintf '%s' \"$1\" >'" + opened.string() + ".new'\nmv '" +
                          opened.string() + ".new' '" + opened.string() + "'\n");
  fs::permissions(program, fs::perms::owner_all);
  const std::string path =
      (temporary_.path() / "bin").string() + ":" + std::string(std::getenv("PATH"));
  open({.study_folder = folder_});
  EnvironmentVariable desktop("PATH", path.c_str());
  EnvironmentVariable share("JND_SHARE", (temporary_.path() / "share/jnd").c_str());
  const fs::path pages = temporary_.path() / "share/doc/jnd/docs";
  fs::create_directories(pages / "how-to");

  after({letter('2'), true});
  after({Key::kF1});
  EXPECT_EQ(ui_.drawn().find("keys_manual")->label, "Manual");
  EXPECT_EQ(after({letter('H')}), "results");
  draw();
  EXPECT_TRUE(ui_.drawn().shows("The manual cannot be opened"));
  EXPECT_TRUE(ui_.drawn().shows("docs/how-to/read_the_results.md")) << "where it should be";
  after({Key::kEnter});

  write_file(pages / "how-to/read_the_results.md", "x");
  after({Key::kF1});
  after({letter('H')});
  draw();
  EXPECT_EQ(ui_.drawn().find("keys_manual"), nullptr) << "the dialog is left";
  EXPECT_EQ(ui_.drawn().find("message_close"), nullptr);
  for (int i = 0; i < 1000 && !fs::exists(opened); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(test_support::read_file(opened), (pages / "how-to/read_the_results.md").string());
}

// Another window would take the keyboard, and with it Escape, from the window that stops.
TEST_F(ApplicationTest, WhileASessionIsLiveTheManualsPlaceIsToldAndNothingOpens) {
  open({.study_folder = folder_,
        .participant = "P01",
        .device = "lumped",
        .allow_no_realtime = true});
  for (int i = 0; i < 1000 && !application_->is_live(); ++i) {
    after({Key::kEnter});
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(application_->is_live());
  after({Key::kF1});
  after({letter('H')});
  draw();
  EXPECT_TRUE(ui_.drawn().shows("The manual is not opened now"));
  EXPECT_TRUE(ui_.drawn().shows("run_a_session"));
  application_->end_soon();
}

TEST_F(ApplicationTest, AnotherLanguageIsChosenAtTheStartAndTheWindowBeginsAnew) {
  open({});
  EXPECT_EQ(ui_.drawn().find("language"), nullptr) << "there is no other one";
  application_->offer({{"de", "Deutsch"}, {"en", "English"}, {"fr", "Français"}});
  draw();
  ASSERT_NE(ui_.drawn().find("language"), nullptr);
  EXPECT_EQ(ui_.drawn().find("language")->label, "Français") << "the one after English";
  after({letter('D')});
  EXPECT_EQ(ui_.drawn().find("language"), nullptr) << "what is shown stays in its language";
  after({letter('0'), true});
  EXPECT_FALSE(application_->closed());
  EXPECT_EQ(application_->wanted_language(), "");
  after({letter('L'), true});
  EXPECT_TRUE(application_->closed());
  EXPECT_EQ(application_->wanted_language(), "fr");
}

TEST_F(ApplicationTest, AfterTheLastLanguageComesTheFirst) {
  open({});
  application_->offer({{"de", "Deutsch"}, {"en", "English"}});
  draw();
  EXPECT_EQ(ui_.drawn().find("language")->label, "Deutsch");
}

}  // namespace application_test
}  // namespace jnd::app::gui
