#include "core/storage/export_note.h"

#include <gtest/gtest.h>

#include "core/storage/backup.h"
#include "core/storage/database.h"
#include "core/storage/kept_study.h"
#include "core/storage/old_study.h"
#include "core/storage/study_format.h"
#include "core/storage/withdrawal.h"

namespace jnd::core {
namespace export_note_test {

namespace fs = std::filesystem;

class ExportNoteTest : public ::testing::Test {
 protected:
  ExportNoteTest() {
    kept_.add_session("P01");
    kept_.add_session("P02");
  }
  /// Does what an export does: it is noted first and then written.
  void write(const std::string& name, const std::vector<std::int64_t>& sessions,
             const fs::path& folder) {
    note_export(folder, {.place = kept_.beside(name),
                         .kind = "csv",
                         .time_ns = ++time_ns_,
                         .sessions = sessions});
    fs::create_directories(kept_.beside(name));
    std::ofstream(kept_.beside(name) / "trials.csv") << "P01";
  }
  void write(const std::string& name, const std::vector<std::int64_t>& sessions) {
    write(name, sessions, kept_.folder());
  }
  /// Returns the names of the places that a withdrawal reports.
  std::vector<std::string> named(const std::string& participant) {
    std::vector<std::string> names;
    for (const ExportNote& one : withdraw(kept_.folder(), participant, ++time_ns_).exports) {
      names.push_back(one.place.filename());
    }
    return names;
  }
  using Names = std::vector<std::string>;

  KeptStudy kept_;
  std::int64_t time_ns_ = 0;
};

TEST_F(ExportNoteTest, AWithdrawalNamesThePlacesThatHoldThePersonAgainUntilTheyAreGone) {
  write("first", {1, 2});
  write("second", {1});
  write("others", {2});
  EXPECT_EQ(named("P01"), (Names{"first", "second"}));
  fs::remove_all(kept_.beside("first"));
  EXPECT_EQ(named("P01"), Names{"second"});
  fs::remove(kept_.beside("second") / "trials.csv");
  EXPECT_EQ(named("P01"), Names{}) << "an empty folder holds nobody";
}

TEST_F(ExportNoteTest, WhatIsWrittenAfterTheWithdrawalIsCleanAlsoWhereItHeldThePersonBefore) {
  write("again", {1, 2});
  write("before", {1, 2});
  EXPECT_EQ(named("P01"), (Names{"again", "before"}));
  fs::remove_all(kept_.beside("again"));
  write("again", {2});
  write("after", {2});
  EXPECT_EQ(named("P01"), Names{"before"});
  EXPECT_EQ(named("P02"), (Names{"after", "again", "before"}));
}

TEST_F(ExportNoteTest, WhatAnInterruptedExportLeftBesideItsPlaceIsNamed) {
  note_export(kept_.folder(),
              {.place = kept_.beside("cut"), .kind = "csv", .time_ns = 1, .sessions = {1}});
  EXPECT_EQ(named("P01"), Names{});
  fs::create_directory(kept_.beside("cut.unfinished-Ab12Cd"));
  fs::create_directory(kept_.beside("other.unfinished-Ab12Cd"));
  EXPECT_EQ(named("P01"), Names{"cut.unfinished-Ab12Cd"});
  EXPECT_EQ(named("P02"), Names{});
  // The place itself is written anew, without the person; what the interrupted export left is
  // still there.
  write("cut", {2});
  EXPECT_EQ(named("P01"), Names{"cut.unfinished-Ab12Cd"});
}

TEST_F(ExportNoteTest, APlaceIsRememberedWhereItIsNotAsItWasCalled) {
  fs::create_directory(kept_.beside("real"));
  fs::create_directory_symlink("real", kept_.beside("link"));
  note_export(kept_.folder(), {.place = kept_.beside("link") / "." / "out" / "",
                               .kind = "bids",
                               .time_ns = 1,
                               .sessions = {1}});
  const std::vector<ExportNote> notes = noted_exports(kept_.folder());
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].place, fs::canonical(kept_.beside("real")) / "out");
  EXPECT_EQ(notes[0].kind, "bids");
  EXPECT_EQ(notes[0].time_ns, 1);
  EXPECT_EQ(notes[0].sessions, std::vector<std::int64_t>{1});
}

TEST_F(ExportNoteTest, WhatWasExportedFromABackupIsNamedAlsoOnceTheBackupIsBroughtUpToDate) {
  (void)back_up(kept_.folder(), kept_.beside("copy"), ++time_ns_);
  write("of_copy", {1, 2}, kept_.beside("copy"));
  EXPECT_EQ(named("P02"), Names{"of_copy"});
  (void)back_up(kept_.folder(), kept_.beside("copy"), ++time_ns_);
  ASSERT_EQ(noted_exports(kept_.beside("copy")).size(), 1U);
  EXPECT_EQ(named("P01"), Names{"of_copy"});
  (void)back_up(kept_.folder(), kept_.beside("copy"), ++time_ns_);
  EXPECT_EQ(noted_exports(kept_.folder()).size(), 1U) << "taken over once";
}

TEST_F(ExportNoteTest, TheBackupsOldWordOfAPlaceDoesNotStandAgainstTheStudysNewOne) {
  (void)back_up(kept_.folder(), kept_.beside("copy"), ++time_ns_);
  write("out", {1, 2}, kept_.beside("copy"));
  fs::rename(kept_.beside("copy"), kept_.beside("unplugged"));
  EXPECT_EQ(named("P01"), Names{}) << "nobody knows of it";
  fs::remove_all(kept_.beside("out"));
  write("out", {2});
  fs::rename(kept_.beside("unplugged"), kept_.beside("copy"));
  EXPECT_EQ(named("P01"), Names{});
}

TEST_F(ExportNoteTest, NotesAreNeitherChangedNorDeleted) {
  write("out", {1});
  Database database(kept_.folder() / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kAtClose);
  for (const char* table : {"export", "export_session", "withdrawal_step"}) {
    if (std::string(table) == "withdrawal_step") {
      database.execute(
          "INSERT INTO withdrawal_step (participant, state, time_ns) VALUES ('P09', 'begun', "
          "1)");
    }
    EXPECT_THROW(database.execute(std::string("DELETE FROM ") + table), Error) << table;
  }
  EXPECT_THROW(database.execute("UPDATE export SET place = ''"), Error);
  EXPECT_THROW(database.execute("UPDATE export_session SET session = 7"), Error);
  EXPECT_THROW(database.execute("UPDATE withdrawal_step SET state = 'finished'"), Error);
}

TEST_F(ExportNoteTest, AnOlderStudyLearnsToRemember) {
  const fs::path old = kept_.beside("old");
  copy_old_study(1, old);
  EXPECT_TRUE(noted_exports(old).empty());
  note_export(old,
              {.place = kept_.beside("out"), .kind = "csv", .time_ns = 1, .sessions = {1}});
  EXPECT_EQ(noted_exports(old).size(), 1U);
}

TEST_F(ExportNoteTest, APlaceIsFreeWhereNothingIsOrAnEmptyFolder) {
  EXPECT_TRUE(is_free_place(kept_.beside("none")));
  EXPECT_TRUE(is_free_place(kept_.beside("none") / "below"));
  fs::create_directory(kept_.beside("empty"));
  EXPECT_TRUE(is_free_place(kept_.beside("empty")));
  std::ofstream(kept_.beside("file")) << "x";
  EXPECT_FALSE(is_free_place(kept_.beside("file")));
  EXPECT_FALSE(is_free_place(kept_.folder()));
}

}  // namespace export_note_test
}  // namespace jnd::core
