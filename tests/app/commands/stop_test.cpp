#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "app/acknowledged.h"
#include "app/commands/command_fixture.h"
#include "app/sentence.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "core/storage/database.h"
#include "support/program.h"

namespace jnd::app {
namespace stop_test {

using test_support::ProgramOutcome;
using test_support::RunningProgram;

/// Tests sessions that are stopped from outside, and readers of the output that go away.
class StopTest : public CommandTest {
 protected:
  void SetUp() override { write_file(temporary_.path() / "tiny.json", kTinyStudy); }

  ProgramOutcome jnd_into(const std::string& file, const std::vector<std::string>& arguments) {
    test_support::ProgramOptions options = options_;
    options.out_file = file;
    return test_support::run_program(arguments, options);
  }
  static std::vector<std::string> long_words(const std::string& study) {
    return {"run",           "magnitude_of_virtual_water",
            "--study",       study,
            "--participant", "P01",
            "--headless",    "--acknowledge"};
  }
  void expect_resumable(const std::string& study) {
    EXPECT_FALSE(opened(study).finished(1));
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
    EXPECT_EQ(jnd({"resume", study, "--headless"}).exit_code, 0);
    EXPECT_TRUE(opened(study).completed(1));
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
  }
};

TEST_F(StopTest, EverySignalToStopEndsTheSessionCleanlyAndTellsHowToGoOn) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(signal);
    const std::string study = "signal" + std::to_string(signal) + ".study";
    RunningProgram child(long_words(study), options_);
    std::vector<std::string> acknowledged;
    while (acknowledged.size() < 40) {
      const auto line = child.read_line();
      ASSERT_TRUE(line);
      acknowledged.push_back(*line);
    }
    child.send_signal(signal);
    const ProgramOutcome outcome = child.wait();
    EXPECT_EQ(outcome.signal, 0);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(sentence_flaw(outcome.err,
                            {"stopped", "`jnd resume " + study + " --session 1 --headless`"}),
              "");
    for (const std::string& line : lines_of(outcome.out)) acknowledged.push_back(line);
    EXPECT_EQ(check_acknowledged(opened(study), acknowledged), acknowledged.size());
    EXPECT_EQ(opened(study).events(1).back().kind, "paused");
    // One session is resumed to its end. The others are given up, which takes less time.
    if (signal == SIGINT) {
      expect_resumable(study);
    } else {
      EXPECT_EQ(jnd({"resume", study, "--headless", "--choose", "end"}).exit_code, 0);
      EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
    }
  }
}

TEST_F(StopTest, UnderNohupAClosedTerminalIsNoReasonToStop) {
  test_support::ProgramOptions options = options_;
  options.wrapper = {"nohup"};
  RunningProgram child({"run", "tiny.json", "--study", "a.study", "--participant", "P01",
                        "--headless", "--acknowledge"},
                       options);
  ASSERT_TRUE(child.read_line());
  child.send_signal(SIGHUP);
  EXPECT_EQ(child.wait().exit_code, 0);
  EXPECT_TRUE(opened("a.study").completed(1));
}

TEST_F(StopTest, ASignalInRealTimeStopsWithinASecondOrTwo) {
  std::vector<std::string> words = long_words("a.study");
  words.emplace_back("--realtime");
  RunningProgram child(words, options_);
  for (int line = 0; line < 2; ++line) ASSERT_TRUE(child.read_line());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto start = std::chrono::steady_clock::now();
  child.send_signal(SIGTERM);
  const ProgramOutcome outcome = child.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5))
      << "the hand was in a medium for as long";
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(StopTest, AReaderOfAcknowledgementsThatGoesAwayStopsTheSessionResumably) {
  RunningProgram child(long_words("a.study"), options_);
  std::vector<std::string> acknowledged;
  for (int line = 0; line < 20; ++line) {
    const auto text = child.read_line();
    ASSERT_TRUE(text);
    acknowledged.push_back(*text);
  }
  child.stop_reading();
  const ProgramOutcome outcome = child.wait();
  EXPECT_EQ(outcome.signal, 0) << "it died of it";
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(sentence_flaw(outcome.err, {"stdout: expected a reader", "jnd resume a.study"}),
            "");
  check_acknowledged(opened("a.study"), acknowledged);
  EXPECT_EQ(opened("a.study").events(1).back().kind, "paused");
  expect_resumable("a.study");
}

TEST_F(StopTest, AcknowledgementsThatCannotBeWrittenStopTheSessionResumably) {
  const ProgramOutcome outcome = jnd_into("/dev/full", long_words("a.study"));
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(sentence_flaw(outcome.err, {"stdout: expected", "jnd resume a.study"}), "");
  expect_resumable("a.study");
}

TEST_F(StopTest, AReaderThatHasSeenEnoughIsNoError) {
  ASSERT_EQ(
      jnd({"simulate", "tiny.json", "--participants", "2", "--study", "s.study"}).exit_code, 0);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"schema"},
           {"plan", "magnitude_of_virtual_water", "--participants", "500"},
           {"plan", "magnitude_of_virtual_water", "--participants", "500", "--json"},
           {"results", "s.study", "--json"},
           {"verify", "s.study"},
           {"--help"}}) {
    RunningProgram child(words, options_);
    child.stop_reading();
    const ProgramOutcome outcome = child.wait();
    EXPECT_EQ(outcome.signal, 0) << joined(words);
    EXPECT_EQ(outcome.exit_code, 0) << joined(words);
    EXPECT_EQ(outcome.err, "") << joined(words);
  }
}

TEST_F(StopTest, ResultsThatCannotBeWrittenAreNoResults) {
  ASSERT_EQ(
      jnd({"simulate", "tiny.json", "--participants", "2", "--study", "s.study"}).exit_code, 0);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"schema"},
           {"validate", "tiny.json"},
           {"plan", "tiny.json", "--json"},
           {"plan", "magnitude_of_virtual_water", "--participants", "500"},
           {"results", "s.study"},
           {"results", "s.study", "--json"},
           {"verify", "s.study", "--json"}}) {
    const ProgramOutcome outcome = jnd_into("/dev/full", words);
    EXPECT_EQ(outcome.exit_code, 3) << joined(words) << outcome.err;
    EXPECT_EQ(sentence_flaw(outcome.err, {"stdout: expected"}), "") << joined(words);
  }
}

TEST_F(StopTest, TwoSessionsBegunAtOnceInOneFolderAreOneSessionAndOneRefusal) {
  for (int round = 0; round < 8; ++round) {
    SCOPED_TRACE(round);
    const std::string study = "race" + std::to_string(round) + ".study";
    const auto words = [&](const char* participant) -> std::vector<std::string> {
      return {"run", "tiny.json", "--study", study, "--participant", participant, "--headless"};
    };
    RunningProgram first(words("P01"), options_);
    RunningProgram second(words("P02"), options_);
    const ProgramOutcome outcomes[] = {first.wait(), second.wait()};
    std::size_t num_done = 0;
    for (const ProgramOutcome& outcome : outcomes) {
      num_done += outcome.exit_code == 0 ? 1 : 0;
      if (outcome.exit_code == 0) continue;
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_EQ(sentence_flaw(outcome.err, {study, "expected"}), "");
    }
    // Both succeed if one was done before the other began.
    EXPECT_GE(num_done, 1U);
    EXPECT_EQ(opened(study).sessions().size(), num_done);
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
  }
}

TEST_F(StopTest, AStudyCanBeLookedAtWhileASessionRuns) {
  ASSERT_EQ(jnd({"simulate", "magnitude_of_virtual_water", "--participants", "1", "--study",
                 "a.study"})
                .exit_code,
            0);
  std::vector<std::string> words = long_words("a.study");
  words[5] = "P02";
  RunningProgram child(words, options_);
  for (int line = 0; line < 30; ++line) ASSERT_TRUE(child.read_line());
  int num_looks = 0;
  for (const std::vector<std::string>& look : std::vector<std::vector<std::string>>{
           {"verify", "a.study"},
           {"results", "a.study"},
           {"export", "csv", "a.study", "--out", "out"},
           {"plan", "magnitude_of_virtual_water", "--study", "a.study"},
           {"verify", "a.study"}}) {
    const ProgramOutcome outcome = jnd(look);
    EXPECT_EQ(outcome.exit_code, 0) << joined(look) << '\n' << outcome.err << outcome.out;
    ++num_looks;
  }
  child.send_signal(SIGTERM);
  EXPECT_EQ(child.wait().exit_code, 0);
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(StopTest, ASecondWriterIsRefusedWhateverItWants) {
  RunningProgram child(long_words("a.study"), options_);
  ASSERT_TRUE(child.read_line());
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"resume", "a.study", "--headless"},
           {"simulate", "tiny.json", "--participants", "1", "--study", "a.study"},
           {"run", "tiny.json", "--study", "a.study", "--participant", "P02", "--headless"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1) << joined(words);
    EXPECT_EQ(sentence_flaw(outcome.err, {"a.study", "another", "close it first"}), "");
  }
  child.send_signal(SIGTERM);
  EXPECT_EQ(child.wait().exit_code, 0);
}

TEST_F(StopTest, AClockThatWasSetBackDisturbsNoSession) {
  {
    RunningProgram child(long_words("a.study"), options_);
    for (int line = 0; line < 30; ++line) ASSERT_TRUE(child.read_line());
    child.send_signal(SIGKILL);
    EXPECT_EQ(child.wait().signal, SIGKILL);
  }
  {
    // The session looks as if it had begun on a computer whose clock was years ahead.
    core::Database database(temporary_.path() / "a.study/study.sqlite",
                            core::Database::Mode::kReadWrite, core::Durability::kEveryCommit);
    database.execute("DROP TRIGGER event_is_final");
    database.execute("UPDATE event SET time_ns = 4000000000000000000 + sequence");
  }
  EXPECT_EQ(jnd({"resume", "a.study", "--headless", "--realtime", "--choose", "end"}).exit_code,
            0);
  const std::vector<core::EventRow> events = opened("a.study").events(1);
  EXPECT_LT(events.back().time_ns, events.front().time_ns) << "the clock was not set back";
  EXPECT_TRUE(opened("a.study").finished(1));
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"export", "csv", "a.study", "--out", "out"}).exit_code, 0);
}

TEST_F(StopTest, OfSeveralOpenSessionsOneHasToBeNamed) {
  for (const char* participant : {"P01", "P02"}) {
    std::vector<std::string> words = long_words("a.study");
    words[5] = participant;
    RunningProgram child(words, options_);
    for (int line = 0; line < 20; ++line) ASSERT_TRUE(child.read_line());
    child.send_signal(SIGINT);
    EXPECT_EQ(child.wait().exit_code, 0);
  }
  const ProgramOutcome which = jnd({"resume", "a.study", "--headless"});
  EXPECT_EQ(which.exit_code, 2);
  EXPECT_EQ(sentence_flaw(which.err, {"expected --session", "1 (P01), 2 (P02)"}), "");
  EXPECT_EQ(jnd({"resume", "a.study", "--headless", "--session", "2"}).exit_code, 0);
  EXPECT_FALSE(opened("a.study").finished(1));
  EXPECT_TRUE(opened("a.study").completed(2));
  const ProgramOutcome other =
      jnd({"resume", "a.study", "--headless", "--laboratory", "misspecified"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_EQ(sentence_flaw(other.err, {"expected the laboratory that session 1"}), "");
  EXPECT_EQ(jnd({"resume", "a.study", "--headless"}).exit_code, 0);
}

TEST_F(StopTest, ManySimulatedSessionsStopTooAndSayWhatIsOpen) {
  RunningProgram child(
      {"simulate", "magnitude_of_virtual_water", "--participants", "40", "--study", "a.study"},
      options_);
  while (
      !std::filesystem::exists(temporary_.path() / "a.study" / "recordings" / "0002.sqlite")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  child.send_signal(SIGINT);
  const ProgramOutcome outcome = child.wait();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.signal;
  EXPECT_EQ(sentence_flaw(outcome.err, {"stopped", "jnd resume a.study"}), "");
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

}  // namespace stop_test
}  // namespace jnd::app
