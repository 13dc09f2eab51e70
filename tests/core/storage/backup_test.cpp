#include "core/storage/backup.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/storage/backup_mark.h"
#include "core/storage/database.h"
#include "core/storage/kept_study.h"
#include "core/storage/old_study.h"
#include "core/storage/schedule.h"
#include "core/storage/withdrawal.h"
#include "support/files.h"

namespace jnd::core {
namespace backup_test {

namespace fs = std::filesystem;
using test_support::read_file;

class BackupTest : public ::testing::Test {
 protected:
  BackupTest() { kept_.add_session("P01"); }
  [[nodiscard]] fs::path copy() const { return kept_.beside("copy"); }
  BackupReport back_up_now() { return back_up(kept_.folder(), copy(), ++time_ns_); }

  KeptStudy kept_;
  std::int64_t time_ns_ = 0;
};

TEST_F(BackupTest, ACopyIsAStudyFolderWithEverythingInIt) {
  const BackupReport report = back_up_now();
  EXPECT_TRUE(report.integrity.complete);
  EXPECT_EQ(report.integrity.num_events, 7);
  EXPECT_EQ(report.integrity.num_samples, 1000);
  EXPECT_TRUE(report.remarks.empty());
  const StudyStore study(kept_.folder(), StudyStore::Mode::kReadOnly);
  const StudyStore store(copy(), StudyStore::Mode::kReadOnly);
  EXPECT_EQ(store.study_id(), study.study_id());
  EXPECT_EQ(store.sessions().at(0).participant, "P01");
  EXPECT_EQ(store.events(1).size(), study.events(1).size());
  EXPECT_EQ(store.answers(1).at(0).answer, "secret of P01");
}

TEST_F(BackupTest, OfRecordingsOnlyWhatIsNewIsCopied) {
  const BackupReport first = back_up_now();
  EXPECT_EQ(first.num_chunks_copied, first.num_chunks);
  EXPECT_EQ(back_up_now().num_chunks_copied, 0);
  kept_.add_session("P02");
  KeptStudy::record(kept_.recording(1), 1000, 1999);
  const BackupReport third = back_up_now();
  EXPECT_EQ(third.num_chunks_copied, 2);
  EXPECT_EQ(third.num_chunks, 3);
  EXPECT_EQ(third.integrity.num_samples, 3000);
  EXPECT_TRUE(third.integrity.complete);
}

TEST_F(BackupTest, WorksWhileAnotherProgramWrites) {
  const StudyStore writer(kept_.folder(), StudyStore::Mode::kReadWrite);
  EXPECT_TRUE(back_up_now().integrity.complete);
}

TEST_F(BackupTest, IsForItsOwnerAlone) {
  (void)back_up_now();
  for (const auto& entry : fs::recursive_directory_iterator(copy())) {
    EXPECT_EQ(entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all),
              fs::perms::none)
        << entry.path();
  }
}

TEST_F(BackupTest, WritesOverNothingButAnEarlierCopyOfTheSameStudy) {
  fs::create_directory(copy());
  std::ofstream(copy() / "thesis.txt") << "mine";
  EXPECT_THROW((void)back_up_now(), Error);
  EXPECT_EQ(read_file(copy() / "thesis.txt"), "mine");
  fs::remove(copy() / "thesis.txt");
  EXPECT_NO_THROW((void)back_up_now());

  const KeptStudy other;
  other.add_session("P09");
  const std::string before = read_file(copy() / "study.sqlite");
  EXPECT_THROW((void)back_up(other.folder(), copy(), 1), Error);
  EXPECT_EQ(read_file(copy() / "study.sqlite"), before);
  EXPECT_THROW((void)back_up(kept_.folder(), kept_.folder(), 1), Error);
  EXPECT_THROW((void)back_up(kept_.beside("none"), kept_.beside("copy2"), 1), Error);
  EXPECT_FALSE(fs::exists(kept_.beside("copy2")));
}

TEST_F(BackupTest, ACopyThatHoldsMoreThanTheStudyIsLeftAsItIs) {
  (void)back_up_now();
  kept_.add_session("P02");
  (void)withdraw(kept_.folder(), "P01", 5);
  // With the arguments the wrong way round, P02 and the withdrawal would be undone.
  const std::string before = read_file(kept_.folder() / "study.sqlite");
  try {
    (void)back_up(copy(), kept_.folder(), 9);
    FAIL() << "overwritten";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("that the study does not have"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(read_file(kept_.folder() / "study.sqlite"), before);

  // Somebody uses this backup as a study, and its last session goes on there.
  kept_.add_session("P03");
  (void)back_up(kept_.folder(), kept_.beside("second"), 10);
  fs::remove(kept_.beside("second") / kBackupMark);
  forget_backup(kept_.beside("second"), kept_.beside("second"), 10);
  {
    StudyStore store(kept_.beside("second"), StudyStore::Mode::kReadWrite);
    store.append({.event = {.session = 3, .sequence = 8, .kind = "note_added"}});
  }
  EXPECT_THROW((void)back_up(kept_.folder(), kept_.beside("second"), 11), Error);
}

/// Of a study whose only difference to its copy is what `change` did to it.
void expect_the_copy_is_refused_as_source(const KeptStudy& kept, const fs::path& copy,
                                          const std::string& found,
                                          const std::function<void(StudyStore&)>& change) {
  {
    StudyStore store(kept.folder(), StudyStore::Mode::kReadWrite);
    change(store);
  }
  const std::string before = read_file(kept.folder() / "study.sqlite");
  try {
    (void)back_up(copy, kept.folder(), 9);
    ADD_FAILURE() << "overwritten: " << found;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found " + found + " that the study does not"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(read_file(kept.folder() / "study.sqlite"), before);
  EXPECT_NO_THROW((void)back_up(kept.folder(), copy, 9)) << "the right way round";
}

TEST_F(BackupTest, TheWrongWayRoundOverwritesNoRowThatTheCopyLacks) {
  (void)back_up_now();
  const auto expect_refused = [this](const std::string& found,
                                     const std::function<void(StudyStore&)>& change) {
    expect_the_copy_is_refused_as_source(kept_, copy(), found, change);
  };
  expect_refused("an adverse event",
                 [](StudyStore& store) { store.add_adverse_event(1, 5, "a fright"); });
  expect_refused("a look at the study", [](StudyStore& store) {
    store.add_look({.look = 1, .decision = "go_on", .sessions = {1}});
  });
  expect_refused("an unsealing", [](StudyStore& store) {
    store.add_unsealing({.time_ns = 6, .num_complete = 1, .reason = "a visit"});
  });
  expect_refused("an unblinding",
                 [](StudyStore& store) { store.add_unblinding(7, "a visit"); });
  expect_refused("a study file",
                 [](StudyStore& store) { (void)store.add_protocol("y.json", "{ }"); });
  expect_refused("a session", [](StudyStore& store) {
    (void)store.add_session(
        {.participant = "P08", .protocol_sha256 = store.protocols()[0].sha256});
  });
}

TEST_F(BackupTest, ATableThatALaterLayoutBringsIsComparedToo) {
  const std::string table =
      "CREATE TABLE z_rating (session INTEGER NOT NULL, participant TEXT, words TEXT)";
  const auto in = [](const fs::path& folder, const std::string& sql) {
    Database(folder / "study.sqlite", Database::Mode::kReadWrite, Durability::kAtClose)
        .execute(sql);
  };
  in(kept_.folder(), table);
  (void)back_up_now();
  in(copy(), "INSERT INTO z_rating VALUES (1, 'P01', 'firm')");
  try {
    (void)back_up_now();
    FAIL() << "replaced a copy with a row that the study lacks";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found a z rating that the study does not have"),
              std::string::npos)
        << error.what();
  }
  in(kept_.folder(), "INSERT INTO z_rating VALUES (1, 'P01', 'firm')");
  EXPECT_NO_THROW((void)back_up_now());
}

TEST_F(BackupTest, ACopyOfSomebodyWhoWithdrewSinceIsStillAnEarlierOne) {
  add_appointment(kept_.folder(), "P07", 1000, 5);
  (void)back_up_now();
  fs::rename(copy(), kept_.beside("away"));
  (void)withdraw(kept_.folder(), "P01", 6);
  (void)withdraw(kept_.folder(), "P07", 7);
  fs::rename(kept_.beside("away"), copy());
  EXPECT_NO_THROW((void)back_up_now());
}

TEST_F(BackupTest, ALaterCopyKnowsWhichTicksNeverRanAndTheFormatOfItsChunks) {
  (void)back_up_now();
  {
    RecordingWriter writer(kept_.recording(1), 1000.0, Durability::kAtClose);
    Sample sample;
    sample.tick = 1010;
    sample.num_missed_before = 10;
    sample.monotonic_ns = 5'000'000;
    writer.append(sample);
    writer.flush();
  }
  const BackupReport report = back_up_now();
  EXPECT_TRUE(report.integrity.complete);
  const RecordingReader study(kept_.recording(1));
  const RecordingReader later(copy() / "recordings" / "0001.sqlite");
  ASSERT_EQ(study.missed().size(), 1U);
  EXPECT_EQ(later.missed(), study.missed());
  EXPECT_TRUE(later.has_times());
  EXPECT_EQ(later.missing_ticks(), study.missing_ticks());
}

TEST_F(BackupTest, ARecordingOfANewerFormatIsRefused) {
  (void)back_up_now();
  {
    Database recording(kept_.recording(1), Database::Mode::kReadWrite,
                       Durability::kEveryCommit);
    recording.execute("UPDATE recording_format SET version = 99");
  }
  try {
    (void)back_up_now();
    ADD_FAILURE() << "copied";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found 99; open it with a newer jnd"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(BackupTest, AnEarlierCopyStaysWholeWhenALaterOneFails) {
  (void)back_up_now();
  kept_.add_session("P02");
  // The recording of the second session cannot be copied, because a folder is in its place.
  fs::create_directory(copy() / "recordings" / "0002.sqlite");
  EXPECT_THROW((void)back_up_now(), Error);
  fs::remove(copy() / "recordings" / "0002.sqlite");
  const StudyStore store(copy(), StudyStore::Mode::kReadOnly);
  EXPECT_EQ(store.sessions().size(), 1U);
  EXPECT_TRUE(verify(store).complete);
}

TEST_F(BackupTest, AnInterruptedOneIsToldAndTheEarlierCopyIsWhole) {
  (void)back_up_now();
  kept_.add_session("P02");
  begin_backup(copy(), ++time_ns_);
  fs::copy_file(kept_.recording(2), copy() / "recordings" / "0002.sqlite");
  {
    const StudyStore store(copy(), StudyStore::Mode::kReadOnly);
    const Integrity between = verify(store);
    EXPECT_TRUE(between.complete) << between.problems[0].message;
    ASSERT_EQ(between.remarks.size(), 1U);
    EXPECT_NE(between.remarks[0].message.find("repeat `jnd backup`"), std::string::npos);
  }
  const BackupReport report = back_up_now();
  EXPECT_TRUE(report.integrity.complete);
  EXPECT_TRUE(report.integrity.remarks.empty());
  // Without such a mark, the recording of no session is a problem.
  fs::copy_file(kept_.recording(2), copy() / "recordings" / "0009.sqlite");
  EXPECT_FALSE(verify(StudyStore(copy(), StudyStore::Mode::kReadOnly)).complete);
}

TEST_F(BackupTest, TheMarkHasTheDateOfTheCopyThatWasFinished) {
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  (void)back_up(kept_.folder(), copy(), kDay_ns);
  EXPECT_NE(read_file(copy() / kBackupMark).find("1970-01-02"), std::string::npos);
  begin_backup(copy(), 2 * kDay_ns);
  EXPECT_NE(read_file(copy() / kBackupMark).find("1970-01-02"), std::string::npos);
  EXPECT_TRUE(is_unfinished_backup(copy()));
  finish_backup(copy(), 2 * kDay_ns);
  EXPECT_NE(read_file(copy() / kBackupMark).find("1970-01-03"), std::string::npos);
  EXPECT_FALSE(is_unfinished_backup(copy()));
}

TEST_F(BackupTest, SaysWhenTheCopyIsNotWhole) {
  fs::remove(kept_.recording(1));
  const BackupReport report = back_up_now();
  EXPECT_FALSE(report.integrity.complete);
}

TEST_F(BackupTest, AStudyOfAnOlderLayoutKeepsItsIdentity) {
  const fs::path old = kept_.beside("old");
  copy_old_study(1, old);
  EXPECT_TRUE(back_up(old, copy(), 1).integrity.complete);
  EXPECT_EQ(back_up(old, copy(), 2).num_chunks_copied, 0);
}

TEST_F(BackupTest, NothingIsAddedToACopy) {
  (void)back_up_now();
  EXPECT_TRUE(is_backup(copy()));
  EXPECT_FALSE(is_backup(kept_.folder()));
  const std::string before = read_file(copy() / "study.sqlite");
  for (const StudyStore::Mode mode :
       {StudyStore::Mode::kReadWrite, StudyStore::Mode::kCreate}) {
    try {
      const StudyStore store(copy(), mode);
      ADD_FAILURE() << "a copy was opened for writing";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("jnd restore"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(read_file(copy() / "study.sqlite"), before);
  EXPECT_TRUE(back_up_now().integrity.complete);
}

TEST_F(BackupTest, ACopyWithoutItsMarkIsKnownByTheListInIt) {
  (void)back_up_now();
  fs::remove(copy() / kBackupMark);
  EXPECT_TRUE(is_backup(copy()));
  EXPECT_THROW(StudyStore(copy(), StudyStore::Mode::kReadWrite), Error);
  // The study was moved to a place where a backup had been.
  forget_backup(copy(), copy(), ++time_ns_);
  EXPECT_FALSE(is_backup(copy()));
  EXPECT_NO_THROW(StudyStore(copy(), StudyStore::Mode::kReadWrite));
}

TEST_F(BackupTest, AMovedCopyIsStillACopy) {
  (void)back_up_now();
  fs::rename(copy(), kept_.beside("moved"));
  EXPECT_TRUE(is_backup(kept_.beside("moved")));
}

TEST_F(BackupTest, OfACopyAStudyIsMadeInWhichSessionsCanBeRun) {
  (void)back_up_now();
  const fs::path restored = kept_.beside("restored");
  const BackupReport report = restore(copy(), restored, ++time_ns_);
  EXPECT_TRUE(report.integrity.complete);
  EXPECT_EQ(report.integrity.num_samples, 1000);
  EXPECT_FALSE(is_backup(restored));
  EXPECT_NO_THROW(StudyStore(restored, StudyStore::Mode::kReadWrite));
  // The copy becomes the restored study's copy, and a withdrawal reaches it.
  EXPECT_TRUE(back_up(restored, copy(), ++time_ns_).integrity.complete);
  EXPECT_EQ(withdraw(restored, "P01", ++time_ns_).backups.size(), 1U);
}

TEST_F(BackupTest, AStudyCanBeRestoredToWhereItsBackupWasOnce) {
  (void)back_up_now();
  fs::rename(copy(), kept_.beside("moved"));
  (void)restore(kept_.beside("moved"), copy(), ++time_ns_);
  EXPECT_FALSE(is_backup(copy()));
  EXPECT_TRUE(is_backup(kept_.beside("moved")));
}

TEST_F(BackupTest, RestoringWritesOverNothing) {
  (void)back_up_now();
  const std::string before = read_file(kept_.folder() / "study.sqlite");
  EXPECT_THROW((void)restore(copy(), kept_.folder(), 9), Error);
  EXPECT_THROW((void)restore(copy(), copy(), 9), Error);
  EXPECT_EQ(read_file(kept_.folder() / "study.sqlite"), before);
  // A study is no backup.
  EXPECT_THROW((void)restore(kept_.folder(), kept_.beside("restored"), 9), Error);
  EXPECT_FALSE(fs::exists(kept_.beside("restored")));
}

TEST_F(BackupTest, TheStudyKnowsWhenEachCopyWasBegunLast) {
  EXPECT_TRUE(dated_backups(kept_.folder()).empty());
  (void)back_up(kept_.folder(), copy(), 5);
  (void)back_up(kept_.folder(), kept_.beside("another"), 6);
  (void)back_up(kept_.folder(), copy(), 7);
  const std::vector<KnownBackup> known = dated_backups(kept_.folder());
  ASSERT_EQ(known.size(), 2U);
  EXPECT_EQ(known[0].folder, kept_.beside("another"));
  EXPECT_EQ(known[0].time_ns, 6);
  EXPECT_EQ(known[1].folder, copy());
  EXPECT_EQ(known[1].time_ns, 7);
}

TEST_F(BackupTest, SaysThatOneDiskHoldsBoth) { EXPECT_TRUE(back_up_now().on_one_disk); }

}  // namespace backup_test
}  // namespace jnd::core
