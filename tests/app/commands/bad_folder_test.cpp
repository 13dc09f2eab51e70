#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "core/storage/database.h"
#include "support/program.h"
#include "support/small_disk.h"

namespace jnd::app {
namespace bad_folder_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class BadFolderTest : public CommandTest {
 protected:
  void SetUp() override { write_file(path("tiny.json"), kTinyStudy); }

  ProgramOutcome run(const std::string& study, const std::string& participant) {
    return jnd({"run", "tiny.json", "--study", study, "--participant", participant,
                "--headless", "--seed", "7"});
  }
  void make_session(const std::string& study = "a.study") {
    ASSERT_EQ(run(study, "P01").exit_code, 0);
  }

  /// Expects that each command that opens the folder exits with 1 and prints one sentence with
  /// these parts. Also expects that `verify` lists the problem.
  void expect_refused(const std::string& study, const std::vector<std::string>& parts) {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"results", study},
             {"resume", study, "--headless"},
             {"export", "csv", study, "--out", "out"},
             {"plan", "tiny.json", "--study", study},
             {"run", "tiny.json", "--study", study, "--participant", "P02", "--headless"},
             {"simulate", "tiny.json", "--study", study, "--participants", "1"}}) {
      const ProgramOutcome outcome = jnd(words);
      EXPECT_EQ(outcome.exit_code, 1) << joined(words) << '\n' << outcome.err;
      EXPECT_EQ(outcome.out, "") << joined(words);
      EXPECT_EQ(sentence_flaw(outcome.err, parts), "") << joined(words);
    }
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"results", study, "--json"}, {"plan", "tiny.json", "--study", study, "--json"}}) {
      const ProgramOutcome outcome = jnd(words);
      EXPECT_EQ(outcome.exit_code, 1) << joined(words);
      EXPECT_TRUE(document(outcome.out)["error"].is_string()) << joined(words);
    }
    expect_found(study, parts);
  }

  /// Expects that `verify` finds a problem whose sentence contains these parts.
  void expect_found(const std::string& study, const std::vector<std::string>& parts) {
    const ProgramOutcome outcome = jnd({"verify", study, "--json"});
    EXPECT_EQ(outcome.exit_code, 1);
    const auto json = document(outcome.out);
    EXPECT_EQ(json["complete"], false);
    ASSERT_FALSE(json["problems"].empty());
    const std::string message = json["problems"][0]["message"];
    EXPECT_EQ(sentence_flaw("jnd: " + message + "\n", parts), "");
    const ProgramOutcome plain = jnd({"verify", study});
    EXPECT_EQ(plain.exit_code, 1);
    EXPECT_NE(plain.out.find("NOT complete"), std::string::npos) << plain.out;
  }

  void flip_bytes(const fs::path& file, double where, int count) {
    std::string bytes = read_file(file);
    const auto at = static_cast<std::size_t>(where * static_cast<double>(bytes.size()));
    for (int i = 0; i < count; ++i) bytes[at + i] = static_cast<char>(~bytes[at + i]);
    write_file(file, bytes);
  }
};

TEST_F(BadFolderTest, AFolderWithoutAStudyIsToldAsSuch) {
  fs::create_directory(path("empty.study"));
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"results", "empty.study"},
           {"resume", "empty.study"},
           {"export", "csv", "empty.study", "--out", "out"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words);
    EXPECT_EQ(sentence_flaw(outcome.err, {"empty.study", "no study.sqlite"}), "");
  }
  expect_found("empty.study", {"empty.study"});
  EXPECT_TRUE(fs::is_empty(path("empty.study"))) << "looking at it leaves nothing behind";
}

TEST_F(BadFolderTest, ATextInPlaceOfTheDatabaseIsRefusedAndLeftAlone) {
  fs::create_directory(path("text.study"));
  write_file(path("text.study/study.sqlite"), "precious");
  expect_refused("text.study", {"text.study/study.sqlite", "expected a database of jnd"});
  EXPECT_EQ(read_file(path("text.study/study.sqlite")), "precious");
}

TEST_F(BadFolderTest, AFolderInPlaceOfTheDatabaseIsRefused) {
  fs::create_directories(path("folder.study/study.sqlite"));
  expect_refused("folder.study", {"folder.study/study.sqlite", "expected"});
}

TEST_F(BadFolderTest, ADatabaseOfSomethingElseIsRefused) {
  fs::create_directory(path("other.study"));
  {
    core::Database other(path("other.study/study.sqlite"), core::Database::Mode::kCreate,
                         core::Durability::kEveryCommit);
    other.execute("CREATE TABLE recipe (name TEXT)");
    other.execute("INSERT INTO recipe VALUES ('bread')");
  }
  expect_refused("other.study", {"other.study/study.sqlite", "another kind of database"});
}

TEST_F(BadFolderTest, ADatabaseOfSomethingElseIsLeftAsItWas) {
  fs::create_directory(path("other.study"));
  {
    core::Database other(path("other.study/study.sqlite"), core::Database::Mode::kCreate,
                         core::Durability::kEveryCommit);
    other.execute("PRAGMA journal_mode = DELETE");
    other.execute("CREATE TABLE recipe (name TEXT)");
  }
  const std::string before = read_file(path("other.study/study.sqlite"));
  (void)run("other.study", "P01");
  (void)jnd({"resume", "other.study", "--headless"});
  (void)jnd({"verify", "other.study"});
  EXPECT_EQ(read_file(path("other.study/study.sqlite")), before);
  EXPECT_FALSE(fs::exists(path("other.study/recordings")));
}

TEST_F(BadFolderTest, AnEmptyDatabaseIsRefusedByReadersAndFilledByASession) {
  fs::create_directory(path("new.study"));
  write_file(path("new.study/study.sqlite"), "");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"results", "new.study"}, {"export", "csv", "new.study", "--out", "out"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words);
    EXPECT_EQ(sentence_flaw(outcome.err, {"new.study/study.sqlite", "expected"}), "");
  }
  expect_found("new.study", {"new.study/study.sqlite"});
  make_session("new.study");
  EXPECT_EQ(jnd({"verify", "new.study"}).exit_code, 0);
}

TEST_F(BadFolderTest, ATruncatedDatabaseIsRefusedWherever) {
  make_session();
  for (const double ratio : {0.95, 0.5, 0.25, 0.05}) {
    SCOPED_TRACE(ratio);
    const std::string study = "cut" + std::to_string(ratio) + ".study";
    fs::copy(path("a.study"), path(study), fs::copy_options::recursive);
    const fs::path file = path(study) / "study.sqlite";
    fs::resize_file(
        file, static_cast<std::uintmax_t>(ratio * static_cast<double>(fs::file_size(file))));
    expect_found(study, {"study.sqlite"});
    const ProgramOutcome outcome = run(study, "P02");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(sentence_flaw(outcome.err, {"study.sqlite", "damaged"}), "");
  }
}

TEST_F(BadFolderTest, AStudyOfANewerProgramIsRefusedAndLeftAlone) {
  make_session();
  {
    core::Database database(path("a.study/study.sqlite"), core::Database::Mode::kReadWrite,
                            core::Durability::kEveryCommit);
    database.execute("UPDATE study_format SET version = version + 97");
  }
  const std::string before = read_file(path("a.study/study.sqlite"));
  expect_refused("a.study", {"a.study/study.sqlite", "newer jnd"});
  EXPECT_EQ(read_file(path("a.study/study.sqlite")), before);
}

TEST_F(BadFolderTest, AMissingRecordingIsFoundAndTheAnswersAreStillThere) {
  make_session();
  fs::remove(path("a.study/recordings/0001.sqlite"));
  expect_found("a.study", {"0001.sqlite", "no such file"});
  EXPECT_EQ(jnd({"results", "a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"export", "csv", "a.study", "--out", "out"}).exit_code, 0);
}

TEST_F(BadFolderTest, ARecordingThatIsNoneIsFound) {
  make_session();
  write_file(path("a.study/recordings/0001.sqlite"), "no recording");
  expect_found("a.study", {"0001.sqlite", "expected"});
}

TEST_F(BadFolderTest, ADamagedRecordingIsFoundWhereverTheDamageIs) {
  make_session();
  for (const double where : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    SCOPED_TRACE(where);
    const std::string study = "flipped" + std::to_string(where) + ".study";
    fs::copy(path("a.study"), path(study), fs::copy_options::recursive);
    flip_bytes(path(study) / "recordings/0001.sqlite", where, 8);
    expect_found(study, {"0001.sqlite", "expected", "damaged"});
    const ProgramOutcome outcome =
        jnd({"export", "csv", study, "--out", study + ".csv", "--recordings"});
    EXPECT_EQ(outcome.exit_code, 1) << "damaged samples are no data";
    EXPECT_EQ(sentence_flaw(outcome.err, {"0001.sqlite", "expected"}), "");
  }
}

TEST_F(BadFolderTest, ATruncatedRecordingIsFound) {
  make_session();
  const fs::path file = path("a.study/recordings/0001.sqlite");
  fs::resize_file(file, fs::file_size(file) / 2);
  expect_found("a.study", {"0001.sqlite"});
}

TEST_F(BadFolderTest, AChangedEventCannotBeResumedFromSilently) {
  make_session();
  {
    core::Database database(path("a.study/study.sqlite"), core::Database::Mode::kReadWrite,
                            core::Durability::kEveryCommit);
    database.execute("DROP TRIGGER event_stays");
    database.execute("DELETE FROM event WHERE sequence = 40 OR kind = 'session_completed'");
  }
  expect_found("a.study", {"expected event 40"});
  const ProgramOutcome outcome = jnd({"resume", "a.study", "--headless"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_EQ(sentence_flaw(outcome.err, {"expected event 40"}), "");
}

TEST_F(BadFolderTest, ALockedDatabaseIsToldWithinSeconds) {
  make_session();
  core::Database holder(path("a.study/study.sqlite"), core::Database::Mode::kReadWrite,
                        core::Durability::kEveryCommit);
  holder.execute("PRAGMA locking_mode = EXCLUSIVE");
  holder.execute("BEGIN EXCLUSIVE");
  holder.execute("CREATE TABLE held (word TEXT)");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"results", "a.study"},
           {"run", "tiny.json", "--study", "a.study", "--participant", "P02", "--headless"}}) {
    const auto start = std::chrono::steady_clock::now();
    const ProgramOutcome outcome = jnd(words);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    EXPECT_EQ(outcome.exit_code, 1) << joined(words);
    EXPECT_EQ(sentence_flaw(outcome.err, {"a.study/study.sqlite", "locked"}), "");
  }
}

TEST_F(BadFolderTest, AReadOnlyDiskCanBeReadAndRefusesSessionsInOneSentence) {
  fs::create_directory(path("disk"));
  const test_support::SmallDisk disk(path("disk"), 20000);
  if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
  make_session("disk/a.study");
  ASSERT_TRUE(disk.make_read_only());
  EXPECT_EQ(jnd({"verify", "disk/a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"results", "disk/a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"export", "csv", "disk/a.study", "--out", "out"}).exit_code, 0);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"resume", "disk/a.study", "--headless"},
           {"run", "tiny.json", "--study", "disk/a.study", "--participant", "P02",
            "--headless"},
           {"run", "tiny.json", "--study", "disk/b.study", "--participant", "P02",
            "--headless"},
           {"simulate", "tiny.json", "--study", "disk/b.study", "--participants", "1"},
           {"new", "disk/mine"},
           {"export", "csv", "disk/a.study", "--out", "disk/out"},
           {"demo", "--fast", "--out", "disk/demo"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words) << outcome.err;
    EXPECT_EQ(sentence_flaw(outcome.err, {"disk/", "expected", "Read-only"}), "");
  }
}

TEST_F(BadFolderTest, AnInterruptedStudyOnAReadOnlyDiskCanStillBeVerified) {
  fs::create_directory(path("disk"));
  const test_support::SmallDisk disk(path("disk"), 20000);
  if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
  {
    test_support::RunningProgram child({"run", "tiny.json", "--study", "disk/a.study",
                                        "--participant", "P01", "--headless", "--acknowledge"},
                                       options_);
    for (int line = 0; line < 30; ++line) ASSERT_TRUE(child.read_line());
    child.send_signal(9);
    ASSERT_EQ(child.wait().signal, 9);
  }
  ASSERT_TRUE(disk.make_read_only());
  const ProgramOutcome outcome = jnd({"verify", "disk/a.study"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

}  // namespace bad_folder_test
}  // namespace jnd::app
