#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "analysis/found_results.h"
#include "app/asked_study.h"
#include "app/session/laboratory_run.h"
#include "app/session/replay_check.h"
#include "app/session/session_setup.h"
#include "app/session_content.h"
#include "core/storage/integrity.h"
#include "experiments/participants/laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/places.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

// Simulates people who answer questions after every trial, and analyses their answers.

namespace jnd::app {
namespace question_run_test {

namespace fs = std::filesystem;

experiments::Laboratory shipped_laboratory(const std::string& name) {
  return experiments::read_laboratory(test_support::source_folder() / "data" / "laboratories" /
                                      (name + ".json"));
}

class QuestionRunTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path folder(const std::string& name) const {
    return temporary_.path() / (name + ".study");
  }
  [[nodiscard]] std::unique_ptr<core::StudyStore> store_with(
      const std::string& name, const std::vector<std::string>& who) {
    auto store = std::make_unique<core::StudyStore>(
        folder(name), core::StudyStore::Mode::kCreate, core::Durability::kAtClose);
    (void)add_sessions(*store,
                       {.study = study_,
                        .laboratory = &laboratory_,
                        .study_file = "study.json",
                        .seed = 5,
                        .record = false},
                       who);
    return store;
  }
  LaboratoryRun run_of(core::StudyStore& store, std::int64_t session) {
    return {.study = study_,
            .laboratory = laboratory_,
            .store = store,
            .session = session,
            .durability = core::Durability::kAtClose};
  }
  /// Dies as by `kill -9` after `num_events` more events. Returns false if the session ended
  /// before.
  bool run_and_die(const std::string& name, std::int64_t num_events) {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                               core::Durability::kAtClose);
        LaboratoryRun plan = run_of(store, 1);
        plan.on_event = [&](const core::EventRow&) {
          if (--num_events == 0) ::_exit(9);
        };
        (void)run_laboratory(plan);
      } catch (...) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WEXITSTATUS(status) == 9;
  }
  /// Simulates sessions of this shipped study with people of `laboratory_`.
  analysis::StudyResults simulated(const std::string& study, const std::string& name) {
    study_ = experiments::read_study(test_support::source_folder() / "protocols" /
                                     (study + ".json"));
    const auto store =
        store_with(name, {"P01", "P02", "P03", "P04", "P05", "P06", "P07", "P08"});
    for (std::int64_t session = 1; session <= 8; ++session) {
      (void)run_laboratory(run_of(*store, session));
    }
    return analysis::results_of(analysis::load_study(*store), {}, {.num_resamples = 20});
  }
  static analysis::Interval ci95_of(const analysis::StudyResults& results,
                                    const std::string& name) {
    const analysis::Estimate* const found = results.find(name);
    EXPECT_NE(found, nullptr) << name;
    return found == nullptr ? analysis::Interval{} : found->ci95;
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  experiments::Study study_ = experiments::read_study_text(kAskedStudy, "study.json");
  experiments::Laboratory laboratory_ = shipped_laboratory("thesis_questions");
};

TEST_F(QuestionRunTest, KilledAfterAnyEventNothingIsLostAndEveryQuestionIsAskedOnce) {
  const auto whole = store_with("whole", {"P01"});
  (void)run_laboratory(run_of(*whole, 1));
  const std::vector<core::QuestionAnswerRow> expected = whole->question_answers(1);
  ASSERT_EQ(expected.size(), 2U * 2U + 2U * 1U);
  const auto num_events = static_cast<std::int64_t>(whole->events(1).size());
  int num_between = 0;
  constexpr std::int64_t kStride = test_support::kIsSanitized ? 7 : 1;
  for (std::int64_t killed_after = 1; killed_after < num_events; killed_after += kStride) {
    const std::string name = "killed" + std::to_string(killed_after);
    store_with(name, {"P01"}).reset();
    ASSERT_TRUE(run_and_die(name, killed_after));
    core::StudyStore store(folder(name), core::StudyStore::Mode::kReadWrite,
                           core::Durability::kAtClose);
    const std::vector<core::TrialRow> answered = store.trials(1);
    const std::vector<core::QuestionAnswerRow> said = store.question_answers(1);
    const std::string last = store.events(1).back().kind;
    num_between += last == "trial_answered" || last == "question_answered" ? 1 : 0;
    EXPECT_TRUE(run_laboratory(run_of(store, 1)).ended) << killed_after;
    // The answers that had been given stand as they were. Waiting questions were answered as
    // they would have been without the interruption, unless the trial was cut off and so felt
    // again.
    const std::vector<core::TrialRow> trials = store.trials(1);
    for (std::size_t i = 0; i < answered.size(); ++i) {
      EXPECT_EQ(trials[i].sequence, answered[i].sequence) << killed_after;
    }
    const std::vector<core::QuestionAnswerRow> now = store.question_answers(1);
    ASSERT_EQ(now.size(), expected.size()) << killed_after;
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_EQ(now[i].trial, expected[i].trial) << killed_after;
      EXPECT_EQ(now[i].question, expected[i].question) << killed_after;
      if (i < said.size()) {
        EXPECT_EQ(now[i].sequence, said[i].sequence) << killed_after;
      }
      if (now[i].attempt == 1) {
        EXPECT_EQ(now[i].answer, expected[i].answer) << killed_after;
      }
    }
    core::Integrity integrity = core::verify(store);
    check_replay(store, integrity);
    EXPECT_TRUE(integrity.complete) << killed_after;
    fs::remove_all(folder(name));
  }
  if (kStride == 1) {
    EXPECT_GE(num_between, 10) << "the moments that this is about";
  }
}

TEST_F(QuestionRunTest, VerifyFindsAnAnswerThatIsAnotherThanTheLogHasIt) {
  const auto store = store_with("forged", {"P01"});
  (void)run_laboratory(run_of(*store, 1));
  core::Integrity sound = core::verify(*store);
  check_replay(*store, sound);
  EXPECT_TRUE(sound.complete);
  core::Commit forged{.event = {.session = 1,
                                .sequence = store->events(1).back().sequence + 1,
                                .kind = "note_added",
                                .data = R"({"text": ""})"}};
  forged.question_answer = store->question_answers(1).front();
  forged.question_answer->sequence = forged.event.sequence;
  forged.question_answer->answer = "1000";
  store->append(forged);
  core::Integrity found = core::verify(*store);
  check_replay(*store, found);
  EXPECT_FALSE(found.complete);
}

TEST_F(QuestionRunTest, AnEffectThatIsPutInIsFoundAndNoneWhereThereIsNone) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const analysis::StudyResults with = simulated("viscosity_rating_with_confidence", "with");
  EXPECT_GT(ci95_of(with, "thickness.rating.per_doubling").low.value(), 0.5);
  EXPECT_GT(ci95_of(with, "thickness.rating.rank_correlation").low.value(), 0.5);
  EXPECT_GT(ci95_of(with, "comparison.question.confidence.type_2_auroc").low.value(), 0.5);
  EXPECT_GT(ci95_of(with, "comparison.question.confidence.right_minus_wrong").low.value(), 0.0);
  EXPECT_GT(ci95_of(with, "comparison.question.confidence.rank_correlation_with_difference")
                .low.value(),
            0.0);
  // How pleasant these people call a stimulus does not depend on anything that they feel.
  const analysis::Interval none =
      ci95_of(with, "thickness.question.pleasantness.rank_correlation");
  EXPECT_LT(none.low.value(), 0.0);
  EXPECT_GT(none.high.value(), 0.0);

  laboratory_ = shipped_laboratory("thesis");
  const analysis::StudyResults without =
      simulated("viscosity_rating_with_confidence", "without");
  const analysis::Interval area =
      ci95_of(without, "comparison.question.confidence.type_2_auroc");
  EXPECT_LT(area.low.value(), 0.5);
  EXPECT_GT(area.high.value(), 0.5);
}

}  // namespace question_run_test
}  // namespace jnd::app
