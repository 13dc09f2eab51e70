#include <gtest/gtest.h>

#include <csignal>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "support/program.h"

namespace jnd::app {
namespace backup_test {

using test_support::ProgramOutcome;
using test_support::RunningProgram;

class BackupCommandTest : public CommandTest {
 protected:
  BackupCommandTest() { write_file(temporary_.path() / "tiny.json", kTinyStudy); }
  void simulate() {
    ASSERT_EQ(jnd({"simulate", "tiny.json", "--participants", "2", "--study", "a.study",
                   "--seed", "7"})
                  .exit_code,
              0);
  }
};

TEST_F(BackupCommandTest, TheCopyGivesTheSameResults) {
  simulate();
  const ProgramOutcome out = jnd({"backup", "a.study", "--to", "safe/copy", "--json"});
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const auto told = document(out.out);
  EXPECT_EQ(told["complete"], true);
  EXPECT_EQ(told["num_sessions"], 2);
  EXPECT_GT(told["num_chunks_copied"], 0);
  EXPECT_EQ(jnd({"verify", "safe/copy"}).exit_code, 0);
  EXPECT_EQ(difference(tables_text(opened("safe/copy"), 2), tables_text(opened("a.study"), 2)),
            "");
  EXPECT_EQ(
      difference(samples_text(opened("safe/copy"), 1), samples_text(opened("a.study"), 1)), "");
  EXPECT_EQ(
      document(
          jnd({"backup", "a.study", "--to", "safe/copy", "--json"}).out)["num_chunks_copied"],
      0);
}

TEST_F(BackupCommandTest, ASessionThatDiedGoesOnInWhatIsMadeOfItsBackup) {
  {
    RunningProgram child({"run", "tiny.json", "--study", "a.study", "--participant", "P01",
                          "--headless", "--seed", "7", "--acknowledge"},
                         options_);
    for (int line = 0; line < 30; ++line) ASSERT_TRUE(child.read_line());
    // The backup is taken while the session runs, and again after it was killed.
    EXPECT_EQ(jnd({"backup", "a.study", "--to", "copy"}).exit_code, 0);
    child.send_signal(SIGKILL);
    (void)child.wait();
  }
  EXPECT_EQ(jnd({"backup", "a.study", "--to", "copy"}).exit_code, 0);
  for (const std::vector<std::string>& write :
       {std::vector<std::string>{"resume", "copy", "--headless"},
        {"run", "tiny.json", "--study", "copy", "--participant", "P02", "--headless"},
        {"simulate", "tiny.json", "--study", "copy", "--participants", "1"}}) {
    const ProgramOutcome refused = jnd(write);
    EXPECT_EQ(refused.exit_code, 1) << write[0];
    EXPECT_NE(refused.err.find("jnd restore copy"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(jnd({"restore", "copy", "--to", "b.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"resume", "b.study", "--headless"}).exit_code, 0);
  EXPECT_TRUE(opened("b.study").completed(1));
  EXPECT_EQ(jnd({"verify", "b.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"backup", "b.study", "--to", "copy"}).exit_code, 0);
  EXPECT_EQ(jnd({"restore", "copy", "--to", "b.study"}).exit_code, 1);
}

TEST_F(BackupCommandTest, WritesOverNothing) {
  simulate();
  write_file(temporary_.path() / "notes.txt", "mine");
  const ProgramOutcome out = jnd({"backup", "a.study", "--to", "."});
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_NE(out.err.find("found other files in it"), std::string::npos) << out.err;
  EXPECT_EQ(jnd({"backup", "a.study", "--to", "a.study"}).exit_code, 1);
  EXPECT_EQ(jnd({"backup", "a.study"}).exit_code, 2);
  EXPECT_EQ(jnd({"backup", "none.study", "--to", "copy"}).exit_code, 2);
}

TEST_F(BackupCommandTest, WithdrawDeletesHereAndInTheBackup) {
  simulate();
  ASSERT_EQ(jnd({"backup", "a.study", "--to", "copy"}).exit_code, 0);
  const ProgramOutcome out = jnd({"withdraw", "a.study", "--participant", "P01", "--json"});
  ASSERT_EQ(out.exit_code, 0) << out.err;
  const auto told = document(out.out);
  EXPECT_EQ(told["sessions"], nlohmann::json({1}));
  EXPECT_EQ(told["backups"].size(), 1U);
  EXPECT_TRUE(told["remaining"].empty());
  for (const char* study : {"a.study", "copy"}) {
    EXPECT_EQ(opened(study).sessions().size(), 1U);
    EXPECT_FALSE(std::filesystem::exists(opened(study).recording_file(1)));
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
  }
  EXPECT_EQ(jnd({"results", "a.study"}).exit_code, 0);
  // The program does not give the pseudonym to another person.
  const ProgramOutcome again = jnd({"run", "tiny.json", "--study", "a.study", "--participant",
                                    "P01", "--headless", "--seed", "7"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(
      jnd({"simulate", "tiny.json", "--participants", "1", "--study", "a.study", "--seed", "7"})
          .exit_code,
      0);
  EXPECT_EQ(opened("a.study").sessions().back().participant, "P03");
  EXPECT_EQ(jnd({"withdraw", "a.study", "--participant", "P09"}).exit_code, 1);
}

TEST_F(BackupCommandTest, WithdrawSaysWhichBackupItCouldNotReach) {
  simulate();
  ASSERT_EQ(jnd({"backup", "a.study", "--to", "copy"}).exit_code, 0);
  std::filesystem::rename(temporary_.path() / "copy", temporary_.path() / "unplugged");
  const ProgramOutcome out = jnd({"withdraw", "a.study", "--participant", "P01"});
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_NE(out.out.find("copy: expected a study folder"), std::string::npos) << out.out;
  EXPECT_NE(out.err.find("attach it"), std::string::npos) << out.err;
}

}  // namespace backup_test
}  // namespace jnd::app
