#include "app/gui/views/record_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/study_fixtures.h"

namespace jnd::app::gui {
namespace record_view_test {

SessionRecord some_record() {
  SessionRecord record{.line = some_study().sessions[0],
                       .is_over = true,
                       .facts = {{"Device", "lumped"}, {"Program", "0.1.0"}},
                       .rate_hz = 1000.0,
                       .duration_s = 1500.0};
  record.stages = {{"Preparation", 0.0, 200.0}, {"Group D", 200.0, 1500.0}};
  record.pauses = {{"a question", 600.0, 660.0}};
  record.interruptions = {{"interrupted for 2 h", 900.0, 900.0}};
  for (int trial = 1; trial <= 40; ++trial) {
    record.answers.push_back({.trial = trial,
                              .block = "Group D",
                              .in_block = trial,
                              .stimulus = "1.65 Pa s, reference 1.85 Pa s",
                              .answer = trial % 2 == 0 ? "yes" : "no",
                              .form = {.kind = experiments::AnswerKind::kYesNo,
                                       .yes_label = "Yes",
                                       .no_label = "No"},
                              .response_time_s = 1.0 + 0.1 * trial,
                              .at_s = 200.0 + 30.0 * trial});
  }
  record.answers[2].history = {"was “yes” before: the wrong key"};
  record.answers[3].excluded = true;
  record.answers[4].hint = "no stroke in the test";
  record.answers[5].attempt = 2;
  record.notes = {{.kind = RecordNote::Kind::kAdverseEvent,
                   .text = "a pinched finger",
                   .when = "today at 10:05",
                   .what = {.adverse_event = 1}},
                  {.text = "long hair under the glove",
                   .when = "today at 10:01",
                   .what = {.session = 1, .sequence = 40},
                   .is_read = true,
                   .at_s = 300.0}};
  record.faults = {{.words = "Somebody pressed the emergency stop.",
                    .where = "Group D, trial 12",
                    .at_s = 560.0,
                    .flight_record = "/data/honey.study/recordings/0001.fault-000560000.csv"},
                   {.words = "The hand was too fast.", .where = "Group D", .at_s = 700.0}};
  return record;
}

class RecordViewTest : public ::testing::Test {
 protected:
  RecordViewResult draw(HeadlessUi& ui) {
    RecordViewResult all;
    ui.frame([&](Ui& now) {
      const RecordViewResult result = draw_record_view(now,
                                                       {.study = study_,
                                                        .record = record_ ? &*record_ : nullptr,
                                                        .problem = problem_,
                                                        .flight = &flight_,
                                                        .work = work_},
                                                       state_);
      if (result.tab != StudyTab::kNone) all.tab = result.tab;
      all.resume |= result.resume;
      if (result.correct) all.correct = result.correct;
      if (result.exclude) all.exclude = result.exclude;
      if (result.note) all.note = result.note;
      if (result.adverse_event) all.adverse_event = result.adverse_event;
      if (result.acknowledge) all.acknowledge = result.acknowledge;
      if (result.open) all.open = result.open;
      all.withdraw |= result.withdraw;
    });
    return all;
  }
  RecordViewResult after_key(const Chord& key) {
    (void)draw(ui_);
    ui_.press(key);
    return draw(ui_);
  }
  [[nodiscard]] bool shows(const char* words) const { return ui_.drawn().shows(words); }

  StudyFolder study_ = some_study();
  std::optional<SessionRecord> record_ = some_record();
  FlightRecord flight_{{-0.2, -0.1, 0.0}, {1.0, 2.0, 5.0}, {0.1, 0.2, 0.9}};
  std::string problem_;
  StudyWork work_;
  RecordViewState state_;
  HeadlessUi ui_;
};

TEST_F(RecordViewTest, TheTimelineTellsWhatHappenedWhen) {
  (void)draw(ui_);
  for (const char* words : {"P01", "session 1", "completed", "Preparation", "Group D",
                            "Paused for 1 min: a question", "Resumed, interrupted for 2 h",
                            "Somebody pressed the emergency stop.", "Note: long hair", "9:20",
                            "80 of 80", "25 min", "low, then high", "0.1.0"}) {
    EXPECT_TRUE(shows(words)) << words << "\n" << all_texts(ui_.drawn());
  }
}

TEST_F(RecordViewTest, EveryPageHasItsKey) {
  (void)after_key({letter('2')});
  EXPECT_EQ(state_.page, RecordPage::kAnswers);
  (void)after_key({letter('3')});
  EXPECT_EQ(state_.page, RecordPage::kNotes);
  (void)after_key({letter('4')});
  EXPECT_EQ(state_.page, RecordPage::kFaults);
  (void)after_key({letter('1')});
  EXPECT_EQ(state_.page, RecordPage::kTimeline);
  EXPECT_EQ(after_key({Key::kBackspace}).tab, StudyTab::kSessions);
  EXPECT_EQ(after_key({letter('2'), true}).tab, StudyTab::kResults);
}

TEST_F(RecordViewTest, AnswersHaveTheirStimulusTimeAndWhatBecameOfThem) {
  (void)after_key({letter('2')});
  for (const char* words :
       {"1.65 Pa s, reference 1.85 Pa s", "Group D · 3", "1.3 s", "set right", "left out",
        "no stroke in the test", "run again, attempt 2"}) {
    EXPECT_TRUE(shows(words)) << words;
  }
  ui_.click("answer_3");
  (void)draw(ui_);
  (void)draw(ui_);
  EXPECT_TRUE(shows("was “yes” before: the wrong key"));
  for (int i = 0; i < 60; ++i) (void)after_key({Key::kDown});
  EXPECT_EQ(state_.answer, 39U);
  EXPECT_GT(ui_.drawn().find("answer_40")->place.height, 30);
}

TEST_F(RecordViewTest, AnAnswerIsSetRightByItsOwnButtonsAndAReason) {
  (void)after_key({letter('2')});
  EXPECT_FALSE(after_key({letter('C')}).correct.has_value()) << "none is chosen";
  (void)after_key({Key::kDown});
  (void)after_key({letter('C')});
  EXPECT_TRUE(shows("Group D, trial 1: the answer was “no”."));
  (void)after_key({letter('Y')});
  ui_.type("the wrong key");
  (void)draw(ui_);
  const RecordViewResult result = after_key({Key::kEnter});
  ASSERT_TRUE(result.correct.has_value());
  EXPECT_EQ(result.correct->trial, 1);
  EXPECT_EQ(result.correct->value, 1.0);
  EXPECT_EQ(result.correct->reason, "the wrong key");
  EXPECT_EQ(ui_.drawn().find("correct_run_again"), nullptr) << "nobody is there to run it";
}

TEST_F(RecordViewTest, ATrialIsLeftOutWithAReasonAndTakenInAgain) {
  (void)after_key({letter('2')});
  (void)after_key({Key::kDown});
  (void)after_key({letter('X')});
  EXPECT_FALSE(after_key({Key::kEnter}).exclude.has_value()) << "a reason is needed";
  ui_.type("a door");
  (void)draw(ui_);
  RecordViewResult result = after_key({Key::kEnter});
  ASSERT_TRUE(result.exclude.has_value());
  EXPECT_EQ(result.exclude->trials, std::vector<std::int64_t>{1});
  EXPECT_EQ(result.exclude->reason, "a door");
  EXPECT_FALSE(result.exclude->include);
  state_.answer = 3;
  (void)after_key({letter('X')});
  EXPECT_TRUE(shows("Take it into results again"));
  ui_.type("all was well");
  (void)draw(ui_);
  EXPECT_TRUE(after_key({Key::kEnter}).exclude->include);
}

TEST_F(RecordViewTest, AWholeSessionIsLeftOutAtOnce) {
  (void)after_key({letter('2')});
  (void)after_key({letter('L')});
  EXPECT_TRUE(shows("All 40 trials of this session."));
  ui_.type("fire alarm");
  (void)draw(ui_);
  EXPECT_EQ(after_key({Key::kEnter}).exclude->trials.size(), 40U);
}

TEST_F(RecordViewTest, NotesAreSearchedReadAndWritten) {
  (void)after_key({letter('3')});
  EXPECT_TRUE(shows("Notes, 1 new"));
  EXPECT_TRUE(shows("adverse event"));
  EXPECT_TRUE(shows("a pinched finger"));
  const RecordViewResult read = after_key({letter('A')});
  ASSERT_TRUE(read.acknowledge.has_value());
  EXPECT_EQ(read.acknowledge->adverse_event, 1);
  (void)after_key({Key::kDown});
  EXPECT_FALSE(after_key({letter('A')}).acknowledge.has_value()) << "it was read already";
  (void)after_key({letter('F'), true});
  ui_.type("HAIR");
  (void)draw(ui_);
  (void)after_key({Key::kEnter});
  EXPECT_FALSE(shows("a pinched finger"));
  EXPECT_TRUE(shows("long hair"));
  state_.searched = "xyz";
  (void)draw(ui_);
  EXPECT_TRUE(shows("No note has “xyz” in it."));
  state_.searched.clear();
  (void)after_key({letter('N')});
  ui_.type("it rained");
  (void)draw(ui_);
  EXPECT_EQ(after_key({Key::kEnter}).note, "it rained");
  (void)after_key({letter('N')});
  ui_.type("pain");
  (void)draw(ui_);
  EXPECT_EQ(after_key({letter('E'), true}).adverse_event, "pain");
}

TEST_F(RecordViewTest, AFaultShowsItsLastSecondAndItsTable) {
  (void)after_key({letter('4')});
  EXPECT_TRUE(shows("Somebody pressed the emergency stop."));
  EXPECT_TRUE(shows("Force on the hand"));
  EXPECT_EQ(after_key({letter('O')}).open, record_->faults[0].flight_record);
  (void)after_key({Key::kDown});
  EXPECT_EQ(state_.fault, 1U);
  (void)draw(ui_);
  EXPECT_TRUE(shows("Nothing was kept of the last second"));
  EXPECT_EQ(ui_.drawn().find("open_flight"), nullptr);
}

TEST_F(RecordViewTest, AWithdrawalWantsThePseudonymOnceMore) {
  (void)after_key({letter('W')});
  EXPECT_TRUE(shows("There is no way back."));
  ui_.type("P02");
  (void)draw(ui_);
  EXPECT_FALSE(after_key({Key::kEnter}).withdraw);
  ui_.press({letter('A'), true});
  ui_.type("P01");
  (void)draw(ui_);
  EXPECT_TRUE(after_key({Key::kEnter}).withdraw);
}

TEST_F(RecordViewTest, AnOpenSessionIsResumedAndSetRightThen) {
  record_->is_over = false;
  record_->line.status = SessionLine::Status::kOpen;
  EXPECT_TRUE(after_key({letter('R')}).resume);
  (void)after_key({letter('2')});
  (void)after_key({Key::kDown});
  EXPECT_FALSE(ui_.drawn().find("correct")->enabled);
  EXPECT_TRUE(shows("Answers of an open session are set right when it is resumed."));
}

TEST_F(RecordViewTest, InABackupNothingIsWritten) {
  record_->is_backup = true;
  (void)after_key({letter('2')});
  state_.answer = 0;
  (void)draw(ui_);
  for (const char* name : {"correct", "exclude", "exclude_all", "write_note", "withdraw"}) {
    EXPECT_FALSE(ui_.drawn().find(name)->enabled) << name;
  }
  EXPECT_TRUE(shows("it can be read, and not changed"));
}

TEST_F(RecordViewTest, OfADoubleBlindStudyNoStimulusAndNoForceIsDrawn) {
  record_->hides_levels = true;
  study_.blinding = experiments::Blinding::kDouble;
  study_.hides_levels = true;
  // This holds for whatever the model contains.
  for (const RecordPage page :
       {RecordPage::kTimeline, RecordPage::kAnswers, RecordPage::kNotes, RecordPage::kFaults}) {
    state_.page = page;
    (void)draw(ui_);
    const std::string texts = all_texts(ui_.drawn());
    for (const char* word : {"Pa s", "low, then high", "Force on the hand"}) {
      EXPECT_EQ(texts.find(word), std::string::npos) << word << "\n" << texts;
    }
  }
}

TEST_F(RecordViewTest, WithoutAnythingItSaysWhatToDo) {
  record_ = SessionRecord{.line = some_study().sessions[2]};
  (void)draw(ui_);
  EXPECT_TRUE(shows("Nothing has happened in this session yet. Resume it to begin."));
  (void)after_key({letter('2')});
  EXPECT_TRUE(shows("No answer yet."));
  (void)after_key({letter('3')});
  EXPECT_TRUE(shows("“Write a note”"));
  (void)after_key({letter('4')});
  EXPECT_TRUE(shows("No fault and no stop."));
  record_.reset();
  (void)draw(ui_);
  EXPECT_TRUE(shows("Reading the session"));
  problem_ = "a damaged log";
  (void)draw(ui_);
  EXPECT_TRUE(shows("a damaged log"));
}

TEST_F(RecordViewTest, ASessionWithoutAnswersHasATimeline) {
  record_->answers.clear();
  (void)draw(ui_);
  EXPECT_TRUE(shows("Preparation"));
}

TEST_F(RecordViewTest, NothingIsCutOffInASmallWindow) {
  for (const RecordPage page :
       {RecordPage::kTimeline, RecordPage::kAnswers, RecordPage::kNotes, RecordPage::kFaults}) {
    state_.page = page;
    HeadlessUi small(1280, 720);
    (void)draw(small);
    EXPECT_TRUE(all_on_screen(small.drawn(), 1280, 720));
    EXPECT_GT(small.drawn().find("back")->place.height, 30);
  }
}

}  // namespace record_view_test
}  // namespace jnd::app::gui
