#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "app/acknowledged.h"
#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/session_content.h"
#include "app/tiny_study.h"
#include "support/program.h"
#include "support/sanitizer.h"

namespace jnd::app {
namespace kill_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;
using test_support::RunningProgram;
using Clock = std::chrono::steady_clock;

constexpr int kFewer = test_support::kIsSanitized ? 5 : 1;

/// The moment at which a program is killed: after a number of lines, or after a time.
struct Moment {
  std::optional<std::size_t> lines;
  Clock::duration elapsed{};
};

class KillTest : public CommandTest {
 protected:
  void SetUp() override {
    write_file(temporary_.path() / "tiny.json", kTinyStudy);
    const auto start = Clock::now();
    ASSERT_EQ(jnd(run_words("whole.study")).exit_code, 0);
    whole_duration_ = Clock::now() - start;
    num_events_ = opened("whole.study").events(1).size();
  }

  static std::vector<std::string> run_words(const std::string& study) {
    return {"run", "tiny.json",  "--study", study, "--participant",
            "P01", "--headless", "--seed",  "7",   "--acknowledge"};
  }
  static std::vector<std::string> resume_words(const std::string& study) {
    return {"resume", study, "--headless", "--acknowledge"};
  }
  static std::vector<std::string> with(std::vector<std::string> words,
                                       const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Draws when to kill the program. In one of three cases this is any moment of the run,
  /// including the time in which the folder is made. In the others it is right after an
  /// acknowledgement, when most work is under way.
  Moment draw_moment() {
    if (random_() % 3 == 0) {
      const double ratio = std::uniform_real_distribution<double>(0.0, 1.0)(random_);
      return {.elapsed = std::chrono::duration_cast<Clock::duration>(ratio * whole_duration_)};
    }
    return {.lines = 1 + random_() % num_events_};
  }

  /// Runs these words until the program is killed or done, and adds what it acknowledged.
  /// Expects that all of this is stored and that `verify` finds no problem.
  void killed(const std::string& study, const std::vector<std::string>& words,
              const Moment& moment, std::vector<std::string>& acknowledged) {
    {
      RunningProgram child(words, options_);
      if (moment.lines) {
        for (std::size_t line = 0; line < *moment.lines; ++line) {
          const auto text = child.read_line();
          if (!text) break;
          acknowledged.push_back(*text);
        }
      } else {
        std::this_thread::sleep_for(moment.elapsed);
      }
      child.send_signal(SIGKILL);
      const ProgramOutcome outcome = child.wait();
      num_killed_ += outcome.signal == SIGKILL ? 1 : 0;
      for (const std::string& line : whole_lines_of(outcome.out)) acknowledged.push_back(line);
    }
    if (acknowledged.empty()) return;  // Nothing was promised yet.
    check_acknowledged(opened(study), acknowledged);
    const ProgramOutcome verified = jnd({"verify", study, "--json"});
    EXPECT_EQ(verified.exit_code, 0) << verified.out;
    EXPECT_EQ(document(verified.out)["complete"], true);
  }

  /// Finishes the session as a person would, however far it came.
  void finish(const std::string& study) {
    ProgramOutcome outcome = jnd(resume_words(study));
    if (outcome.exit_code != 0 || !outcome.out.starts_with("EVENT")) {
      // The program was killed before it had made the folder or the session, or it had
      // finished.
      const bool is_finished = outcome.exit_code == 0 && !opened(study).sessions().empty();
      if (!is_finished) outcome = jnd(run_words(study));
    }
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const ProgramOutcome verified = jnd({"verify", study});
    EXPECT_EQ(verified.exit_code, 0) << verified.out;
  }

  /// Expects the order, stimuli and items of the uninterrupted session. Expects the same
  /// answers in every trial up to the first interruption of its block, because a later estimate
  /// depends on the one before.
  void expect_as_uninterrupted(const std::string& study) {
    const core::StudyStore whole = opened("whole.study");
    const core::StudyStore store = opened(study);
    EXPECT_TRUE(store.completed(1));
    EXPECT_EQ(difference(design_text(store, 1), design_text(whole, 1)), "");
    EXPECT_EQ(difference(stimuli_text(store, 1), stimuli_text(whole, 1)), "");
    const std::vector<core::TrialRow> trials = store.trials(1, true);
    const std::vector<core::TrialRow> expected = whole.trials(1, true);
    ASSERT_EQ(trials.size(), expected.size());
    std::string disturbed_block;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (trials[i].attempt > 1) disturbed_block = trials[i].block;
      if (trials[i].block == disturbed_block) continue;
      EXPECT_EQ(trials[i].response, expected[i].response) << "trial " << i + 1;
      EXPECT_EQ(trials[i].num_steps, expected[i].num_steps) << "trial " << i + 1;
      ++num_compared_;
    }
    const auto items = [](const core::StudyStore& of) {
      std::string text;
      for (const core::AnswerRow& row : of.answers(1)) {
        text += row.stage + "|" + row.item + "|" + row.answer + "\n";
      }
      return text;
    };
    EXPECT_EQ(items(store), items(whole));
  }

  std::mt19937 random_{20181120};
  Clock::duration whole_duration_{};
  std::size_t num_events_ = 0;
  int num_killed_ = 0;
  int num_compared_ = 0;
};

class KilledAtAnyMomentTest : public KillTest,
                              public ::testing::WithParamInterface<unsigned> {};

TEST_P(KilledAtAnyMomentTest, ItLosesNothingThatItAcknowledgedAndGoesOnAsIfUninterrupted) {
  random_.seed(GetParam());
  for (int round = 0; round < 25 / kFewer; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::string study = "killed" + std::to_string(round) + ".study";
    std::vector<std::string> acknowledged;
    killed(study, run_words(study), draw_moment(), acknowledged);
    // The programs that resume the session may be killed as well, more than once.
    for (int again = 0; again < 2 && !acknowledged.empty(); ++again) {
      if (random_() % 2 == 0) killed(study, resume_words(study), draw_moment(), acknowledged);
    }
    finish(study);
    if (!acknowledged.empty()) check_acknowledged(opened(study), acknowledged);
    expect_as_uninterrupted(study);
  }
  // With fewer kills and comparisons, the test would show little.
  EXPECT_GT(num_killed_, 10 / kFewer);
  EXPECT_GT(num_compared_, 25 / kFewer);
}

INSTANTIATE_TEST_SUITE_P(Seeds, KilledAtAnyMomentTest, ::testing::Values(1U, 2U));

TEST_F(KillTest, WithinTheLoopInRealTimeItLosesNothingEither) {
  // The kills come while the hand moves freely, right after that, at rest, and in the first
  // stroke.
  for (const std::size_t lines : {9U, 10U, 14U, 15U}) {
    SCOPED_TRACE(lines);
    const std::string study = "realtime" + std::to_string(lines) + ".study";
    std::vector<std::string> acknowledged;
    killed(study, with(run_words(study), {"--realtime"}), {.lines = lines}, acknowledged);
    EXPECT_GE(acknowledged.size(), lines);
    killed(study, with(resume_words(study), {"--realtime"}),
           {.elapsed = std::chrono::milliseconds(random_() % 800)}, acknowledged);
    finish(study);
    check_acknowledged(opened(study), acknowledged);
    EXPECT_EQ(difference(design_text(opened(study), 1), design_text(opened("whole.study"), 1)),
              "");
    EXPECT_EQ(
        difference(stimuli_text(opened(study), 1), stimuli_text(opened("whole.study"), 1)), "");
  }
}

TEST_F(KillTest, ARestartedBlockHasTheSameOrderAndAnswersOfASecondAttempt) {
  for (int round = 0; round < 12 / kFewer; ++round) {
    SCOPED_TRACE(round);
    const std::string study = "restart" + std::to_string(round) + ".study";
    std::vector<std::string> acknowledged;
    killed(study, run_words(study), {.lines = 1 + random_() % num_events_}, acknowledged);
    const std::vector<std::string> restart = with(resume_words(study), {"--choose", "restart"});
    killed(study, restart, draw_moment(), acknowledged);
    const ProgramOutcome outcome = jnd(restart);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    check_acknowledged(opened(study), acknowledged);
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
    expect_as_uninterrupted(study);
  }
}

TEST_F(KillTest, AnEndedSessionStaysEndedWhereverItWasKilled) {
  for (int round = 0; round < 12 / kFewer; ++round) {
    SCOPED_TRACE(round);
    const std::string study = "end" + std::to_string(round) + ".study";
    std::vector<std::string> acknowledged;
    killed(study, run_words(study), {.lines = 1 + random_() % (num_events_ - 1)}, acknowledged);
    if (opened(study).finished(1)) continue;  // The signal came too late.
    const std::vector<std::string> end = with(resume_words(study), {"--choose", "end"});
    killed(study, end, {.lines = 1 + random_() % 3}, acknowledged);
    EXPECT_EQ(jnd(end).exit_code, 0);
    const core::StudyStore store = opened(study);
    check_acknowledged(store, acknowledged);
    EXPECT_TRUE(store.finished(1));
    EXPECT_FALSE(store.completed(1));
    const std::string before = events_text(store, 1);
    const ProgramOutcome nothing = jnd(resume_words(study));
    EXPECT_EQ(nothing.exit_code, 0);
    EXPECT_EQ(nothing.out, "");
    EXPECT_NE(nothing.err.find("nothing to resume"), std::string::npos) << nothing.err;
    EXPECT_EQ(difference(events_text(opened(study), 1), before), "");
    EXPECT_EQ(jnd({"verify", study}).exit_code, 0);
  }
}

}  // namespace kill_test
}  // namespace jnd::app
