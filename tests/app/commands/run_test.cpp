#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>

#include "app/json_document.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "core/storage/integrity.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using test_support::RunningProgram;

class RunCommandTest : public ::testing::Test {
 protected:
  RunCommandTest() { write_file(temporary_.path() / "tiny.json", kTinyStudy); }

  ProgramOutcome jnd(const std::vector<std::string>& arguments) {
    return test_support::run_program(arguments, options_);
  }
  static std::vector<std::string> run_words(const std::string& study,
                                            const std::string& file = "tiny.json") {
    return {"run", file,         "--study", study, "--participant",
            "P01", "--headless", "--seed",  "7",   "--acknowledge"};
  }
  [[nodiscard]] core::StudyStore opened(const std::string& study) const {
    return {temporary_.path() / study, core::StudyStore::Mode::kReadOnly};
  }

  /// Every acknowledged line stands in the database as it was printed. Returns how many.
  static std::size_t check_acknowledged(const core::StudyStore& store,
                                        const std::vector<std::string>& lines) {
    const std::vector<core::EventRow> events = store.events(1);
    for (const std::string& line : lines) {
      std::istringstream words(line);
      std::string word;
      std::size_t sequence = 0;
      std::string kind;
      words >> word >> sequence >> kind;
      EXPECT_EQ(word, "EVENT") << line;
      EXPECT_TRUE(words.eof()) << line;
      if (sequence < 1 || sequence > events.size()) {
        ADD_FAILURE() << "acknowledged and lost: " << line;
        continue;
      }
      EXPECT_EQ(events[sequence - 1].kind, kind) << line;
    }
    return events.size();
  }

  static std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  test_support::ProgramOptions options_{.folder = temporary_.path(), .environment = {}};
};

TEST_F(RunCommandTest, AcknowledgesEveryEventOnceInOrderAndNothingElse) {
  for (const std::string file : {"tiny.json", "protocols/short_tour.json"}) {
    const std::string study = fs::path(file).stem().string() + ".study";
    const ProgramOutcome outcome = jnd(run_words(study, file));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const core::StudyStore store = opened(study);
    std::string expected;
    for (const core::EventRow& event : store.events(1)) {
      expected += "EVENT " + std::to_string(event.sequence) + " " + event.kind + "\n";
    }
    EXPECT_EQ(outcome.out, expected);
    EXPECT_TRUE(store.completed(1));
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
  }
}

TEST_F(RunCommandTest, TheSameSeedGivesTheSameSession) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  ASSERT_EQ(jnd(run_words("b.study")).exit_code, 0);
  EXPECT_EQ(difference(tables_text(opened("a.study"), 1), tables_text(opened("b.study"), 1)),
            "");
  EXPECT_EQ(difference(samples_text(opened("a.study"), 1), samples_text(opened("b.study"), 1)),
            "");
}

TEST_F(RunCommandTest, WithoutASeedOneIsDrawnAndStored) {
  for (const char* study : {"a.study", "b.study"}) {
    ASSERT_EQ(jnd({"run", "tiny.json", "--study", study, "--participant", "P01", "--headless"})
                  .exit_code,
              0);
  }
  EXPECT_NE(opened("a.study").sessions()[0].seed, opened("b.study").sessions()[0].seed);
}

TEST_F(RunCommandTest, ASecondSessionOfAParticipantIsRefusedInOneSentence) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  const ProgramOutcome outcome = jnd(run_words("a.study"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("P01 has a session already"), std::string::npos) << outcome.err;
  EXPECT_EQ(lines_of(outcome.err).size(), 1U);
  EXPECT_EQ(opened("a.study").sessions().size(), 1U);
}

TEST_F(RunCommandTest, AChangedStudyOrLaboratoryIsNotMixedIntoTheSameFolder) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  const auto folder = temporary_.path();
  write_file(folder / "changed.json", replaced(kTinyStudy, "[4, 16]", "[5, 15]"));
  const ProgramOutcome study =
      jnd({"run", "changed.json", "--study", "a.study", "--participant", "P02", "--headless"});
  EXPECT_EQ(study.exit_code, 1);
  EXPECT_NE(study.err.find("expected the study file that it was begun with"), std::string::npos)
      << study.err;
  const ProgramOutcome laboratory =
      jnd({"run", "tiny.json", "--study", "a.study", "--participant", "P02", "--headless",
           "--laboratory", "misspecified"});
  EXPECT_EQ(laboratory.exit_code, 1);
  EXPECT_NE(laboratory.err.find("expected the laboratory"), std::string::npos)
      << laboratory.err;
  EXPECT_EQ(opened("a.study").sessions().size(), 1U);
}

TEST_F(RunCommandTest, AnotherWriterIsRefusedAndDisturbsNothing) {
  RunningProgram first(run_words("a.study", "magnitude_of_virtual_water"), options_);
  ASSERT_TRUE(first.read_line());
  const ProgramOutcome second =
      jnd({"run", "tiny.json", "--study", "a.study", "--participant", "P02", "--headless"});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_NE(second.err.find("another"), std::string::npos) << second.err;
  EXPECT_EQ(first.wait().exit_code, 0);
  EXPECT_EQ(opened("a.study").sessions().size(), 1U);
}

TEST_F(RunCommandTest, PilotsAreLeftOutOfResultsAndExports) {
  ASSERT_EQ(jnd({"run", "tiny.json", "--study", "a.study", "--participant", "pilot",
                 "--headless", "--pilot"})
                .exit_code,
            0);
  const ProgramOutcome none = jnd({"results", "a.study"});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("none to analyse"), std::string::npos) << none.err;
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  EXPECT_EQ(document(jnd({"results", "a.study", "--json"}).out)["num_participants"], 1);
  ASSERT_EQ(jnd({"export", "csv", "a.study", "--out", "without"}).exit_code, 0);
  ASSERT_EQ(jnd({"export", "csv", "a.study", "--out", "with", "--pilot"}).exit_code, 0);
  EXPECT_EQ(read_file(temporary_.path() / "without/trials.csv").find("pilot,"),
            std::string::npos);
  EXPECT_NE(read_file(temporary_.path() / "with/trials.csv").find("pilot,"), std::string::npos);
}

TEST_F(RunCommandTest, KilledAtAnyMomentItLosesNoAcknowledgedEventAndResumes) {
  const std::string file = "short_tour";
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(jnd(run_words("whole.study", file)).exit_code, 0);
  const auto whole_duration = std::chrono::steady_clock::now() - start;
  const core::StudyStore whole = opened("whole.study");
  const std::size_t num_events = whole.events(1).size();
  std::mt19937 random(20181120);
  int num_resumed = 0;
  for (int kill = 0; kill < 15; ++kill) {
    const std::string study = "killed" + std::to_string(kill) + ".study";
    std::vector<std::string> acknowledged;
    {
      RunningProgram child(run_words(study, file), options_);
      if (kill % 3 == 0) {
        // Any moment, while the study is being made included.
        std::uniform_real_distribution<double> ratio(0.0, 1.0);
        const auto until = std::chrono::steady_clock::now() + ratio(random) * whole_duration;
        while (std::chrono::steady_clock::now() < until) {
        }
      } else {
        const std::size_t last = random() % num_events;
        while (acknowledged.size() <= last) {
          const auto line = child.read_line();
          if (!line) break;
          acknowledged.push_back(*line);
        }
      }
      child.send_signal(SIGKILL);
      const ProgramOutcome outcome = child.wait();
      for (const std::string& line : lines_of(outcome.out)) {
        // The last line may have been cut off.
        if (outcome.out.find(line + "\n") != std::string::npos) acknowledged.push_back(line);
      }
    }
    if (!fs::exists(temporary_.path() / study / "study.sqlite") || acknowledged.empty()) {
      // Killed before anything was said: whatever is there, the next run gets on with it.
      ProgramOutcome again = jnd(run_words(study, file));
      if (again.exit_code == 1) again = jnd({"resume", study, "--headless"});
      EXPECT_EQ(again.exit_code, 0) << kill << ": " << again.err;
      continue;
    }
    {
      const core::StudyStore store = opened(study);
      check_acknowledged(store, acknowledged);
    }
    const ProgramOutcome verified = jnd({"verify", study, "--json"});
    EXPECT_EQ(verified.exit_code, 0) << kill << ": " << verified.out;
    const ProgramOutcome resumed = jnd({"resume", study, "--headless", "--acknowledge"});
    EXPECT_EQ(resumed.exit_code, 0) << kill << ": " << resumed.err;
    if (resumed.out.starts_with("EVENT")) ++num_resumed;
    const core::StudyStore store = opened(study);
    EXPECT_TRUE(store.completed(1)) << kill;
    EXPECT_EQ(difference(design_text(store, 1), design_text(whole, 1)), "") << kill;
    EXPECT_EQ(difference(stimuli_text(store, 1), stimuli_text(whole, 1)), "") << kill;
    EXPECT_TRUE(core::verify(store).complete) << kill;
  }
  EXPECT_GE(num_resumed, 5);
}

TEST_F(RunCommandTest, AcknowledgesAtOnceAndNotWhenABufferIsFull) {
  // In real time the first stage lasts 20 s; its beginning has to be told long before.
  std::vector<std::string> words = run_words("a.study", "short_tour");
  words.emplace_back("--realtime");
  const auto start = std::chrono::steady_clock::now();
  RunningProgram child(words, options_);
  EXPECT_EQ(child.read_line(), "EVENT 1 session_started");
  EXPECT_EQ(child.read_line(), "EVENT 2 stage_entered");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
  child.send_signal(SIGKILL);
  EXPECT_EQ(child.wait().signal, SIGKILL);
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"resume", "a.study", "--headless"}).exit_code, 0);
  EXPECT_TRUE(opened("a.study").completed(1));
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(RunCommandTest, InterruptedFromTheKeyboardItStopsCleanlyAndCanBeResumed) {
  RunningProgram child(run_words("a.study", "magnitude_of_virtual_water"), options_);
  std::vector<std::string> acknowledged;
  while (acknowledged.size() < 40) {
    const auto line = child.read_line();
    ASSERT_TRUE(line);
    acknowledged.push_back(*line);
  }
  child.send_signal(SIGINT);
  const ProgramOutcome outcome = child.wait();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("jnd resume"), std::string::npos) << outcome.err;
  for (const std::string& line : lines_of(outcome.out)) acknowledged.push_back(line);
  {
    const core::StudyStore store = opened("a.study");
    EXPECT_EQ(check_acknowledged(store, acknowledged), acknowledged.size());
    EXPECT_EQ(store.events(1).back().kind, "paused");
    EXPECT_FALSE(store.finished(1));
  }
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
  EXPECT_EQ(jnd({"resume", "a.study", "--headless"}).exit_code, 0);
  EXPECT_TRUE(opened("a.study").completed(1));
  EXPECT_EQ(jnd({"verify", "a.study"}).exit_code, 0);
}

TEST_F(RunCommandTest, NothingToResumeIsOneSentenceAndNoError) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  const std::string before = tables_text(opened("a.study"), 1);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"resume", "a.study"},
           {"resume", "a.study", "--headless"},
           {"resume", "a.study", "--session", "1", "--headless"}}) {
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(lines_of(outcome.out).size(), 1U);
    EXPECT_NE(outcome.out.find("nothing to resume"), std::string::npos);
  }
  EXPECT_EQ(jnd({"resume", "a.study", "--session", "9", "--headless"}).exit_code, 1);
  EXPECT_EQ(difference(tables_text(opened("a.study"), 1), before), "");
}

TEST_F(RunCommandTest, AnOpenSessionNeedsHeadlessToBeResumedAndCanBeEnded) {
  {
    RunningProgram child(run_words("a.study", "magnitude_of_virtual_water"), options_);
    for (int line = 0; line < 60; ++line) ASSERT_TRUE(child.read_line());
    child.send_signal(SIGKILL);
    EXPECT_EQ(child.wait().signal, SIGKILL);
  }
  EXPECT_EQ(jnd({"resume", "a.study"}).exit_code, 3);
  EXPECT_EQ(jnd({"resume", "a.study", "--choose", "end", "--headless"}).exit_code, 0);
  const core::StudyStore store = opened("a.study");
  EXPECT_TRUE(store.finished(1));
  EXPECT_FALSE(store.completed(1));
}

TEST_F(RunCommandTest, ItsFilesAreForTheirOwnerAlone) {
  ASSERT_EQ(jnd(run_words("a.study")).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(temporary_.path() / "a.study")) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all),
              fs::perms::none)
        << entry.path();
  }
}

}  // namespace
}  // namespace jnd::app
