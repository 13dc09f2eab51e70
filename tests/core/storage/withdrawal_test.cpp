#include "core/storage/withdrawal.h"

#include <gtest/gtest.h>

#include "core/storage/acknowledgement.h"
#include "core/storage/backup.h"
#include "core/storage/backup_mark.h"
#include "core/storage/database.h"
#include "core/storage/integrity.h"
#include "core/storage/kept_study.h"
#include "core/storage/schedule.h"
#include "support/files.h"

namespace jnd::core {
namespace withdrawal_test {

namespace fs = std::filesystem;
using test_support::read_file;

class WithdrawalTest : public ::testing::Test {
 protected:
  WithdrawalTest() {
    kept_.add_session("P01");
    kept_.add_session("P02");
  }
  static bool holds(const fs::path& folder, const std::string& words) {
    return all_bytes(folder).find(words) != std::string::npos;
  }
  static Integrity verified(const fs::path& folder) {
    return verify(StudyStore(folder, StudyStore::Mode::kReadOnly));
  }

  KeptStudy kept_;
};

TEST_F(WithdrawalTest, NothingOfThePersonIsLeftButTheTombstone) {
  ASSERT_TRUE(holds(kept_.folder(), "secret of P01"));
  const WithdrawalReport report = withdraw(kept_.folder(), "P01", 5);
  EXPECT_EQ(report.sessions, std::vector<std::int64_t>{1});
  EXPECT_TRUE(report.remaining.empty());
  EXPECT_FALSE(holds(kept_.folder(), "secret of P01"));
  EXPECT_FALSE(holds(kept_.folder(), "note about P01"));
  EXPECT_FALSE(fs::exists(kept_.recording(1)));

  const StudyStore store(kept_.folder(), StudyStore::Mode::kReadOnly);
  ASSERT_EQ(store.sessions().size(), 1U);
  EXPECT_EQ(store.sessions()[0].participant, "P02");
  EXPECT_EQ(store.events(2).size(), 7U);
  EXPECT_EQ(store.answers(2).at(0).answer, "secret of P02");
  ASSERT_EQ(store.withdrawals().size(), 1U);
  EXPECT_EQ(store.withdrawals()[0].participant, "P01");
  EXPECT_EQ(store.withdrawals()[0].time_ns, 5);
  EXPECT_TRUE(verified(kept_.folder()).complete);
}

// A device profile is of a device, and serves the sessions of others.
TEST_F(WithdrawalTest, DeviceProfilesStayHereAndInEveryBackup) {
  {
    StudyStore store(kept_.folder(), StudyStore::Mode::kReadWrite, Durability::kAtClose);
    store.add_device_profile("{}");
  }
  const fs::path copy = kept_.beside("copy.study");
  (void)back_up(kept_.folder(), copy, 1);
  (void)withdraw(kept_.folder(), "P01", 5);
  for (const fs::path& folder : {kept_.folder(), copy}) {
    const StudyStore store(folder, StudyStore::Mode::kReadOnly);
    ASSERT_EQ(store.device_profiles().size(), 1U) << folder;
    EXPECT_EQ(store.device_profiles()[0].text, "{}");
  }
}

TEST_F(WithdrawalTest, AdverseEventsStayForGood) {
  {
    StudyStore store(kept_.folder(), StudyStore::Mode::kReadWrite, Durability::kAtClose);
    store.add_adverse_event(1, 7, "a pinched finger");
    store.add_adverse_event(2, 8, "a fright");
    EXPECT_THROW(store.add_adverse_event(99, 9, "nobody"), Error);
  }
  (void)withdraw(kept_.folder(), "P01", 5);
  const StudyStore store(kept_.folder(), StudyStore::Mode::kReadOnly);
  const std::vector<AdverseEventRow> all = store.adverse_events();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].session, 1);
  EXPECT_EQ(all[0].participant, "P01");
  EXPECT_EQ(all[0].time_ns, 7);
  EXPECT_EQ(all[0].text, "a pinched finger");
  EXPECT_EQ(all[1].text, "a fright");
  EXPECT_TRUE(verified(kept_.folder()).complete);
  Database database(kept_.folder() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kAtClose);
  EXPECT_THROW(Statement(database, "DELETE FROM adverse_event").run(), Error);
  EXPECT_THROW(Statement(database, "UPDATE adverse_event SET text = ''").run(), Error);
}

TEST_F(WithdrawalTest, NeitherItsNumberIsGivenAgainNorRowsCanBeDeletedAfterwards) {
  (void)withdraw(kept_.folder(), "P02", 5);
  EXPECT_EQ(kept_.add_session("P03"), 3);
  for (const char* table : {"event", "trial", "session", "design", "answer", "withdrawal"}) {
    Database database(kept_.folder() / "study.sqlite", Database::Mode::kReadWrite,
                      Durability::kAtClose);
    EXPECT_THROW(database.execute(std::string("DELETE FROM ") + table), Error) << table;
  }
}

/// What a layout to come may add: the rows of a person go with the others, whatever they refer
/// to and wherever their table stands in the alphabet.
TEST_F(WithdrawalTest, EmptiesATableThatALaterLayoutBrings) {
  {
    Database database(kept_.folder() / "study.sqlite", Database::Mode::kReadWrite,
                      Durability::kAtClose);
    for (const char* table : {"a_rating", "z_rating"}) {
      const std::string name = table;
      database.execute("CREATE TABLE " + name +
                       " (session INTEGER NOT NULL REFERENCES session, words TEXT)");
      database.execute("CREATE TRIGGER " + name + "_stays BEFORE DELETE ON " + name +
                       " BEGIN SELECT RAISE(ABORT, 'never deleted'); END");
      database.execute("INSERT INTO " + name + " VALUES (1, 'secret rating'), (2, 'kept')");
    }
    database.execute("CREATE TABLE phone_call (participant TEXT, words TEXT)");
    database.execute("INSERT INTO phone_call VALUES ('P01', 'secret call'), ('P02', 'kept')");
  }
  (void)withdraw(kept_.folder(), "P01", 5);
  Database database(kept_.folder() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kAtClose);
  for (const char* table : {"a_rating", "z_rating", "phone_call"}) {
    Statement rows(database, std::string("SELECT words FROM ") + table);
    ASSERT_TRUE(rows.step()) << table;
    EXPECT_EQ(rows.text(0), "kept") << table;
    EXPECT_FALSE(rows.step()) << table;
  }
  EXPECT_FALSE(holds(kept_.folder(), "secret rating"));
  EXPECT_FALSE(holds(kept_.folder(), "secret call"));
  EXPECT_THROW(database.execute("DELETE FROM z_rating"), Error) << "its trigger is back";
}

TEST_F(WithdrawalTest, ReachesAPersonWhoStandsOnlyInATableThatALaterLayoutBrings) {
  const auto calls = [&](const std::string& sql) {
    Database database(kept_.folder() / "study.sqlite", Database::Mode::kReadWrite,
                      Durability::kAtClose);
    database.execute(sql);
  };
  calls("CREATE TABLE phone_call (participant TEXT, words TEXT)");
  calls("INSERT INTO phone_call VALUES ('P09', 'secret call')");
  EXPECT_NO_THROW((void)withdraw(kept_.folder(), "P09", 5));
  EXPECT_FALSE(holds(kept_.folder(), "secret call"));
  EXPECT_THROW((void)withdraw(kept_.folder(), "P10", 6), Error);
}

TEST_F(WithdrawalTest, ReachesTheBackupsItKnowsOfAndSaysWhichItCannot) {
  (void)back_up(kept_.folder(), kept_.beside("near"), 1);
  (void)back_up(kept_.folder(), kept_.beside("away"), 2);
  fs::rename(kept_.beside("away"), kept_.beside("unplugged"));
  const WithdrawalReport first = withdraw(kept_.folder(), "P01", 5);
  EXPECT_EQ(first.backups, std::vector<fs::path>{kept_.beside("near")});
  EXPECT_FALSE(holds(kept_.beside("near"), "secret of P01"));
  EXPECT_FALSE(fs::exists(kept_.beside("near") / "recordings" / "0001.sqlite"));
  EXPECT_TRUE(verified(kept_.beside("near")).complete);
  ASSERT_EQ(first.remaining.size(), 1U);
  EXPECT_NE(first.remaining[0].find("away"), std::string::npos) << first.remaining[0];

  fs::rename(kept_.beside("unplugged"), kept_.beside("away"));
  const WithdrawalReport second = withdraw(kept_.folder(), "P01", 6);
  EXPECT_TRUE(second.remaining.empty());
  EXPECT_EQ(second.sessions, std::vector<std::int64_t>{1});
  EXPECT_FALSE(holds(kept_.beside("away"), "secret of P01"));
}

TEST_F(WithdrawalTest, ALaterBackupForgetsThePersonToo) {
  (void)back_up(kept_.folder(), kept_.beside("copy"), 1);
  fs::rename(kept_.beside("copy"), kept_.beside("unplugged"));
  (void)withdraw(kept_.folder(), "P01", 5);
  (void)back_up(kept_.folder(), kept_.beside("unplugged"), 7);
  EXPECT_FALSE(holds(kept_.beside("unplugged"), "secret of P01"));
  EXPECT_FALSE(fs::exists(kept_.beside("unplugged") / "recordings" / "0001.sqlite"));
}

TEST_F(WithdrawalTest, ABackupThatWasDeletedCanBeForgotten) {
  (void)back_up(kept_.folder(), kept_.beside("gone"), 1);
  fs::remove_all(kept_.beside("gone"));
  EXPECT_EQ(withdraw(kept_.folder(), "P01", 5).remaining.size(), 1U);
  EXPECT_THROW(forget_backup(kept_.folder(), kept_.beside("other"), 6), Error);
  forget_backup(kept_.folder(), kept_.beside("gone"), 6);
  EXPECT_TRUE(withdraw(kept_.folder(), "P01", 7).remaining.empty());
  // A backup that is made again is known again.
  (void)back_up(kept_.folder(), kept_.beside("gone"), 8);
  EXPECT_EQ(known_backups(kept_.folder()), std::vector<fs::path>{kept_.beside("gone")});
}

TEST_F(WithdrawalTest, ReachesTheBackupsOfBackups) {
  (void)back_up(kept_.folder(), kept_.beside("b"), 1);
  (void)back_up(kept_.beside("b"), kept_.beside("c"), 2);
  // A repeated backup does not forget that it has a backup.
  (void)back_up(kept_.folder(), kept_.beside("b"), 3);
  (void)withdraw(kept_.folder(), "P01", 5);
  EXPECT_FALSE(holds(kept_.beside("c"), "secret of P01"));
}

TEST_F(WithdrawalTest, DoesNotSayItIsDoneWhileSomebodyReads) {
  Database reader(kept_.folder() / "study.sqlite", Database::Mode::kReadOnly,
                  Durability::kEveryCommit);
  reader.execute("BEGIN");
  Statement row(reader, "SELECT * FROM event");
  ASSERT_TRUE(row.step());
  EXPECT_THROW((void)withdraw(kept_.folder(), "P01", 5), Error);
  row.reset();
  reader.execute("ROLLBACK");
  (void)withdraw(kept_.folder(), "P01", 6);
  EXPECT_FALSE(holds(kept_.folder(), "secret of P01"));
}

TEST_F(WithdrawalTest, OneBackupOutOfOrderDoesNotKeepTheOthers) {
  (void)back_up(kept_.folder(), kept_.beside("a"), 1);
  (void)back_up(kept_.folder(), kept_.beside("z"), 2);
  fs::remove_all(kept_.beside("a"));
  // The link leads to itself, so that it has no status at all.
  fs::create_symlink("a", kept_.beside("a"));
  const WithdrawalReport report = withdraw(kept_.folder(), "P01", 5);
  EXPECT_EQ(report.remaining.size(), 1U);
  EXPECT_EQ(report.backups, std::vector<fs::path>{kept_.beside("z")});
  EXPECT_FALSE(holds(kept_.beside("z"), "secret of P01"));
}

TEST_F(WithdrawalTest, LeavesAForeignFolderAsItIs) {
  fs::create_directory(kept_.beside("foreign"));
  {
    Database other(kept_.beside("foreign") / "study.sqlite", Database::Mode::kCreate,
                   Durability::kEveryCommit);
    other.execute("PRAGMA journal_mode = DELETE");
    other.execute("CREATE TABLE recipe (name TEXT)");
  }
  const std::string before = all_bytes(kept_.beside("foreign"));
  EXPECT_THROW((void)withdraw(kept_.beside("foreign"), "P01", 5), Error);
  EXPECT_EQ(all_bytes(kept_.beside("foreign")), before);
  EXPECT_FALSE(fs::exists(kept_.beside("foreign") / "writer.lock"));
}

TEST_F(WithdrawalTest, AnInterruptedOneIsFoundByVerifyAndFinishedByTheNextCall) {
  const std::string recording = read_file(kept_.recording(1));
  (void)withdraw(kept_.folder(), "P01", 5);
  std::ofstream(kept_.recording(1), std::ios::binary) << recording;
  EXPECT_FALSE(verified(kept_.folder()).complete);
  (void)withdraw(kept_.folder(), "P01", 6);
  EXPECT_FALSE(fs::exists(kept_.recording(1)));
  EXPECT_TRUE(verified(kept_.folder()).complete);
}

TEST_F(WithdrawalTest, WhileABackupIsOutOfReachVerifySaysThatItIsNotFinished) {
  (void)back_up(kept_.folder(), kept_.beside("away"), 2);
  fs::rename(kept_.beside("away"), kept_.beside("unplugged"));
  (void)withdraw(kept_.folder(), "P01", 5);
  const Integrity between = verified(kept_.folder());
  ASSERT_EQ(between.problems.size(), 1U);
  EXPECT_NE(between.problems[0].message.find("withdrawal of P01"), std::string::npos);
  EXPECT_NE(between.problems[0].message.find("backup"), std::string::npos);
  fs::rename(kept_.beside("unplugged"), kept_.beside("away"));
  (void)withdraw(kept_.folder(), "P01", 6);
  EXPECT_TRUE(verified(kept_.folder()).complete);
  EXPECT_TRUE(verified(kept_.beside("away")).complete);
}

TEST_F(WithdrawalTest, WhileItsBytesMayBeInTheFileVerifySaysSo) {
  {
    Database reader(kept_.folder() / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
    reader.execute("BEGIN");
    Statement row(reader, "SELECT * FROM event");
    ASSERT_TRUE(row.step());
    EXPECT_THROW((void)withdraw(kept_.folder(), "P01", 5), Error);
  }
  const Integrity between = verified(kept_.folder());
  ASSERT_EQ(between.problems.size(), 1U);
  EXPECT_NE(between.problems[0].message.find("repeat `jnd withdraw`"), std::string::npos);
  (void)withdraw(kept_.folder(), "P01", 6);
  EXPECT_TRUE(verified(kept_.folder()).complete);
}

/// The copy already has the recording, but not yet its session.
TEST_F(WithdrawalTest, ReachesWhatAnInterruptedBackupLeft) {
  (void)back_up(kept_.folder(), kept_.beside("copy"), 1);
  kept_.add_session("P03");
  begin_backup(kept_.beside("copy"), 2);
  const fs::path left = kept_.beside("copy") / "recordings" / "0003.sqlite";
  fs::copy_file(kept_.recording(3), left);
  EXPECT_TRUE(withdraw(kept_.folder(), "P03", 5).remaining.empty());
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(kept_.beside("copy") / "recordings" / "0002.sqlite"));
}

TEST_F(WithdrawalTest, SomebodyUnknownIsAnErrorAndChangesNothing) {
  EXPECT_THROW((void)withdraw(kept_.folder(), "P09", 5), Error);
  EXPECT_TRUE(verified(kept_.folder()).complete);
}

TEST_F(WithdrawalTest, AppointmentsGoWithThePersonAlsoWhereNobodyCame) {
  (void)add_appointment(kept_.folder(), "P01", 100, 1);
  (void)add_appointment(kept_.folder(), "P08", 200, 2);
  cancel_appointment(kept_.folder(), 2, 3);
  const fs::path copy = kept_.beside("copy.study");
  (void)back_up(kept_.folder(), copy, 4);
  (void)withdraw(kept_.folder(), "P01", 5);
  for (const fs::path& folder : {kept_.folder(), copy}) {
    ASSERT_EQ(appointments(folder).size(), 1U) << folder;
    EXPECT_EQ(appointments(folder)[0].participant, "P08");
  }
  const WithdrawalReport report = withdraw(kept_.folder(), "P08", 6);
  EXPECT_TRUE(report.sessions.empty());
  EXPECT_EQ(report.backups, std::vector<fs::path>{copy});
  EXPECT_TRUE(appointments(kept_.folder()).empty());
  EXPECT_TRUE(appointments(copy).empty());
  EXPECT_TRUE(verified(kept_.folder()).complete);
  EXPECT_NO_THROW((void)withdraw(kept_.folder(), "P08", 7)) << "as often as one likes";
}

TEST_F(WithdrawalTest, WhoReadANoteIsForgottenWithItAndOfAnAdverseEventIsKept) {
  {
    StudyStore store(kept_.folder(), StudyStore::Mode::kReadWrite, Durability::kAtClose);
    store.add_adverse_event(1, 7, "a pinched finger");
  }
  acknowledge(kept_.folder(), {.session = 1, .sequence = 6}, 8);
  acknowledge(kept_.folder(), {.adverse_event = 1}, 9);
  ASSERT_EQ(acknowledgements(kept_.folder()).size(), 2U);
  (void)withdraw(kept_.folder(), "P01", 10);
  const std::vector<Acknowledgement> left = acknowledgements(kept_.folder());
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].what.adverse_event, 1);
}

TEST_F(WithdrawalTest, NotWhileASessionRuns) {
  const StudyStore running(kept_.folder(), StudyStore::Mode::kReadWrite);
  EXPECT_THROW((void)withdraw(kept_.folder(), "P01", 5), Error);
  EXPECT_EQ(running.sessions().size(), 2U);
}

}  // namespace withdrawal_test
}  // namespace jnd::core
