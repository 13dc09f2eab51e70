#include "app/gui/views/overview_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/study_fixtures.h"

namespace jnd::app::gui {
namespace overview_view_test {

StudyOverview some_overview() {
  StudyOverview overview{.num_done = 5, .num_planned = 12, .next_participant = "P07"};
  overview.balance = {
      {.lines = {{"low, then high", 3, 0, false}, {"high, then low", 2, 1, true}}}};
  overview.next_cells = {{"", "high, then low"}};
  overview.quality = {{.session = 1, .participant = "P01", .num_ticks = 200'000},
                      {.session = 2,
                       .participant = "P02",
                       .num_ticks = 200'000,
                       .num_missed_ticks = 400,
                       .num_faults = 1,
                       .num_repeated = 3,
                       .num_unlikely = 2,
                       .num_unstroked = 4},
                      {.session = 3, .participant = "P03", .problem = "a damaged log"}};
  overview.backup = {.is_known = true,
                     .when = "3 days ago",
                     .folder = "/copies/honey",
                     .num_newer_sessions = 2,
                     .hint = "2 sessions are newer than the copy. Bring it up to date."};
  overview.schedule = {{4, "P07", "today at 14:30", ScheduleLine::State::kComing},
                       {5, "P08", "tomorrow at 10:00", ScheduleLine::State::kComing},
                       {2, "P05", "yesterday at 10:00", ScheduleLine::State::kCame}};
  overview.free_pseudonym = "P09";
  return overview;
}

class OverviewViewTest : public ::testing::Test {
 protected:
  OverviewResult draw(HeadlessUi& ui) {
    OverviewResult all;
    ui.frame([&](Ui& now) {
      const OverviewResult result =
          draw_overview(now,
                        {.study = study_,
                         .overview = overview_ ? &*overview_ : nullptr,
                         .progress = 0.4,
                         .problem = problem_,
                         .work = work_,
                         .proposed_date = "2026-12-01"},
                        state_);
      if (result.tab != StudyTab::kNone) all.tab = result.tab;
      if (result.prepare) all.prepare = result.prepare;
      if (result.session) all.session = result.session;
      all.plan |= result.plan;
      all.add_appointment |= result.add_appointment;
      if (result.cancel_appointment) all.cancel_appointment = result.cancel_appointment;
      all.back_up |= result.back_up;
    });
    return all;
  }
  OverviewResult after_key(const Chord& key) {
    (void)draw(ui_);
    ui_.press(key);
    return draw(ui_);
  }
  [[nodiscard]] bool shows(const char* words) const { return ui_.drawn().shows(words); }

  StudyFolder study_ = some_study();
  std::optional<StudyOverview> overview_ = some_overview();
  std::string problem_;
  StudyWork work_;
  OverviewState state_;
  HeadlessUi ui_;
};

TEST_F(OverviewViewTest, TellsWhereTheStudyStands) {
  (void)draw(ui_);
  for (const char* words : {"5 of 12", "P07", "gets high, then low", "3 days ago",
                            "2 sessions are newer", "low, then high", "2, 1 open", "next",
                            "0.20 %", "a damaged log", "today at 14:30", "comes", "came"}) {
    EXPECT_TRUE(shows(words)) << words << "\n" << all_texts(ui_.drawn());
  }
}

TEST_F(OverviewViewTest, TheNextParticipantIsPreparedWithN) {
  EXPECT_EQ(after_key({letter('N')}).prepare, "P07");
}

TEST_F(OverviewViewTest, ArrowsGoThroughTheListThatWasChosen) {
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDown});
  EXPECT_EQ(state_.session, 1U);
  EXPECT_EQ(after_key({Key::kEnter}).session, 2);
  (void)after_key({Key::kRight});
  (void)after_key({Key::kDown});
  EXPECT_EQ(state_.appointment, 0U);
  EXPECT_EQ(state_.session, 1U);
  (void)after_key({Key::kLeft});
  (void)after_key({Key::kUp});
  EXPECT_EQ(state_.session, 0U);
  ui_.click("session_3");
  (void)draw(ui_);
  ui_.click("session_3");
  EXPECT_EQ(draw(ui_).session, 3);
}

TEST_F(OverviewViewTest, HowManyArePlannedIsWrittenDown) {
  (void)after_key({letter('P')});
  EXPECT_EQ(state_.number, "12");
  ui_.press({letter('A'), true});
  ui_.type("24");
  (void)draw(ui_);
  EXPECT_TRUE(after_key({Key::kEnter}).plan);
  EXPECT_EQ(state_.number, "24");
  overview_->planned_by = "preregistered";
  (void)draw(ui_);
  EXPECT_FALSE(ui_.drawn().find("plan_number")->enabled);
  EXPECT_TRUE(shows("done, preregistered"));
  overview_->num_planned.reset();
  overview_->planned_by.clear();
  (void)draw(ui_);
  EXPECT_TRUE(shows("nobody has said how many are planned"));
}

TEST_F(OverviewViewTest, AnAppointmentIsAPseudonymADayAndATime) {
  (void)after_key({letter('A')});
  EXPECT_TRUE(shows("A pseudonym alone"));
  EXPECT_EQ(state_.participant, "P09");
  EXPECT_EQ(state_.date, "2026-12-01");
  EXPECT_TRUE(after_key({Key::kEnter}).add_appointment);
  // The dialog shows what was wrong, and what the person typed.
  state_.dialog = OverviewState::Dialog::kAppointment;
  state_.problem = "expected a day as 2026-12-01";
  (void)draw(ui_);
  EXPECT_TRUE(shows("expected a day as 2026-12-01"));
}

TEST_F(OverviewViewTest, AnAppointmentIsCancelledOnceItWasAskedAbout) {
  EXPECT_FALSE(after_key({Key::kDelete}).cancel_appointment.has_value()) << "none is chosen";
  (void)after_key({Key::kRight});
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDown});
  (void)after_key({Key::kDelete});
  EXPECT_TRUE(shows("P08, tomorrow at 10:00"));
  EXPECT_EQ(after_key({Key::kEnter}).cancel_appointment, 5);
}

TEST_F(OverviewViewTest, ABackupAsksWhereToFirst) {
  state_.backup_folder = "/copies/honey";
  EXPECT_FALSE(after_key({letter('B')}).back_up);
  EXPECT_TRUE(after_key({Key::kEnter}).back_up);
}

TEST_F(OverviewViewTest, OfADoubleBlindStudyNothingTellsAnOrder) {
  study_.blinding = experiments::Blinding::kDouble;
  study_.hides_levels = true;
  overview_->hides_levels = true;
  overview_->balance.clear();  // The model has no plan of balance.
  overview_->next_cells.clear();
  (void)draw(ui_);
  EXPECT_FALSE(shows("low"));
  EXPECT_FALSE(shows("high"));
  EXPECT_FALSE(shows("No stroke"));
  EXPECT_TRUE(shows("the order is assigned, and hidden"));
  EXPECT_TRUE(shows("who has which order is hidden"));
}

TEST_F(OverviewViewTest, WithoutAnythingItSaysWhatToDo) {
  overview_ = StudyOverview{.next_participant = "P01", .next_cells = {{"", ""}}};
  (void)draw(ui_);
  EXPECT_TRUE(shows("No session yet."));
  EXPECT_TRUE(shows("Nobody is written down."));
  EXPECT_TRUE(shows("there is nothing to balance"));
  EXPECT_TRUE(shows("gets the same order for everyone"));
  overview_.reset();
  (void)draw(ui_);
  EXPECT_TRUE(shows("Looking through the sessions"));
  problem_ = "a damaged study";
  (void)draw(ui_);
  EXPECT_TRUE(shows("a damaged study"));
}

TEST_F(OverviewViewTest, InABackupNothingIsWritten) {
  overview_->is_backup = true;
  (void)draw(ui_);
  for (const char* name : {"prepare", "plan_number", "back_up", "add_appointment"}) {
    EXPECT_FALSE(ui_.drawn().find(name)->enabled) << name;
  }
}

TEST_F(OverviewViewTest, NothingIsCutOffInASmallWindow) {
  HeadlessUi small(1280, 720);
  (void)draw(small);
  EXPECT_TRUE(all_on_screen(small.drawn(), 1280, 720));
  for (const char* name : {"prepare", "plan_number", "back_up", "add_appointment"}) {
    EXPECT_GT(small.drawn().find(name)->place.height, 30) << name;
  }
}

}  // namespace overview_view_test
}  // namespace jnd::app::gui
