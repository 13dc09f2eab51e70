#include "core/storage/study_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/clock.h"
#include "core/storage/acknowledgement.h"
#include "core/storage/backup.h"
#include "core/storage/export_note.h"
#include "core/storage/integrity.h"
#include "core/storage/kept_study.h"
#include "core/storage/old_study.h"
#include "core/storage/schedule.h"
#include "support/files.h"

namespace jnd::core {
namespace study_format_test {

namespace fs = std::filesystem;
using test_support::read_file;
using testing::ElementsAre;
using testing::IsEmpty;

std::int64_t format_of(const fs::path& folder) {
  Database database(folder / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  return study_format_of(database);
}

/// The definition of every table, column, view, index and trigger.
std::string schema_of(const fs::path& folder) {
  Database database(folder / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  Statement rows(database, "SELECT type, name, sql FROM sqlite_master ORDER BY type, name");
  std::string text;
  while (rows.step()) text += rows.text(0) + ' ' + rows.text(1) + ": " + rows.text(2) + '\n';
  return text;
}

/// Tests a study of the layout that is the test's parameter.
class OldLayoutTest : public ::testing::TestWithParam<std::int64_t> {
 protected:
  OldLayoutTest() { copy_old_study(GetParam(), old()); }
  [[nodiscard]] fs::path old() const { return temporary_.path() / "old.study"; }
  [[nodiscard]] static bool has(std::int64_t layout) { return GetParam() >= layout; }

  /// Each layout holds something that the one before does not; everything older stays.
  static void expect_all_of(const StudyStore& store) {
    ASSERT_FALSE(store.sessions().empty());
    EXPECT_EQ(store.sessions()[0].participant, "P01");
    EXPECT_EQ(store.protocol(store.sessions()[0].protocol_sha256).relative_path, "");
    EXPECT_EQ(store.trials(1).size(), 4U);
    EXPECT_EQ(store.answers(1).size(), 2U);
    ASSERT_EQ(store.design(1).size(), 6U);
    EXPECT_FALSE(store.design(1)[0].series || store.design(1)[0].is_catch);
    EXPECT_EQ(store.design(1)[0].intervals, "");
    EXPECT_FALSE(store.trials(1)[0].right_interval ||
                 store.trials(1)[0].measures.chosen_interval);
    ASSERT_EQ(store.presentations(1).size(), 4U);
    EXPECT_FALSE(store.presentations(1)[0].measures.finger_lag_s);
    EXPECT_EQ(store.presentations(1)[0].measures.missed_ticks, 0);
    EXPECT_TRUE(verify(store).complete);

    EXPECT_EQ(store.study_id().size(), 32U);
    EXPECT_EQ(store.study_id() == "0123456789abcdef0123456789abcdef", has(2));
    EXPECT_EQ(store.unblinded(), has(2));
    ASSERT_EQ(store.withdrawals().size(), has(2) ? 1U : 0U);
    EXPECT_THAT(store.unfinished_withdrawals(), IsEmpty());
    ASSERT_EQ(store.protocols().size(), has(2) ? 2U : 1U);
    if (has(2)) {
      EXPECT_EQ(store.withdrawals()[0].session, 2);
      EXPECT_EQ(store.withdrawals()[0].participant, "P02");
      EXPECT_EQ(store.protocols()[1].relative_path, "../second.json");
      EXPECT_THAT(known_backups(store.folder()), ElementsAre("/backups/kept.study"));
    }
    if (has(3)) {
      ASSERT_EQ(store.presentations(3).size(), 1U);
      EXPECT_EQ(store.presentations(3)[0].measures.finger_lag_s, 0.0125);
      EXPECT_EQ(store.presentations(3)[0].measures.missed_ticks, 0);
    }
    if (has(4)) expect_adaptive_trials(store);
    if (has(5)) {
      ASSERT_EQ(store.presentations(5).size(), 1U);
      EXPECT_EQ(store.presentations(5)[0].measures.missed_ticks, 3);
    }
    ASSERT_EQ(store.adverse_events().size(), has(6) ? 1U : 0U);
    if (has(6)) {
      EXPECT_EQ(store.adverse_events()[0].text, "a pinched finger");
      const std::vector<ExportNote> exports = noted_exports(store.folder());
      ASSERT_EQ(exports.size(), 2U);
      EXPECT_EQ(exports[0].place, "/exports/first_csv");
      EXPECT_THAT(exports[0].sessions, ElementsAre(1, 3));
    }
    ASSERT_EQ(store.device_profiles().size(), has(7) ? 1U : 0U);
    for (const SessionRow& row : store.sessions()) {
      EXPECT_EQ(row.device_profile_sha256,
                row.session == 6 ? store.device_profiles()[0].sha256 : "");
      EXPECT_EQ(store.question_answers(row.session).size(),
                has(8) && row.session == 5 ? 1U : 0U);
    }
    if (has(9)) {
      ASSERT_EQ(store.trials(7).size(), 1U);
      EXPECT_EQ(store.trials(7)[0].intervals, "rtr");
      EXPECT_EQ(store.trials(7)[0].right_interval, 2);
      EXPECT_EQ(store.trials(7)[0].measures.chosen_interval, 2);
    }
    ASSERT_EQ(store.looks().size(), has(10) ? 1U : 0U);
    ASSERT_EQ(store.unsealings().size(), has(10) ? 1U : 0U);
    if (has(10)) {
      EXPECT_EQ(store.looks()[0].decision, "go_on");
      EXPECT_THAT(store.looks()[0].sessions, ElementsAre(3, 4));
      EXPECT_EQ(store.unsealings()[0].reason, "a visit");
    }
    if (has(11)) {
      ASSERT_EQ(store.design(8).size(), 2U) << "that of the other block stays";
      EXPECT_TRUE(store.trials(8).empty());
    }
    EXPECT_THAT(store.trials(1)[0].measures.answered_by, IsEmpty());
    if (has(12)) {
      ASSERT_EQ(store.trials(9).size(), 1U);
      EXPECT_EQ(store.trials(9)[0].measures.answered_by, "participant");
      EXPECT_EQ(store.trials(9)[0].measures.control, "0c45:7403 FootSwitch/KEY_B");
      EXPECT_EQ(store.trials(9)[0].measures.control_monotonic_s, 241.5);
    }
    EXPECT_EQ(appointments(store.folder()).size(), has(13) ? 1U : 0U);
    EXPECT_EQ(acknowledgements(store.folder()).size(), has(13) ? 1U : 0U);
    EXPECT_EQ(planned_number(store.folder()),
              has(13) ? std::optional<std::int64_t>(12) : std::nullopt);
    if (has(13)) expect_both_times_of_a_stage(store);
  }

  static void expect_both_times_of_a_stage(const StudyStore& store) {
    EXPECT_EQ(store.session(10).started_time_ns, 260 * kNsPerS) << "that of its first event";
    const std::vector<AnswerRow> answers = store.answers(10);
    ASSERT_EQ(answers.size(), 3U);
    EXPECT_EQ(answers[0].item, "sex");
    EXPECT_FALSE(answers[0].stage_index);
    EXPECT_EQ(answers[1].answer, "2");
    EXPECT_EQ(answers[1].stage_index, 0);
    EXPECT_EQ(answers[2].answer, "5") << "corrected while the stage went on";
    EXPECT_EQ(answers[2].stage_index, 1);
  }

  static void expect_adaptive_trials(const StudyStore& store) {
    const std::vector<DesignRow> design = store.design(4);
    ASSERT_EQ(design.size(), 2U) << "one was drawn for an answer that was taken back";
    EXPECT_EQ(store.design(4, /*include_voided=*/true).size(), 3U);
    EXPECT_EQ(design[0].sequence, 3);
    EXPECT_EQ(design[0].series, 1);
    EXPECT_EQ(design[0].test_interval, 2);
    EXPECT_FALSE(design[0].is_catch);
    EXPECT_EQ(design[1].trial, 3);
    EXPECT_FALSE(design[1].series);
    EXPECT_TRUE(design[1].is_catch);
    const std::vector<TrialRow> trials = store.trials(4);
    ASSERT_EQ(trials.size(), 2U);
    EXPECT_EQ(trials[0].attempt, 2);
    EXPECT_EQ(trials[0].series, 1);
    EXPECT_EQ(trials[0].test_interval, 2);
    EXPECT_TRUE(trials[1].is_catch);
  }

  test_support::TemporaryFolder temporary_;
};

TEST_P(OldLayoutTest, IsReadAndStaysAsItIs) {
  ASSERT_EQ(format_of(old()), GetParam());
  const std::string before = read_file(old() / "study.sqlite");
  {
    const StudyStore store(old(), StudyStore::Mode::kReadOnly);
    EXPECT_EQ(store.events(1).size(), 45U);
    expect_all_of(store);
  }
  EXPECT_EQ(read_file(old() / "study.sqlite"), before);
}

TEST_P(OldLayoutTest, IsBroughtUpToDateBeforeItIsWrittenTo) {
  {
    StudyStore store(old(), StudyStore::Mode::kReadWrite);
    store.append({.event = {.session = 1, .sequence = 46, .kind = "note_added"}});
  }
  EXPECT_EQ(format_of(old()), current_study_format());
  const StudyStore store(old(), StudyStore::Mode::kReadOnly);
  EXPECT_EQ(store.events(1).size(), 46U);
  expect_all_of(store);
}

TEST_P(OldLayoutTest, HasTheSchemaOfAFreshStudyThen) {
  bring_study_up_to_date(old());
  const fs::path fresh = temporary_.path() / "fresh.study";
  { const StudyStore store(fresh, StudyStore::Mode::kCreate); }
  EXPECT_EQ(schema_of(old()), schema_of(fresh));
}

TEST_P(OldLayoutTest, KeepsWhatTheStepsBeforeABadOneDid) {
  if (has(6)) GTEST_SKIP() << "the step is behind it";
  {
    Database database(old() / "study.sqlite", Database::Mode::kReadWrite,
                      Durability::kEveryCommit);
    // The sixth step makes this table last, so that it can make all but this one.
    database.execute("CREATE TABLE adverse_event (in_the_way INTEGER)");
    EXPECT_THROW(bring_up_to_date(database), Error);
    EXPECT_EQ(study_format_of(database), 5);
    EXPECT_THROW(database.execute("SELECT 1 FROM export"), Error);
    database.execute("DROP TABLE adverse_event");
    EXPECT_NO_THROW(bring_up_to_date(database));
  }
  EXPECT_EQ(format_of(old()), current_study_format());
  expect_all_of(StudyStore(old(), StudyStore::Mode::kReadOnly));
}

INSTANTIATE_TEST_SUITE_P(Layouts, OldLayoutTest,
                         ::testing::Range(std::int64_t{1}, current_study_format()));

class StudyFormatTest : public ::testing::Test {
 protected:
  StudyFormatTest() { copy_old_study(1, old()); }
  [[nodiscard]] fs::path old() const { return temporary_.path() / "old.study"; }

  test_support::TemporaryFolder temporary_;
};

TEST_F(StudyFormatTest, EachStepOrNothing) {
  Database database(old() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  // The second step makes this table. If it cannot, the first layout stays as it was, whole.
  database.execute("CREATE TABLE backup (in_the_way INTEGER)");
  EXPECT_THROW(bring_up_to_date(database), Error);
  EXPECT_EQ(study_format_of(database), 1);
  database.execute("DROP TABLE backup");
  EXPECT_NO_THROW(bring_up_to_date(database));
  EXPECT_EQ(study_format_of(database), current_study_format());
}

TEST_F(StudyFormatTest, ANewerLayoutIsRefusedReadingAndWriting) {
  {
    Database database(old() / "study.sqlite", Database::Mode::kReadWrite,
                      Durability::kEveryCommit);
    database.execute("INSERT INTO study_format VALUES (99, 'jnd 9')");
  }
  for (const auto mode :
       {StudyStore::Mode::kReadOnly, StudyStore::Mode::kReadWrite, StudyStore::Mode::kCreate}) {
    try {
      const StudyStore store(old(), mode);
      FAIL() << "opened";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("found 99; open it with a newer jnd"),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(read_file(old() / "study.sqlite").empty(), false);
}

TEST_F(StudyFormatTest, AFreshStudyHasEveryStepNoted) {
  const fs::path fresh = temporary_.path() / "fresh.study";
  { const StudyStore store(fresh, StudyStore::Mode::kCreate); }
  Database database(fresh / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  Statement count(database, "SELECT COUNT(*) FROM study_format");
  ASSERT_TRUE(count.step());
  EXPECT_EQ(count.integer(0), current_study_format());
}

}  // namespace study_format_test
}  // namespace jnd::core
