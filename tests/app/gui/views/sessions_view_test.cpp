#include "app/gui/views/sessions_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/study_fixtures.h"

namespace jnd::app::gui {
namespace sessions_view_test {

class SessionsViewTest : public ::testing::Test {
 protected:
  SessionsViewResult draw() {
    SessionsViewResult all;
    ui_.frame([&](Ui& now) {
      const SessionsViewResult result = draw_sessions_view(now, study_, work_, state_);
      if (result.tab != StudyTab::kNone) all.tab = result.tab;
      if (result.resume) all.resume = result.resume;
      if (result.show) all.show = result.show;
      all.new_session |= result.new_session;
      all.verify |= result.verify;
      all.back_up |= result.back_up;
      all.cancel |= result.cancel;
    });
    return all;
  }
  SessionsViewResult after_key(const Chord& key) {
    (void)draw();
    ui_.press(key);
    return draw();
  }

  StudyFolder study_ = some_study();
  StudyWork work_;
  SessionsViewState state_;
  HeadlessUi ui_;
};

TEST_F(SessionsViewTest, ShowsWhoDidWhatAndWhatIsOpen) {
  (void)draw();
  for (const char* words :
       {"P01", "completed", "80 of 80", "22 of 40", "low, then high", "yesterday", "pilot",
        "mouse", "P03 was interrupted in Group D, trial 23 of 40"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
}

TEST_F(SessionsViewTest, EveryActionHasItsKey) {
  EXPECT_TRUE(after_key({letter('N')}).new_session);
  EXPECT_TRUE(after_key({letter('V')}).verify);
  EXPECT_EQ(after_key({letter('R')}).resume, 3);
  EXPECT_EQ(after_key({.key = letter('2'), .control = true}).tab, StudyTab::kResults);
}

TEST_F(SessionsViewTest, InABackupNoSessionBegins) {
  study_.is_backup = true;
  study_.interrupted.clear();
  EXPECT_FALSE(after_key({letter('N')}).new_session);
  EXPECT_EQ(ui_.drawn().find("new_session"), nullptr);
  EXPECT_TRUE(ui_.drawn().shows("backup, read only"));
  EXPECT_TRUE(ui_.drawn().shows("sessions are run in the study"));
  EXPECT_FALSE(ui_.drawn().find("back_up")->enabled);
  EXPECT_TRUE(after_key({letter('V')}).verify);
}

TEST_F(SessionsViewTest, SaysThatNoBackupLiesOnAnotherDisk) {
  study_.backups = {"/data/copy"};
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("1, none on another disk"));
  study_.is_safe_elsewhere = true;
  (void)draw();
  EXPECT_FALSE(ui_.drawn().shows("none on another disk"));
}

TEST_F(SessionsViewTest, WhatIsCompletedCannotBeResumed) {
  (void)draw();
  ui_.click("session_1");
  (void)draw();
  EXPECT_EQ(state_.selected, 1);
  EXPECT_FALSE(after_key({letter('R')}).resume.has_value());
  ui_.click("session_3");
  (void)draw();
  EXPECT_EQ(after_key({letter('R')}).resume, 3);
}

TEST_F(SessionsViewTest, ArrowsGoThroughTheSessionsAndStopAtTheEnds) {
  (void)after_key({Key::kDown});
  EXPECT_EQ(state_.selected, 1);
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDown});
  EXPECT_EQ(state_.selected, 3);
  (void)after_key({Key::kUp});
  EXPECT_EQ(state_.selected, 2);
}

TEST_F(SessionsViewTest, ASessionShowsItselfByEnterAndByASecondClick) {
  EXPECT_FALSE(after_key({Key::kEnter}).show.has_value()) << "none is chosen";
  (void)after_key({Key::kDown});
  EXPECT_EQ(after_key({Key::kEnter}).show, 1);
  ui_.click("session_3");
  EXPECT_FALSE(draw().show.has_value());
  ui_.click("session_3");
  EXPECT_EQ(draw().show, 3);
  ui_.click("session_1");
  EXPECT_FALSE(draw().show.has_value()) << "another one is a first click";
}

TEST_F(SessionsViewTest, TheOverviewIsOneKeyAway) {
  EXPECT_EQ(after_key({letter('O')}).tab, StudyTab::kOverview);
}

TEST_F(SessionsViewTest, ARowThatArrowsHaveComeToIsSeen) {
  const SessionLine line = study_.sessions[0];
  for (std::int64_t session = 4; session <= 60; ++session) {
    study_.sessions.push_back(line);
    study_.sessions.back().session = session;
  }
  (void)after_key({Key::kUp});
  EXPECT_EQ(state_.selected, 60);
  (void)draw();
  EXPECT_GT(ui_.drawn().find("session_60")->place.height, 30);
  EXPECT_EQ(ui_.drawn().find("session_1")->place.height, 0);
}

TEST_F(SessionsViewTest, ABackupAsksWhereToFirst) {
  state_.backup_folder = "/copy/honey";
  EXPECT_FALSE(after_key({letter('B')}).back_up);
  EXPECT_TRUE(ui_.drawn().shows("Back up the study"));
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw().back_up);
  EXPECT_FALSE(state_.asks_for_backup);
  (void)after_key({letter('B')});
  ui_.press(Key::kF2);
  EXPECT_FALSE(draw().back_up);
  EXPECT_FALSE(state_.asks_for_backup);
}

TEST_F(SessionsViewTest, WorkUnderWayShowsItsProgressAndCanBeCancelled) {
  work_ = {.running = "Verifying", .progress = 0.42};
  EXPECT_FALSE(after_key({letter('V')}).verify);
  EXPECT_TRUE(ui_.drawn().shows("Verifying · 42 %"));
  EXPECT_TRUE(after_key({Key::kF2}).cancel);
}

TEST_F(SessionsViewTest, TheLastOutcomeStaysWithItsProblems) {
  work_.outcome = {.ok = false, .sentence = "2 problems", .problems = {"chunk 7 is damaged"}};
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("2 problems"));
  EXPECT_TRUE(ui_.drawn().shows("chunk 7 is damaged"));
}

TEST_F(SessionsViewTest, ADoubleBlindStudyShowsNoOrderWhateverTheModelHolds) {
  study_.blinding = experiments::Blinding::kDouble;
  study_.hides_levels = true;
  (void)draw();
  EXPECT_FALSE(ui_.drawn().shows("low"));
  EXPECT_FALSE(ui_.drawn().shows("Order"));
  EXPECT_TRUE(ui_.drawn().shows("levels hidden"));
}

TEST_F(SessionsViewTest, AnEmptyStudySaysWhatToDo) {
  study_.sessions.clear();
  study_.interrupted.clear();
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("No session yet"));
  EXPECT_FALSE(ui_.drawn().find("verify")->enabled);
}

}  // namespace sessions_view_test
}  // namespace jnd::app::gui
