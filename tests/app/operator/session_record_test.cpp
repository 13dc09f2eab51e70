#include "app/operator/session_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/operator/answer_doubts.h"
#include "app/operator/record_acts.h"
#include "app/operator/simulated_study.h"
#include "app/session/reopened_session.h"
#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/flight_record.h"

namespace jnd::app {
namespace session_record_test {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// Holds a study with one complete session.
class SessionRecordTest : public ::testing::Test {
 protected:
  SessionRecordTest() { made_.simulate(1); }
  [[nodiscard]] fs::path folder() const { return made_.folder(); }
  [[nodiscard]] SessionRecord record(std::int64_t session = 1) const {
    return session_record(folder(), session);
  }
  /// Does something to the session, as another program might.
  template <typename Act>
  void with_session(std::int64_t session, const Act& act) {
    core::StudyStore store(folder(), core::StudyStore::Mode::kReadWrite);
    ReopenedSession reopened(store, store.session(session));
    act(reopened.session());
  }
  [[nodiscard]] const RecordAnswer& answer_to(const SessionRecord& record,
                                              std::int64_t trial) const {
    return *std::ranges::find(record.answers, trial, &RecordAnswer::trial);
  }

  SimulatedStudy made_;
};

/// Returns every word that a page could show.
std::string all_words_of(const SessionRecord& record) {
  std::string words = record.line.cells;
  for (const RecordSpan& stage : record.stages) words += stage.title + "\n";
  for (const RecordAnswer& answer : record.answers) {
    words += answer.block + " " + answer.stimulus + " " + answer.answer + " " + answer.hint;
    for (const std::string& told : answer.history) words += " " + told;
    words += "\n";
  }
  for (const RecordFault& fault : record.faults) {
    words += fault.words + fault.where + fault.flight_record.string();
  }
  for (const auto& [name, value] : record.facts) words += name + value;
  for (const RecordNote& note : record.notes) words += note.text;
  return words;
}

TEST_F(SessionRecordTest, HasEveryStageAndEveryAnswerInTheirOrder) {
  const SessionRecord whole = record();
  ASSERT_EQ(whole.stages.size(), 8U);
  EXPECT_EQ(whole.stages[0].title, "Before");
  EXPECT_EQ(whole.stages[6].title, "Comparison");
  for (std::size_t i = 0; i < whole.stages.size(); ++i) {
    EXPECT_LE(whole.stages[i].begin_s, whole.stages[i].end_s);
    if (i > 0) {
      EXPECT_GE(whole.stages[i].begin_s, whole.stages[i - 1].end_s);
    }
  }
  EXPECT_GT(whole.duration_s, 1.0);
  EXPECT_LE(whole.stages.back().end_s, whole.duration_s);
  ASSERT_EQ(whole.answers.size(), static_cast<std::size_t>(kTinyTrials));
  EXPECT_EQ(whole.answers[0].trial, 1);
  EXPECT_EQ(whole.answers[0].block, "Estimation");
  EXPECT_THAT(whole.answers[0].stimulus, HasSubstr("scale "));
  EXPECT_THAT(whole.answers[0].answer, HasSubstr(" %"));
  EXPECT_EQ(whole.answers[3].in_block, 4);
  EXPECT_EQ(whole.answers[4].block, "Production");
  EXPECT_EQ(whole.answers[4].in_block, 1);
  EXPECT_THAT(whole.answers[4].stimulus, HasSubstr("target 100 %"));
  EXPECT_THAT(whole.answers[6].stimulus, HasSubstr("reference 8 Pa s"));
  EXPECT_TRUE(std::ranges::is_sorted(whole.answers, {}, &RecordAnswer::at_s));
  EXPECT_TRUE(whole.answers[0].history.empty());
  EXPECT_TRUE(whole.is_over);
  EXPECT_TRUE(whole.pauses.empty());
  EXPECT_TRUE(whole.faults.empty());
}

TEST_F(SessionRecordTest, SaysWhatBecameOfAnAnswer) {
  const std::string before = answer_to(record(), 7).answer;
  const bool was_yes = before == "yes";
  correct_answer(folder(), 1, 7, was_yes ? 0.0 : 1.0, "the wrong key");
  EXPECT_EQ(exclude_trials(folder(), 1, {7, 8}, "a door slammed", /*include=*/false), 2);
  EXPECT_EQ(exclude_trials(folder(), 1, {8}, "that was the next one", /*include=*/true), 1);
  const SessionRecord now = record();
  const RecordAnswer& seventh = answer_to(now, 7);
  EXPECT_EQ(seventh.answer, was_yes ? "no" : "yes");
  EXPECT_TRUE(seventh.excluded);
  EXPECT_THAT(seventh.history, ElementsAre("was “" + before + "” before: the wrong key",
                                           "left out of results: a door slammed"));
  EXPECT_FALSE(answer_to(now, 8).excluded);
  EXPECT_THAT(answer_to(now, 8).history,
              ElementsAre("left out of results: a door slammed",
                          "taken into results again: that was the next one"));
  EXPECT_EQ(now.answers.size(), record().answers.size());
}

// Somebody does this days later. The time between does not count as time at the device.
TEST_F(SessionRecordTest, WhatIsDoneAfterwardsIsNoTimeAtTheDevice) {
  const double before_s = record().duration_s;
  correct_answer(folder(), 1, 7, 1.0, "the wrong key");
  add_note(folder(), 1, "the person called: all is well");
  (void)exclude_trials(folder(), 1, {1}, "why not", /*include=*/false);
  const SessionRecord after = record();
  EXPECT_EQ(after.duration_s, before_s);
  EXPECT_EQ(after.line.when, "") << "of a simulated session nothing has a date";
  ASSERT_EQ(after.notes.size(), 1U);
  EXPECT_EQ(after.notes[0].when.substr(0, 8), "today at");
  EXPECT_LT(after.notes[0].at_s, 0.0);
}

TEST_F(SessionRecordTest, NotesAreReadOnceAndFoundAgain) {
  add_note(folder(), 1, "Long hair under the glove");
  add_note(folder(), 1, "the lamp flickered");
  add_adverse_event(folder(), 1, "a pinched finger");
  SessionRecord noted = record();
  ASSERT_EQ(noted.notes.size(), 3U);
  EXPECT_EQ(noted.notes[0].kind, RecordNote::Kind::kAdverseEvent);
  EXPECT_EQ(noted.notes[1].text, "the lamp flickered") << "the newest first";
  EXPECT_EQ(noted.num_unread(), 3);
  acknowledge_note(folder(), noted.notes[0].what);
  acknowledge_note(folder(), noted.notes[2].what);
  noted = record();
  EXPECT_TRUE(noted.notes[0].is_read);
  EXPECT_FALSE(noted.notes[1].is_read);
  EXPECT_TRUE(noted.notes[2].is_read);
  EXPECT_EQ(noted.num_unread(), 1);
  EXPECT_TRUE(is_found(noted.notes[2], "HAIR"));
  EXPECT_TRUE(is_found(noted.notes[2], ""));
  EXPECT_FALSE(is_found(noted.notes[1], "hair"));
}

TEST_F(SessionRecordTest, WhatNobodyWroteAsksForNobodyToReadIt) {
  with_session(1, [](experiments::Session& open) {
    open.note(std::string(kNoteOfDoubt) + "99999 to trial 3 (more than 1000 %): stored");
  });
  const SessionRecord told = record();
  ASSERT_EQ(told.notes.size(), 1U);
  EXPECT_EQ(told.notes[0].kind, RecordNote::Kind::kAsked);
  EXPECT_FALSE(is_new(told.notes[0]));
  EXPECT_EQ(told.num_unread(), 0);
}

TEST_F(SessionRecordTest, PausesFaultsAndTheirLastSecondAreTold) {
  const std::int64_t session = made_.interrupt(5);
  std::int64_t last_tick = 0;
  with_session(session, [&](experiments::Session& open) {
    last_tick = open.state().last_tick;
    open.pause("");
    open.explain_pause("a question");
    open.go_on();
    open.fault("Somebody pressed the emergency stop.");
    open.fault("The hand was too fast.");
  });
  core::Sample sample;
  sample.tick = last_tick + 500;
  fs::path kept;
  {
    const core::StudyStore store(folder(), core::StudyStore::Mode::kReadOnly);
    std::vector<core::Sample> samples;
    for (int i = 0; i < 100; ++i) {
      core::Sample one;
      one.tick = sample.tick - 99 + i;
      one.tip_force_n[0] = {3.0, 0.0, 4.0};
      one.tip_velocity_m_per_s[2] = {0.0, 0.5, 0.0};
      samples.push_back(one);
    }
    kept = core::write_flight_record(store.recording_file(session), samples);
  }
  const SessionRecord told = record(session);
  ASSERT_EQ(told.pauses.size(), 3U);
  EXPECT_EQ(told.pauses[0].title, "stopped by the operator") << "who interrupted it";
  EXPECT_EQ(told.pauses[1].title, "a question");
  EXPECT_EQ(told.pauses[2].title, "no force");
  ASSERT_EQ(told.notes.size(), 2U);
  EXPECT_EQ(told.notes[0].text, "a question");
  EXPECT_EQ(told.notes[0].kind, RecordNote::Kind::kPause);
  ASSERT_EQ(told.faults.size(), 2U);
  EXPECT_THAT(told.faults[0].where, HasSubstr("Production"));
  EXPECT_EQ(told.faults[0].flight_record, "") << "one file, of the last of them";
  EXPECT_EQ(told.faults[1].flight_record, kept);
  const FlightRecord flight = read_flight_record(kept, 1000.0);
  ASSERT_EQ(flight.time_s.size(), 100U);
  EXPECT_DOUBLE_EQ(flight.time_s.front(), -0.099);
  EXPECT_DOUBLE_EQ(flight.time_s.back(), 0.0);
  EXPECT_DOUBLE_EQ(flight.force_n.front(), 5.0);
  EXPECT_DOUBLE_EQ(flight.speed_m_per_s.front(), 0.5);
}

TEST_F(SessionRecordTest, AFlightRecordThatIsNoneIsAnError) {
  const fs::path file = write_file(made_.temporary() / "x.csv", "tick,other\n1,2\n");
  EXPECT_THROW((void)read_flight_record(file, 1000.0), core::Error);
  EXPECT_THROW((void)read_flight_record(made_.temporary() / "none.csv", 1000.0), core::Error);
}

TEST_F(SessionRecordTest, ASessionThatCanBeResumedIsNotChangedFromOutside) {
  const std::int64_t session = made_.interrupt(8);
  EXPECT_THROW(correct_answer(folder(), session, 1, 50.0, "why"), core::Error);
  EXPECT_THROW(add_note(folder(), session, "a note"), core::Error);
  EXPECT_NO_THROW(add_adverse_event(folder(), session, "a fright"));
  EXPECT_EQ(exclude_trials(folder(), session, {1}, "why", /*include=*/false), 1);
  EXPECT_FALSE(record(session).is_over);
}

TEST_F(SessionRecordTest, NothingIsDoneWithoutAReasonOrToATrialThatIsNotThere) {
  EXPECT_THROW(correct_answer(folder(), 1, 7, 1.0, " "), core::Error);
  EXPECT_THROW((void)exclude_trials(folder(), 1, {1}, "", false), core::Error);
  EXPECT_THROW((void)exclude_trials(folder(), 1, {1, 99}, "why", false), core::Error);
  EXPECT_FALSE(answer_to(record(), 1).excluded) << "all of them or none";
  EXPECT_THROW(add_note(folder(), 1, "\n"), core::Error);
  EXPECT_THROW((void)record(9), core::Error);
}

TEST_F(SessionRecordTest, AWithdrawalDeletesAndSaysWhatItCouldNotReach) {
  made_.simulate(1);
  WorkControl control;
  const fs::path copy = made_.temporary() / "copy";
  (void)core::back_up(folder(), copy, 1);
  fs::rename(copy, made_.temporary() / "unplugged");
  const ActionOutcome outcome = withdraw_participant(folder(), "P01", control);
  EXPECT_FALSE(outcome.ok);
  EXPECT_EQ(outcome.sentence, "P01 withdrew; 1 session deleted here and in 0 backups");
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_THAT(outcome.problems[0], HasSubstr("attach it and withdraw the person again"));
  EXPECT_THROW((void)record(1), core::Error);
  EXPECT_EQ(record(2).line.participant, "P02");
}

TEST(SessionRecord, OfADoubleBlindStudyTellsNoLevelAndNoForce) {
  SimulatedStudy made(kDoubleBlindStudy);
  made.simulate(1);
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    ReopenedSession reopened(store, store.session(1));
    reopened.session().fault("The hand was too fast.");
    core::Sample sample;
    sample.tick = reopened.session().state().last_tick + 1;
    (void)core::write_flight_record(store.recording_file(1), {sample});
  }
  const SessionRecord record = session_record(made.folder(), 1);
  EXPECT_TRUE(record.hides_levels);
  ASSERT_EQ(record.answers.size(), static_cast<std::size_t>(kTinyTrials));
  EXPECT_EQ(record.answers[0].stimulus, "");
  EXPECT_EQ(record.answers[0].block, "Block 1");
  EXPECT_EQ(record.answers[4].answer, "set");
  ASSERT_EQ(record.faults.size(), 1U);
  EXPECT_EQ(record.faults[0].flight_record, "");
  const std::string words = all_words_of(record);
  for (const char* level : {"scale", "Pa s", "target", "reference", "Comparison", "Estimation",
                            "viscous", "water", "no stroke"}) {
    EXPECT_EQ(words.find(level), std::string::npos) << level << " in\n" << words;
  }
}

}  // namespace session_record_test
}  // namespace jnd::app
