#include <gtest/gtest.h>

#include "app/acknowledged.h"
#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/small_disk.h"

namespace jnd::app {
namespace full_disk_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class FullDiskTest : public CommandTest {
 protected:
  void SetUp() override {
    write_file(path("tiny.json"), kTinyStudy);
    fs::create_directory(path("disk"));
  }
  ProgramOutcome run(const std::string& study) {
    return jnd({"run", "tiny.json", "--study", study, "--participant", "P01", "--headless",
                "--seed", "7", "--acknowledge"});
  }
};

TEST_F(FullDiskTest, ASessionSaysSoKeepsWhatItAcknowledgedAndGoesOnOnceThereIsRoom) {
  ASSERT_EQ(run("whole.study").exit_code, 0);
  const core::StudyStore whole(path("whole.study"), core::StudyStore::Mode::kReadOnly);
  int num_in_session = 0;
  for (const int size_kib : {8, 40, 120, 200, 300, 400, 500, 560, 600}) {
    SCOPED_TRACE(size_kib);
    const test_support::SmallDisk disk(path("disk"), size_kib);
    if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
    const ProgramOutcome outcome = run("disk/a.study");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(sentence_flaw(outcome.err, {"disk/a.study", "expected"}), "");
    const std::vector<std::string> acknowledged = whole_lines_of(outcome.out);
    if (!acknowledged.empty()) {
      ++num_in_session;
      EXPECT_EQ(sentence_flaw(outcome.err, {"full", "jnd resume disk/a.study"}), "");
      // While the disk is still full, the program prints the same sentence again and damages
      // nothing.
      EXPECT_EQ(jnd({"resume", "disk/a.study", "--headless"}).exit_code, 1);
    }
    ASSERT_TRUE(disk.resize(20000));
    if (acknowledged.empty()) {
      ProgramOutcome again = jnd({"resume", "disk/a.study", "--headless"});
      if (again.exit_code != 0 || again.out.find("nothing to resume") != std::string::npos) {
        again = run("disk/a.study");
      }
      EXPECT_EQ(again.exit_code, 0) << again.err;
    } else {
      EXPECT_EQ(jnd({"verify", "disk/a.study"}).exit_code, 0);
      const ProgramOutcome resumed = jnd({"resume", "disk/a.study", "--headless"});
      EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    }
    const core::StudyStore store(path("disk/a.study"), core::StudyStore::Mode::kReadOnly);
    check_acknowledged(store, acknowledged);
    EXPECT_TRUE(store.completed(1));
    EXPECT_EQ(difference(design_text(store, 1), design_text(whole, 1)), "");
    EXPECT_EQ(difference(stimuli_text(store, 1), stimuli_text(whole, 1)), "");
    EXPECT_EQ(jnd({"verify", "disk/a.study"}).exit_code, 0);
  }
  EXPECT_GE(num_in_session, 3);
}

TEST_F(FullDiskTest, WhatElseWritesSaysSoInOneSentence) {
  ASSERT_EQ(run("whole.study").exit_code, 0);
  const test_support::SmallDisk disk(path("disk"), 64);
  if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
  for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
           {"simulate", "tiny.json", "--study", "disk/s.study", "--participants", "2"},
           {"demo", "--fast", "--out", "disk/demo"},
           {"export", "csv", "whole.study", "--out", "disk/out", "--recordings"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words) << outcome.err;
    EXPECT_EQ(sentence_flaw(outcome.err, {"disk/", "expected"}), "") << joined(words);
  }
  for (int i = 0; i < 40; ++i) {
    std::ofstream(path("disk") / ("f" + std::to_string(i))) << std::string(4096, 'x');
  }
  const ProgramOutcome made = jnd({"new", "disk/mine"});
  EXPECT_EQ(made.exit_code, 1);
  EXPECT_EQ(sentence_flaw(made.err, {"disk/mine.json", "No space left"}), "");
  EXPECT_FALSE(fs::exists(path("disk/mine.json"))) << "half a study is none";
}

}  // namespace full_disk_test
}  // namespace jnd::app
