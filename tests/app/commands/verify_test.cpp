#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/tiny_study.h"
#include "core/storage/database.h"
#include "support/program.h"

namespace jnd::app {
namespace verify_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class VerifyCommandTest : public CommandTest {
 protected:
  VerifyCommandTest() {
    write_file(temporary_.path() / "tiny.json", kTinyStudy);
    EXPECT_EQ(
        jnd({"simulate", "tiny.json", "--participants", "2", "--study", "a.study"}).exit_code,
        0);
  }
  nlohmann::json verified(int exit_code) {
    const ProgramOutcome outcome = jnd({"verify", "a.study", "--json"});
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
    return document(outcome.out);
  }
  /// Damages one byte in the middle of the file, and every 512th byte from there on.
  static void damage(const fs::path& file) {
    std::string bytes = read_file(file);
    for (std::size_t at = bytes.size() / 2; at < bytes.size(); at += 512) bytes[at] ^= '\x55';
    write_file(file, bytes);
  }
  [[nodiscard]] fs::path in_study(const char* name) const {
    return temporary_.path() / "a.study" / name;
  }
};

TEST_F(VerifyCommandTest, AWholeStudyIsComplete) {
  const auto json = verified(0);
  EXPECT_EQ(json["complete"], true);
  EXPECT_TRUE(json["problems"].empty());
  EXPECT_EQ(json["num_sessions"], 2);
  EXPECT_EQ(json["num_trials"], 2 * kTinyTrials);
  EXPECT_NE(jnd({"verify", "a.study"}).out.find(": complete"), std::string::npos);
}

TEST_F(VerifyCommandTest, ADamagedRecordingIsNamedWithItsSession) {
  damage(in_study("recordings/0002.sqlite"));
  const auto json = verified(1);
  EXPECT_EQ(json["complete"], false);
  ASSERT_FALSE(json["problems"].empty());
  for (const auto& problem : json["problems"]) EXPECT_EQ(problem["session"], 2) << problem;
  const ProgramOutcome plain = jnd({"verify", "a.study"});
  EXPECT_EQ(plain.exit_code, 1);
  EXPECT_NE(plain.out.find("NOT complete"), std::string::npos);
  EXPECT_NE(plain.out.find("problem: session 2: "), std::string::npos) << plain.out;
}

TEST_F(VerifyCommandTest, ADeletedRecordingIsNamedWithItsSession) {
  fs::remove(in_study("recordings/0001.sqlite"));
  const auto json = verified(1);
  ASSERT_EQ(json["problems"].size(), 1U);
  EXPECT_EQ(json["problems"][0]["session"], 1);
}

TEST_F(VerifyCommandTest, ADamagedDatabaseIsAFindingNotAFault) {
  damage(in_study("study.sqlite"));
  const auto json = verified(1);
  EXPECT_EQ(json["complete"], false);
  EXPECT_FALSE(json["problems"].empty());
  write_file(in_study("study.sqlite"), "nothing like a database at all");
  EXPECT_EQ(verified(1)["complete"], false);
  fs::remove(in_study("study.sqlite"));
  EXPECT_EQ(verified(1)["complete"], false);
}

TEST_F(VerifyCommandTest, RowsAndEventsThatDisagreeAreFound) {
  const std::string sound = read_file(in_study("study.sqlite"));
  for (const char* damage :
       {"UPDATE trial SET response = response + 1 WHERE session = 2 AND trial = 1",
        "UPDATE presentation SET intensity = 7 WHERE session = 2 AND trial = 1",
        "UPDATE presentation SET interval = 'tes4' WHERE session = 2 AND trial = 1",
        "UPDATE design SET intensity = 7 WHERE session = 2 AND trial = 1",
        "UPDATE event SET kind = 'trial_answereD' WHERE session = 2 AND kind = "
        "'trial_answered'",
        "UPDATE event SET data = '{' WHERE session = 2 AND kind = 'presentation_ended'",
        "UPDATE protocol SET text = replace(text, 'tiny', 'tinz')"}) {
    {
      core::Database database(in_study("study.sqlite"), core::Database::Mode::kReadWrite,
                              core::Durability::kEveryCommit);
      for (const char* guard : {"trial", "presentation", "design", "event", "protocol"}) {
        database.execute("DROP TRIGGER " + std::string(guard) + "_is_final");
      }
      database.execute(damage);
    }
    const auto json = verified(1);
    EXPECT_FALSE(json["problems"].empty()) << damage;
    write_file(in_study("study.sqlite"), sound);
  }
}

TEST_F(VerifyCommandTest, AnInterruptedBeginningIsRolledBackByWhoeverLooks) {
  // Leaves a rollback journal, as a program does that died before it could remove it.
  const fs::path file = temporary_.path() / "a.study" / "study.sqlite";
  const pid_t child = ::fork();
  if (child == 0) {
    core::Database database(file, core::Database::Mode::kReadWrite,
                            core::Durability::kEveryCommit);
    database.execute("PRAGMA journal_mode = DELETE");
    database.execute("PRAGMA cache_size = 1");
    database.execute("BEGIN EXCLUSIVE");
    for (int table = 0; table < 50; ++table) {
      database.execute("CREATE TABLE t" + std::to_string(table) + " AS SELECT * FROM event");
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(fs::exists(file.string() + "-journal"));
  EXPECT_EQ(verified(0)["complete"], true);
}

TEST_F(VerifyCommandTest, ChangesNothing) {
  const std::string database = read_file(in_study("study.sqlite"));
  const std::string recording = read_file(in_study("recordings/0001.sqlite"));
  (void)verified(0);
  EXPECT_EQ(read_file(in_study("study.sqlite")), database);
  EXPECT_EQ(read_file(in_study("recordings/0001.sqlite")), recording);
}

}  // namespace verify_test
}  // namespace jnd::app
