#include <gtest/gtest.h>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "core/storage/database.h"
#include "core/storage/export_note.h"
#include "core/storage/study_format.h"
#include "support/places.h"
#include "support/program.h"
#include "support/small_disk.h"

namespace jnd::app {
namespace noted_export_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class NotedExportTest : public CommandTest {
 protected:
  void SetUp() override {
    write_file(path("tiny.json"), kTinyStudy);
    simulate("a.study");
  }
  void simulate(const std::string& study) {
    done({"simulate", "tiny.json", "--participants", "2", "--study", study, "--seed", "7"});
  }
  void done(const std::vector<std::string>& words) {
    const ProgramOutcome outcome = jnd(words);
    ASSERT_EQ(outcome.exit_code, 0) << joined(words) << outcome.err;
  }
  void write(const std::string& kind, const std::string& out) {
    if (kind == "report") {
      done({"report", "a.study", "--out", out, "--resamples", "100"});
    } else {
      done({"export", kind, "a.study", "--out", out});
    }
  }
  ProgramOutcome withdraw(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"withdraw", "a.study", "--participant", "P01"};
    words.insert(words.end(), more.begin(), more.end());
    return jnd(words);
  }
};

TEST_F(NotedExportTest, AWithdrawalIsDoneAndNamesEveryExportUntilTheyAreGoneOrKnown) {
  const std::vector<std::string> kinds = {"bids", "csv", "hdf5", "report"};
  for (const std::string& kind : kinds) write(kind, "out/" + kind);
  const ProgramOutcome first = withdraw();
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_NE(first.out.find("1 sessions deleted here"), std::string::npos) << first.out;
  for (const std::string& kind : kinds) {
    const std::string place = fs::canonical(path("out/" + kind)).string();
    EXPECT_NE(first.out.find("not deleted: " + place + ": "), std::string::npos) << first.out;
  }
  EXPECT_EQ(sentence_flaw(first.err, {"a.study", "expected", "P01", "found 4", "out/bids",
                                      "--acknowledge-exports"}),
            "");
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);

  const ProgramOutcome known = withdraw({"--acknowledge-exports", "--json"});
  EXPECT_EQ(known.exit_code, 0) << known.err;
  const nlohmann::json told = document(known.out);
  ASSERT_EQ(told["exports"].size(), 4U);
  EXPECT_EQ(told["exports"][0]["place"], fs::canonical(path("out/bids")).string());
  EXPECT_EQ(told["exports"][0]["kind"], "bids");
  EXPECT_GT(told["exports"][0]["time_ns"], 0);
  EXPECT_EQ(known.err, "");

  EXPECT_EQ(withdraw().exit_code, 1) << "what is known is told again";
  fs::remove_all(path("out"));
  EXPECT_EQ(withdraw().exit_code, 0);
}

TEST_F(NotedExportTest, WhatIsExportedAfterwardsHoldsNobodyWhoWithdrew) {
  write("csv", "out");
  EXPECT_EQ(withdraw().exit_code, 1);
  fs::remove_all(path("out"));
  write("csv", "out");
  write("report", "report");
  const ProgramOutcome outcome = withdraw();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

TEST_F(NotedExportTest, AFolderThatNothingWasWrittenToIsNotNamed) {
  fs::create_directory(path("mine"));
  write_file(path("mine/thesis.txt"), "mine");
  EXPECT_EQ(jnd({"export", "csv", "a.study", "--out", "mine"}).exit_code, 1);
  EXPECT_EQ(jnd({"report", "a.study", "--out", "mine"}).exit_code, 1);
  EXPECT_TRUE(core::noted_exports(path("a.study")).empty());
  EXPECT_EQ(withdraw().exit_code, 0);
}

TEST_F(NotedExportTest, APilotIsInAnExportThatAskedForPilots) {
  done({"run", "tiny.json", "--study", "p.study", "--participant", "X1", "--headless",
        "--pilot", "--seed", "7"});
  done({"run", "tiny.json", "--study", "p.study", "--participant", "P01", "--headless",
        "--seed", "8"});
  done({"export", "csv", "p.study", "--out", "without"});
  done({"export", "csv", "p.study", "--out", "with", "--pilot"});
  const ProgramOutcome outcome = jnd({"withdraw", "p.study", "--participant", "X1"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("/with:"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("/without:"), std::string::npos) << outcome.out;
}

TEST_F(NotedExportTest, TheDataSetDoesNotTellWhereOthersWereWritten) {
  write("csv", "out");
  write("bids", "bids");
  core::Database copy(path("bids/sourcedata/jnd.study/study.sqlite"),
                      core::Database::Mode::kReadOnly, core::Durability::kEveryCommit);
  for (const char* table : {"export", "export_session", "withdrawal_step"}) {
    core::Statement count(copy, std::string("SELECT COUNT(*) FROM ") + table);
    ASSERT_TRUE(count.step());
    EXPECT_EQ(count.integer(0), 0) << table;
  }
}

TEST_F(NotedExportTest, AStudyOnAReadOnlyDiskIsExportedAndSaysThatItDoesNotRemember) {
  fs::create_directory(path("disk"));
  const test_support::SmallDisk disk(path("disk"), 20000);
  if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
  simulate("disk/b.study");
  ASSERT_TRUE(disk.make_read_only());
  const ProgramOutcome outcome = jnd({"export", "csv", "disk/b.study", "--out", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(
      sentence_flaw(outcome.err, {"does not remember", "out", "study.sqlite", "expected"}), "");
  EXPECT_TRUE(fs::exists(path("out/trials.csv")));
}

TEST_F(NotedExportTest, AnOlderStudyIsBroughtUpToDateToRememberAndGivesTheSameTables) {
  fs::copy(test_support::source_folder() / "tests/core/storage/layout_1", path("old.study"),
           fs::copy_options::recursive);
  done({"export", "csv", "old.study", "--out", "one"});
  done({"export", "csv", "old.study", "--out", "two"});
  EXPECT_EQ(core::noted_exports(path("old.study")).size(), 2U);
  for (const char* name : {"sessions.csv", "trials.csv", "events.csv"}) {
    EXPECT_EQ(read_file(path("one") / name), read_file(path("two") / name)) << name;
  }
}

}  // namespace noted_export_test
}  // namespace jnd::app
