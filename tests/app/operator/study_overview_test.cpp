#include "app/operator/study_overview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/operator/simulated_study.h"
#include "app/preregistration/preregistration.h"
#include "app/session/reopened_session.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/withdrawal.h"

namespace jnd::app {
namespace study_overview_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kDay_ns = 86'400 * kSecond_ns;

StudyOverview overview_of(const SimulatedStudy& made) {
  WorkControl control;
  return study_overview(made.folder(), /*seed=*/3, control);
}

std::string all_words_of(const StudyOverview& overview) {
  std::string words = overview.cell_problem + overview.planned_by + overview.backup.hint;
  for (const BalanceGroup& group : overview.balance) {
    words += group.title;
    for (const BalanceLine& line : group.lines) words += line.words;
  }
  for (const NextCell& next : overview.next_cells) words += next.brings + next.cell;
  return words;
}

TEST(StudyOverview, CountsTheCellsAndSaysWhoGetsWhichNext) {
  SimulatedStudy made(kCounterbalancedStudy);
  made.simulate(2);
  (void)made.interrupt(1);
  made.simulate(1, /*record=*/false, /*pilot=*/true);
  const StudyOverview overview = overview_of(made);
  EXPECT_EQ(overview.num_done, 2);
  ASSERT_EQ(overview.balance.size(), 1U);
  ASSERT_EQ(overview.balance[0].lines.size(), 2U);
  int done = 0, open = 0, next = 0;
  for (const BalanceLine& line : overview.balance[0].lines) {
    EXPECT_EQ(line.num_done, 1) << line.words << ": two people in two cells";
    done += line.num_done;
    open += line.num_open;
    next += line.is_next ? 1 : 0;
  }
  EXPECT_EQ(done, 2) << "a pilot is none of them";
  EXPECT_EQ(open, 1);
  EXPECT_EQ(next, 1);
  EXPECT_EQ(overview.next_participant, "P05");
  ASSERT_EQ(overview.next_cells.size(), 1U);
  // The session itself draws the same cell.
  made.simulate(1);
  const StudyFolder folder = open_study_folder(made.folder());
  EXPECT_EQ(folder.sessions.back().participant, "P05");
  EXPECT_EQ(folder.sessions.back().cells, overview.next_cells[0].cell);
}

TEST(StudyOverview, OfADoubleBlindStudyTellsNoOrderAndNoArm) {
  SimulatedStudy made(replaced(kCounterbalancedStudy, R"("languages")",
                               R"("blinding": "double", "languages")"));
  made.simulate(3);
  const StudyOverview overview = overview_of(made);
  EXPECT_TRUE(overview.hides_levels);
  EXPECT_EQ(overview.num_done, 3);
  EXPECT_TRUE(overview.balance.empty());
  EXPECT_TRUE(overview.next_cells.empty());
  EXPECT_EQ(overview.next_participant, "P04");
  EXPECT_EQ(all_words_of(overview).find("arm"), std::string::npos);
  for (const SessionQuality& quality : overview.quality) {
    EXPECT_EQ(quality.num_unstroked, 0) << "movement could tell the level";
  }
}

TEST(StudyOverview, TellsWhatTheNextGetsByWhatTheyBring) {
  const SimulatedStudy made(replaced(
      replaced(kCounterbalancedStudy, R"("method": "order",)",
               R"("method": "order", "stratify_by": "sex",)"),
      R"("stages": [)",
      R"("participant_fields": [{"name": "sex", "question": {"en": "Sex?"}, "options": [
         {"value": "female", "label": {"en": "Female"}},
         {"value": "male", "label": {"en": "Male"}}]}],
  "stages": [)"));
  create_study_folder(made.file(), made.folder());
  const StudyOverview overview = overview_of(made);
  ASSERT_EQ(overview.next_cells.size(), 2U);
  EXPECT_EQ(overview.next_cells[0].brings, "sex: female");
  EXPECT_THAT(overview.next_cells[0].cell, HasSubstr(", then "));
  EXPECT_EQ(overview.next_cells[0].cell.find("female"), std::string::npos);
  EXPECT_TRUE(overview.quality.empty());
}

TEST(StudyOverview, ThePlannedNumberIsThatOfTheStudyElseWhatIsWrittenDown) {
  const SimulatedStudy made;
  create_study_folder(made.file(), made.folder());
  EXPECT_FALSE(overview_of(made).num_planned.has_value());
  write_planned_number(made.folder(), "12");
  EXPECT_EQ(overview_of(made).num_planned, 12);
  EXPECT_EQ(overview_of(made).planned_by, "");
  for (const char* none : {"", "0", "-3", "twelve", "12.5", "12 people"}) {
    EXPECT_THROW(write_planned_number(made.folder(), none), core::Error) << none;
  }
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    keep_preregistration(
        store,
        preregistration_of(made.study(), "tiny.json", {.num_participants = 20}, {}, 1).dump());
  }
  const StudyOverview overview = overview_of(made);
  EXPECT_EQ(overview.num_planned, 20);
  EXPECT_EQ(overview.planned_by, "preregistered");
  EXPECT_THROW(write_planned_number(made.folder(), "24"), core::Error);
}

TEST(StudyOverview, TheBackupIsAsOldAsItsCopyAndSaysWhatIsNewer) {
  SimulatedStudy made;
  made.simulate(1);
  EXPECT_THAT(overview_of(made).backup.hint, HasSubstr("A disk that fails"));
  const fs::path copy = made.temporary() / "copy";
  const std::int64_t now_ns = core::SystemClock().now_ns();
  (void)core::back_up(made.folder(), copy, now_ns - 10 * kDay_ns);
  BackupAge age = overview_of(made).backup;
  EXPECT_TRUE(age.is_known);
  EXPECT_EQ(age.when, "10 days ago");
  EXPECT_EQ(age.num_newer_sessions, 0);
  EXPECT_THAT(age.hint, HasSubstr("own disk"));
  // Somebody took part after that.
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    const std::int64_t session =
        store.add_session({.participant = "P02",
                           .protocol_sha256 = store.sessions()[0].protocol_sha256,
                           .device = "lumped",
                           .rate_hz = 1000.0});
    store.append({.event = {.session = session,
                            .sequence = 1,
                            .kind = "session_started",
                            .time_ns = now_ns - kDay_ns}});
  }
  age = overview_of(made).backup;
  EXPECT_EQ(age.num_newer_sessions, 1);
  EXPECT_THAT(age.hint, HasSubstr("The copy is old. 1 session is newer"));
  fs::rename(copy, made.temporary() / "unplugged");
  EXPECT_TRUE(overview_of(made).backup.is_away);
}

TEST(StudyOverview, CountsWhatWentWrongInASession) {
  SimulatedStudy made;
  made.simulate(1);
  const SessionQuality sound = overview_of(made).quality.at(0);
  EXPECT_GT(sound.num_ticks, 1000);
  EXPECT_EQ(sound.num_missed_ticks, 0);
  EXPECT_EQ(sound.num_faults, 0);
  EXPECT_EQ(sound.num_repeated, 0);
  const std::int64_t session = made.interrupt(3);
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    ReopenedSession reopened(store, store.session(session));
    experiments::Session& open = reopened.session();
    const std::int64_t tick = open.state().last_tick + 1;
    open.fault("The hand was too fast.");
    open.go_on();
    const auto current = open.state().current_trial();
    if (current && open.state().trial(*current).under_way) open.discard_attempt("a noise");
    open.undo("slipped");
    // The participant felt the stimulus for a tenth of a second without a stroke, and answered
    // at once.
    open.start_trial(tick);
    open.begin_presentation("test", tick);
    open.end_presentation(tick + 99, {.measures = {.num_strokes = 0, .missed_ticks = 4}});
    open.answer(100.0, {.response_time_s = 0.1}, tick + 99);
  }
  const SessionQuality quality = overview_of(made).quality.at(1);
  EXPECT_EQ(quality.participant, "P02");
  EXPECT_EQ(quality.num_faults, 1);
  EXPECT_EQ(quality.num_repeated, 1);
  EXPECT_EQ(quality.num_missed_ticks, 4);
  EXPECT_GE(quality.num_unstroked, 1);
  EXPECT_GE(quality.num_unlikely, 1);
  EXPECT_TRUE(quality.is_doubtful());
}

TEST(StudyOverview, ADamagedLogIsToldAndTheOthersAreStillCounted) {
  SimulatedStudy made;
  made.simulate(1);
  (void)made.interrupt(1);
  {
    core::StudyStore store(made.folder(), core::StudyStore::Mode::kReadWrite);
    const auto last = static_cast<std::int64_t>(store.events(2).size());
    store.append({.event = {.session = 2, .sequence = last + 1, .kind = "a_dance"}});
  }
  const StudyOverview overview = overview_of(made);
  EXPECT_EQ(overview.quality.at(0).problem, "");
  EXPECT_THAT(overview.quality.at(1).problem, HasSubstr("a_dance"));
}

class AppointmentTest : public ::testing::Test {
 protected:
  AppointmentTest() { made_.simulate(1); }
  /// Returns the text of the day that is `days` days from now.
  [[nodiscard]] static std::string day(int days) {
    return date_text(core::SystemClock().now_ns() + days * kDay_ns);
  }

  SimulatedStudy made_;
};

TEST_F(AppointmentTest, TimesAreReadAndWrittenWhereTheMachineIs) {
  const auto time_ns = time_of_texts("2026-12-01", "14:30");
  ASSERT_TRUE(time_ns.has_value());
  EXPECT_EQ(date_text(*time_ns), "2026-12-01");
  EXPECT_EQ(hour_text(*time_ns), "14:30");
  EXPECT_EQ(*time_of_texts("2026-12-02", "14:30") - *time_ns, kDay_ns);
  for (const auto& [date, hour] : {std::pair{"2026-02-30", "10:00"},
                                   {"2026-13-01", "10:00"},
                                   {"1.12.2026", "10:00"},
                                   {"2026-12-01", "24:00"},
                                   {"2026-12-01", "9:00"},
                                   {"", ""}}) {
    EXPECT_FALSE(time_of_texts(date, hour).has_value()) << date << " " << hour;
  }
}

TEST_F(AppointmentTest, WhoComesIsAPseudonymAndNextInTurn) {
  write_appointment(made_.folder(), "P07", day(2), "10:00");
  write_appointment(made_.folder(), "P03", day(1), "15:00");
  write_appointment(made_.folder(), "P02", day(-3), "10:00");
  const StudyOverview overview = overview_of(made_);
  ASSERT_EQ(overview.schedule.size(), 3U);
  EXPECT_EQ(overview.schedule[0].participant, "P02");
  EXPECT_EQ(overview.schedule[0].state, ScheduleLine::State::kMissed);
  EXPECT_EQ(overview.schedule[1].when, "tomorrow at 15:00");
  EXPECT_EQ(overview.schedule[1].state, ScheduleLine::State::kComing);
  EXPECT_EQ(overview.next_participant, "P03") << "who was to come three days ago is not next";
  EXPECT_EQ(overview.free_pseudonym, "P04");
  cancel_appointment_of(made_.folder(), overview.schedule[1].appointment);
  EXPECT_EQ(overview_of(made_).schedule.size(), 2U);
  EXPECT_EQ(overview_of(made_).next_participant, "P07");
}

TEST_F(AppointmentTest, WhoHasASessionHasCome) {
  write_appointment(made_.folder(), "P01", day(0), "00:00");
  EXPECT_EQ(overview_of(made_).schedule.at(0).state, ScheduleLine::State::kCame);
  EXPECT_EQ(overview_of(made_).next_participant, "P02");
}

TEST_F(AppointmentTest, NamesOfPeopleAndWrongTimesAreRefused) {
  EXPECT_THROW(write_appointment(made_.folder(), "Anna Meier", day(1), "10:00"), core::Error);
  EXPECT_THROW(write_appointment(made_.folder(), "", day(1), "10:00"), core::Error);
  EXPECT_THROW(write_appointment(made_.folder(), "P03", "tomorrow", "10:00"), core::Error);
  write_appointment(made_.folder(), "P03", day(1), "10:00");
  EXPECT_THROW(write_appointment(made_.folder(), "P03", day(1), "10:00"), core::Error);
  EXPECT_EQ(overview_of(made_).schedule.size(), 1U);
}

}  // namespace study_overview_test
}  // namespace jnd::app
